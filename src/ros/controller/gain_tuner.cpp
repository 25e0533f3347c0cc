#include "ros/controller/gain_tuner.h"

#include <ros/console.h>
#include <std_msgs/String.h>

#include <atomic>
#include <boost/make_shared.hpp>
#include <chrono>
#include <future>
#include <utility>

#include "adaptive_quadrotor_control/law/law_factory.h"
#include "ros/border/parameter_tree.h"
#include "ros/controller/pilot_state.h"
#include "ros/controller/tuning_server.h"

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

std::string nameOf(const YAML::Node& gains) {
  return gains["law"].as<std::string>();
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
      spinner_(1, &queue_) {
  node_.setCallbackQueue(&queue_);
  publisher_ = node_.advertise<std_msgs::String>("parameters", 1, true);
  service_ = node_.advertiseService("reload_parameters", &GainTuner::onReload, this);
  makeServer();
  publish();
  spinner_.start();
}

GainTuner::~GainTuner() {
  spinner_.stop();
}

void GainTuner::makeServer() {
  server_.reset();  // its topics are those of the next one
  node_.deleteParam("tuning");
  server_ = TuningServer::make(nameOf(gains_), ros::NodeHandle(node_, "tuning"), gains_,
                               [this](const YAML::Node& gains) {
                                 std::string problem = apply(gains);
                                 if (problem.empty()) setParameterTree(node_, "gains", gains);
                                 return problem;
                               });
}

void GainTuner::publish() {
  YAML::Node all;
  all["vehicle"] = vehicle_tree_;
  all["gains"] = gains_;
  std_msgs::String message;
  message.data = YAML::Dump(all);
  publisher_.publish(message);
}

std::string GainTuner::apply(const YAML::Node& gains) {
  auto prepared = std::make_unique<PreparedLaw>();
  try {
    const ParameterReader reader(gains, node_.resolveName("gains"));
    prepared->law = makeLaw(reader, vehicle_);
    reader.finish();
  } catch (const ParameterError& error) {
    return error.what();
  }
  prepared->adaptive_names = adaptiveNames(*prepared->law);
  const std::string problem = swapInControlThread(std::move(prepared));
  if (!problem.empty()) return problem;
  gains_ = YAML::Clone(gains);
  publish();
  return "";
}

std::string GainTuner::swapInControlThread(std::unique_ptr<PreparedLaw> law) {
  const auto job = boost::make_shared<SwapJob>(std::move(law), swap_);
  control_.addCallback(job);
  return job->wait();
}

bool GainTuner::onReload(std_srvs::Trigger::Request&, std_srvs::Trigger::Response& response) {
  const std::string before = nameOf(gains_);
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
  const std::string law = nameOf(gains_);
  response.message = law + " flies with these gains";
  if (law != before) {
    makeServer();
  } else if (server_) {
    server_->show(gains_);
  }
  return true;
}

}  // namespace aqc
