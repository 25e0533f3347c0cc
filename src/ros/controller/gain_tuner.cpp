#include "ros/controller/gain_tuner.h"
#include "adaptive_quadrotor_control/parameters/parameter_reader.h"

#include <ros/console.h>
#include <std_msgs/String.h>

#include <algorithm>
#include <atomic>
#include <boost/make_shared.hpp>
#include <chrono>
#include <future>
#include <utility>

#include "adaptive_quadrotor_control/law/law_factory.h"
#include "ros/border/parameter_tree.h"
#include "ros/controller/tuning_map.h"

namespace aqc {
namespace {

constexpr auto kPatience = std::chrono::seconds(2);  // with the control thread

// A swap on its way to the control thread. Whoever gives up on it takes it back, unless it has
// begun: it is done or not, but never later than its answer.
class SwapJob : public ros::CallbackInterface {
 public:
  SwapJob(std::unique_ptr<PreparedLaw> law, GainTuner::Swap swap)
      : law_(std::move(law)), swap_(std::move(swap)) {}

  CallResult call() override {
    if (!taken_.exchange(true)) answer_.set_value(swap_(*law_));
    return Success;
  }

  std::string wait() {
    std::future<std::string> answer = answer_.get_future();
    if (answer.wait_for(kPatience) != std::future_status::ready && !taken_.exchange(true)) {
      return "the control thread does not answer";
    }
    return answer.get();
  }

 private:
  std::unique_ptr<PreparedLaw> law_;  // afterwards the old law, which dies with this
  GainTuner::Swap swap_;
  std::atomic<bool> taken_{false};
  std::promise<std::string> answer_;
};

// Another law has other gains: it comes by a reload of all of them, not as a gain.
Schema tunable(Schema schema) {
  schema.erase(std::remove_if(schema.begin(), schema.end(),
                              [](const Parameter& gain) { return gain.key.name == "law"; }),
               schema.end());
  return schema;
}

ros::NodeHandle tuningNode(const ros::NodeHandle& node, ros::CallbackQueue& queue) {
  ros::NodeHandle tuning(node, "tuning");
  tuning.setCallbackQueue(&queue);
  return tuning;
}

}  // namespace

GainTuner::GainTuner(const ros::NodeHandle& node, const YAML::Node& vehicle,
                     const YAML::Node& gains, ros::CallbackQueueInterface& control, Swap swap)
    : node_(node),
      vehicle_tree_(vehicle),
      vehicle_(readVehicle(ParameterReader(vehicle, "vehicle"))),
      gains_(YAML::Clone(gains)),
      control_(control),
      swap_(std::move(swap)),
      server_(tuningNode(node, queue_), [this](const auto& wanted) { return tune(wanted); }),
      spinner_(1, &queue_) {
  schema_ = prepare(gains_)->schema;
  node_.setCallbackQueue(&queue_);
  publisher_ = node_.advertise<std_msgs::String>("parameters", 1, true);
  service_ = node_.advertiseService("reload_parameters", &GainTuner::onReload, this);
  publish();
  server_.show(schema_);
  spinner_.start();
}

GainTuner::~GainTuner() {
  spinner_.stop();
}

void GainTuner::publish() {
  YAML::Node all;
  all["vehicle"] = vehicle_tree_;
  all["gains"] = gains_;
  std_msgs::String message;
  message.data = YAML::Dump(all);
  publisher_.publish(message);
}

std::string GainTuner::tune(const dynamic_reconfigure::Config& wanted) {
  std::string problem;
  try {
    const std::optional<YAML::Node> gains = withValues(gains_, schema_, wanted);
    if (gains) problem = apply(*gains);
    if (gains && problem.empty()) setParameterTree(node_, "gains", gains_);
  } catch (const ParameterError& error) {
    problem = error.what();
  }
  server_.show(schema_);
  return problem;
}

std::unique_ptr<PreparedLaw> GainTuner::prepare(const YAML::Node& gains) const {
  auto prepared = std::make_unique<PreparedLaw>();
  const ParameterReader reader(gains, node_.resolveName("gains"));
  prepared->law = makeLaw(reader, vehicle_);
  reader.finish();
  prepared->adaptive_quantities = prepared->law->adaptiveQuantities();
  prepared->schema = tunable(reader.schema());
  return prepared;
}

std::string GainTuner::apply(const YAML::Node& gains) {
  std::unique_ptr<PreparedLaw> prepared = prepare(gains);
  Schema schema = std::move(prepared->schema);
  const std::string problem = swapInControlThread(std::move(prepared));
  if (!problem.empty()) return problem;
  gains_ = YAML::Clone(gains);
  schema_ = std::move(schema);
  publish();
  return "";
}

std::string GainTuner::swapInControlThread(std::unique_ptr<PreparedLaw> law) {
  const auto job = boost::make_shared<SwapJob>(std::move(law), swap_);
  control_.addCallback(job);
  return job->wait();
}

bool GainTuner::onReload(std_srvs::Trigger::Request&, std_srvs::Trigger::Response& response) {
  try {
    response.message = apply(parameterTree(node_, "gains"));
  } catch (const ParameterError& error) {
    response.message = error.what();
  }
  response.success = response.message.empty();
  if (!response.success) {
    response.message = "nothing changed: " + response.message;
    ROS_WARN("parameters refused, %s", response.message.c_str());
    return true;
  }
  server_.show(schema_);
  response.message = gains_["law"].Scalar() + " flies with these gains";
  return true;
}

}  // namespace aqc
