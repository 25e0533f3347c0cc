#pragma once

#include <geometry_msgs/Point.h>
#include <geometry_msgs/PoseStamped.h>
#include <geometry_msgs/Quaternion.h>
#include <geometry_msgs/Vector3.h>
#include <nav_msgs/Odometry.h>
#include <ros/time.h>
#include <trajectory_msgs/MultiDOFJointTrajectory.h>

#include <string>
#include <vector>

#include "adaptive_quadrotor_control/ControllerState.h"
#include "adaptive_quadrotor_control/PlantStatus.h"
#include "adaptive_quadrotor_control/flight/collector.h"
#include "adaptive_quadrotor_control/reference/set_point_schedule.h"
#include "ros/border/names.h"

// The border between ROS messages and the core: every conversion happens here and only once.

namespace aqc {

// Message and service types; some share their name with a type of the core.
namespace msgs = ::adaptive_quadrotor_control;

inline Nanoseconds toNanoseconds(const ros::Time& time) {
  return static_cast<Nanoseconds>(time.toNSec());
}
ros::Time toRosTime(Nanoseconds time);
/// Of a clock that never steps, whatever ROS time does.
inline Nanoseconds steadyNow() {
  return static_cast<Nanoseconds>(ros::SteadyTime::now().toNSec());
}

Eigen::Vector3d toEigen(const geometry_msgs::Vector3& vector);
Eigen::Vector3d toEigen(const geometry_msgs::Point& point);
Eigen::Quaterniond toEigen(const geometry_msgs::Quaternion& quaternion);
geometry_msgs::Vector3 toVector3(const Eigen::Vector3d& vector);
geometry_msgs::Point toPoint(const Eigen::Vector3d& point);
geometry_msgs::Quaternion toQuaternion(const Eigen::Quaterniond& quaternion);

/// Odometry has its pose in the world and its twist in the body (REP-147). The quaternion is
/// normalised; the result may be invalid (State::valid()) when the message was.
State toState(const nav_msgs::Odometry& odometry);
nav_msgs::Odometry toOdometry(const State& state, Nanoseconds time);

/// Set points of a trajectory that begins at `begin` (time_from_start counts from there). Absent
/// velocities and accelerations are zero; yaw_acceleration is the acceleration's angular.z. The
/// message has no jerk: it is the difference of a point's and the next one's acceleration over the
/// time between them, and zero for the last point, where either has no acceleration, and where that
/// time is zero or longer than 0.2 s, which is no sampled path. Throws std::invalid_argument,
/// naming the point and what is wrong with it, for a message without points, a point without
/// transform, non-finite numbers or jerks, a rotation that is none, or times that go back.
/// `to_world` brings points of the message's frame into W.
std::vector<TimedSetPoint> toSetPoints(
    const trajectory_msgs::MultiDOFJointTrajectory& trajectory, Nanoseconds begin,
    const Eigen::Isometry3d& to_world = Eigen::Isometry3d::Identity());
trajectory_msgs::MultiDOFJointTrajectory toTrajectory(const std::vector<TimedSetPoint>& set_points,
                                                      Nanoseconds begin);

/// Throws std::invalid_argument, naming the pose, when its rotation is none or a number not finite.
SetPoint toSetPoint(const geometry_msgs::Pose& pose, const std::string& name = "the pose",
                    const Eigen::Isometry3d& to_world = Eigen::Isometry3d::Identity());

/// What the controller publishes about one step, and back. Truth that only the plant knows
/// (payload, contact) is not in it.
void fill(const FlightSample& sample, msgs::ControllerState& message);
FlightSample toSample(const msgs::ControllerState& message);

/// Names and units of the adaptive values in such a message, and back; a name without a unit has
/// an empty one.
void fill(const std::vector<AdaptiveQuantity>& quantities, msgs::ControllerState& message);
std::vector<AdaptiveQuantity> toQuantities(const msgs::ControllerState& message);

/// What the log of a flight is made from.
StepReport toReport(const msgs::ControllerState& message);
Truth toTruth(const msgs::PlantStatus& message);

}  // namespace aqc
