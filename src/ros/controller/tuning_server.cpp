#include "ros/controller/tuning_server.h"

#include <adaptive_quadrotor_control/AsmcConfig.h>
#include <adaptive_quadrotor_control/GeometricConfig.h>
#include <adaptive_quadrotor_control/SmcConfig.h>
#include <adaptive_quadrotor_control/SwitchedConfig.h>
#include <dynamic_reconfigure/server.h>

#include <map>
#include <utility>

#include "ros/controller/tuning_map.h"

namespace aqc {
namespace {

template <class Config>
class LawTuningServer final : public TuningServer {
 public:
  LawTuningServer(const ros::NodeHandle& node, const YAML::Node& gains, Apply apply)
      : apply_(std::move(apply)), gains_(YAML::Clone(gains)), server_(mutex_, node) {
    for (const std::string& name : missingNames(gains_, message(Config::__getDefault__()))) {
      ROS_WARN("gain '%s' has no entry in dynamic_reconfigure", name.c_str());
    }
    show(gains);
    server_.setCallback([this](Config& config, std::uint32_t) { onChange(config); });
  }

  void show(const YAML::Node& gains) override {
    gains_ = YAML::Clone(gains);
    server_.updateConfig(configOf(gains_));
  }

 private:
  static dynamic_reconfigure::Config message(const Config& config) {
    dynamic_reconfigure::Config values;
    config.__toMessage__(values);
    return values;
  }

  static Config configOf(const YAML::Node& gains) {
    Config config = Config::__getDefault__();
    dynamic_reconfigure::Config values = message(config);
    readTree(gains, values);
    config.__fromMessage__(values);
    return config;
  }

  // What a client asked for becomes what there is: all of it, or on a refusal nothing.
  void onChange(Config& config) {
    const YAML::Node wanted = withValues(gains_, message(config));
    if (YAML::Dump(wanted) != YAML::Dump(gains_)) {
      const std::string problem = apply_(wanted);
      if (problem.empty()) {
        gains_ = wanted;
      } else {
        ROS_WARN("gains refused, nothing changed: %s", problem.c_str());
      }
    }
    config = configOf(gains_);
  }

  Apply apply_;
  YAML::Node gains_;
  boost::recursive_mutex mutex_;
  dynamic_reconfigure::Server<Config> server_;
};

using Maker = std::unique_ptr<TuningServer> (*)(const ros::NodeHandle&, const YAML::Node&,
                                                TuningServer::Apply);

template <class Config>
std::unique_ptr<TuningServer> makeServer(const ros::NodeHandle& node, const YAML::Node& gains,
                                         TuningServer::Apply apply) {
  return std::make_unique<LawTuningServer<Config>>(node, gains, std::move(apply));
}

}  // namespace

std::unique_ptr<TuningServer> TuningServer::make(const std::string& law,
                                                 const ros::NodeHandle& node,
                                                 const YAML::Node& gains, Apply apply) {
  // To tune another law: write its cfg file and add its line here.
  static const std::map<std::string, Maker> makers = {
      {"asmc", makeServer<adaptive_quadrotor_control::AsmcConfig>},
      {"geometric", makeServer<adaptive_quadrotor_control::GeometricConfig>},
      {"smc", makeServer<adaptive_quadrotor_control::SmcConfig>},
      {"switched", makeServer<adaptive_quadrotor_control::SwitchedConfig>},
  };
  const auto maker = makers.find(law);
  if (maker == makers.end()) return nullptr;
  return maker->second(node, gains, std::move(apply));
}

}  // namespace aqc
