#include "ros/controller/flight_diagnostics.h"

#include <utility>

#include "ros/border/conversions.h"

namespace aqc {
namespace {

constexpr double kPeriod = 1.0;  // [s], wall

unsigned char level(Health health) {
  using diagnostic_msgs::DiagnosticStatus;
  if (health == Health::kOk) return DiagnosticStatus::OK;
  return health == Health::kWarn ? DiagnosticStatus::WARN : DiagnosticStatus::ERROR;
}

}  // namespace

FlightDiagnostics::FlightDiagnostics(const ros::NodeHandle& node,
                                     const ros::NodeHandle& private_node,
                                     const std::string& node_name,
                                     const std::vector<std::string>& names, Judge judge)
    : judge_(std::move(judge)),
      last_odometry_(ros::SteadyTime::now()),
      updater_(node, private_node, node_name) {
  updater_.setHardwareID("none");
  findings_.resize(names.size());
  for (std::size_t i = 0; i < names.size(); ++i) {
    updater_.add(names[i], [this, i](diagnostic_updater::DiagnosticStatusWrapper& status) {
      const Finding& finding = findings_[i];
      status.summary(level(finding.health), finding.reason);
      for (const auto& value : finding.values) status.add(value.first, value.second);
    });
  }
  timer_ = ros::NodeHandle(node).createWallTimer(ros::WallDuration(kPeriod),
                                                 &FlightDiagnostics::onTimer, this);
}

void FlightDiagnostics::onTimer(const ros::WallTimerEvent&) {
  const double silence = (ros::SteadyTime::now() - last_odometry_).toSec();
  findings_ = judge_(toNanoseconds(ros::Time::now()), silence);
  updater_.force_update();
}

}  // namespace aqc
