#pragma once

#include <nav_msgs/Odometry.h>
#include <nav_msgs/Path.h>
#include <ros/ros.h>
#include <std_srvs/Trigger.h>
#include <tf2_ros/buffer.h>
#include <tf2_ros/transform_listener.h>

#include <optional>
#include <string>
#include <vector>

#include "adaptive_quadrotor_control/ControllerState.h"
#include "adaptive_quadrotor_control/FlyPath.h"
#include "adaptive_quadrotor_control/PathProgress.h"
#include "adaptive_quadrotor_control/reference/minimum_snap.h"
#include "adaptive_quadrotor_control/reference/time_allocation.h"
#include "ros/border/conversions.h"

namespace aqc {

/// Turns waypoints into a minimum-snap trajectory within limits and sends it to the controller.
///
/// In: `waypoints` (nav_msgs/Path), `odometry`, `controller/state`. Services: `~fly_path`,
/// `~cancel`. Out: `command/trajectory`, `~progress` (10 Hz). Parameters: `~speed` [m/s],
/// `~acceleration` [m/s^2], `~max_tilt_deg`, `~thrust_to_weight`, `~set_point_rate` [Hz].
///
/// A path begins at the present set point with its velocity and acceleration, so that nothing
/// jumps; on the ground, without a set point, at the present position. A new path replaces the old
/// one; `~cancel` brakes within the limits of the path, or beyond them if it must (see
/// brakeWithin), and holds where that ends.
class WaypointNode {
 public:
  /// Throws ParameterError.
  WaypointNode();

 private:
  void onPath(const nav_msgs::Path::ConstPtr& path);
  bool onFlyPath(msgs::FlyPath::Request& request, msgs::FlyPath::Response& response);
  bool onCancel(std_srvs::Trigger::Request& request, std_srvs::Trigger::Response& response);
  void onTimer(const ros::TimerEvent& event);

  double fly(const nav_msgs::Path& path, const MotionLimits& limits);
  Waypoint presentWaypoint() const;
  std::vector<Waypoint> toWaypoints(const nav_msgs::Path& path) const;
  void send(const PolynomialTrajectory& trajectory, std::uint8_t phase);

  ros::NodeHandle node_;
  ros::NodeHandle private_node_{"~"};
  MotionLimits limits_{};         // of the parameters
  MotionLimits flight_limits_{};  // of the path that is flown
  Nanoseconds set_point_period_ = 0;
  tf2_ros::Buffer transforms_;
  tf2_ros::TransformListener listener_{transforms_};

  msgs::ControllerState::ConstPtr controller_;
  nav_msgs::Odometry::ConstPtr odometry_;
  std::uint8_t phase_ = msgs::PathProgress::IDLE;
  ros::Time begin_;
  double duration_ = 0.0;  // of the trajectory being flown [s]

  ros::Publisher trajectory_publisher_;
  ros::Publisher progress_publisher_;
  std::vector<ros::Subscriber> subscribers_;
  std::vector<ros::ServiceServer> services_;
  ros::Timer timer_;
};

}  // namespace aqc
