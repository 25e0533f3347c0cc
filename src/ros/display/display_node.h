#pragma once

#include <ros/ros.h>
#include <trajectory_msgs/MultiDOFJointTrajectory.h>

#include <vector>

#include "ros/display/flight_markers.h"
#include "ros/display/flight_paths.h"

namespace aqc {

/// Shows a flight in rviz.
///
/// In: `controller/state`, `plant/status` (if there is a simulated plant), `command/trajectory`.
/// Out: `display/vehicle` and `display/paths`, MarkerArrays at `~rate` and a quarter of it by the
/// wall clock, however fast the flight is. Parameters: `vehicle`; `scenario` (its walls) if there
/// is one; `~rate` [Hz]. The parameter `robot_description` is set where the launch file did not.
class DisplayNode {
 public:
  /// Throws ParameterError.
  DisplayNode();

 private:
  void onState(const msgs::ControllerState::ConstPtr& state);
  void onTrajectory(const trajectory_msgs::MultiDOFJointTrajectory::ConstPtr& message);
  void onTimer(const ros::WallTimerEvent& event);
  void publishVehicle();
  void publishPaths();

  ros::NodeHandle node_;
  Vehicle vehicle_;
  std::vector<Box> walls_;
  msgs::ControllerState::ConstPtr state_;  // latest
  msgs::PlantStatus::ConstPtr status_;     // latest, null without a simulated plant
  FlightTrail flown_;
  ReferenceTrail reference_;
  Markers shown_;  // last published on display/vehicle
  unsigned ticks_ = 0;

  ros::Publisher vehicle_publisher_;
  ros::Publisher path_publisher_;
  std::vector<ros::Subscriber> subscribers_;
  ros::WallTimer timer_;
};

}  // namespace aqc
