#include "ros/controller/pilot_outputs.h"

#include <boost/make_shared.hpp>
#include <cmath>

#include "adaptive_quadrotor_control/Actuators.h"
#include "ros/border/conversions.h"
#include "ros/controller/pilot_state.h"

namespace aqc {

PilotOutputs::PilotOutputs(ros::NodeHandle& node, ros::NodeHandle& private_node, const Pilot& pilot)
    : pilot_(pilot),
      quantities_(pilot.law().adaptiveQuantities()),
      imu_topic_(node.resolveName(kImuTopic)),
      // A simulation may run far ahead of the wall clock: nothing may be lost in a queue on the
      // way.
      motor_publisher_(node.advertise<msgs::Actuators>(kMotorSpeedTopic, 100)),
      state_publisher_(private_node.advertise<msgs::ControllerState>("state", 10000)) {}

void PilotOutputs::publish(Publish what) {
  if (what == Publish::kNothing) return;
  const RotorArray& speeds = pilot_.allocation().speeds;
  const auto motors = boost::make_shared<msgs::Actuators>();
  motors->header.stamp = toRosTime(pilot_.stepClock().odometryTime());
  motors->angular_velocities.assign(speeds.begin(), speeds.end());
  motor_publisher_.publish(motors);
  if (what == Publish::kLastCommand) return;
  tellOfMode();
  publishState();
  tellOfSwitches();
  tellOfImu();
}

void PilotOutputs::publishState() {
  const auto state = boost::make_shared<msgs::ControllerState>();
  fill(pilot_, *state);
  fill(quantities_, *state);
  state_publisher_.publish(state);
}

void PilotOutputs::tellOfMode() {
  const Guard* guard = pilot_.guard();
  if (guard == nullptr || guard->mode() == told_mode_) return;
  told_mode_ = guard->mode();
  ROS_WARN("%s: %s", toString(told_mode_), textOf(guard->rule()).check);
}

void PilotOutputs::tellOfSwitches() const {
  for (const SwitchReport& report : pilot_.objections()) {
    ROS_WARN("%s", switchObjection(report, 0).c_str());
  }
}

void PilotOutputs::tellOfImu() {
  const bool usable = pilot_.imu().usable();
  if (usable == imu_was_usable_) return;
  imu_was_usable_ = usable;
  if (usable) {
    ROS_INFO("'%s' is there", imu_topic_.c_str());
  } else {
    const Nanoseconds away = pilot_.stepClock().odometryTime() - pilot_.imu().time();
    ROS_WARN("the last sample of '%s' is %.3f s away from the odometry: the law does without",
             imu_topic_.c_str(), std::abs(toSeconds(away)));
  }
}

}  // namespace aqc
