#pragma once

#include <ros/ros.h>
#include <sensor_msgs/Imu.h>

#include <functional>

#include "adaptive_quadrotor_control/ControllerState.h"
#include "adaptive_quadrotor_control/pilot/flight_controller.h"
#include "adaptive_quadrotor_control/pilot/imu_monitor.h"
#include "ros/border/conversions.h"

namespace aqc {

/// The topic `imu` for a law that needs an accelerometer: bad samples are dropped, silence is
/// noticed and told by warnings and in `~state`.
class ImuInput {
 public:
  /// Calls `arrived` after every good sample.
  ImuInput(ros::NodeHandle& node, std::function<void()> arrived);

  /// Gives the law what goes with odometry of the time `odometry`, or makes it forget.
  void feed(FlightController& controller, Nanoseconds odometry);
  /// Whether odometry of that time should wait for its sample: one is coming, as far as anybody
  /// knows, and is not here yet.
  bool awaits(Nanoseconds odometry) const noexcept {
    return monitor_.usable() && !monitor_.covers(odometry);
  }
  bool covers(Nanoseconds odometry) const noexcept { return monitor_.covers(odometry); }
  void fill(msgs::ControllerState& state) const;

 private:
  void onImu(const sensor_msgs::Imu::ConstPtr& message);

  ImuMonitor monitor_;
  std::function<void()> arrived_;
  ros::Subscriber subscriber_;
};

}  // namespace aqc
