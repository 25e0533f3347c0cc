#include "ros/border/conversions.h"

#include <algorithm>
#include <stdexcept>
#include <string>

#include "adaptive_quadrotor_control/math/rotations.h"

namespace aqc {
namespace {

[[noreturn]] void refuse(const std::string& name, const std::string& problem) {
  throw std::invalid_argument(name + " " + problem);
}

std::string nameOf(std::size_t index) {
  return "set point " + std::to_string(index);
}

// The set point of that name, whose other numbers are there, with the yaw of a rotation.
SetPoint withYaw(SetPoint set_point, const geometry_msgs::Quaternion& orientation,
                 const std::string& name, const Eigen::Isometry3d& to_world) {
  const Eigen::Quaterniond rotation = toEigen(orientation);
  if (!(std::abs(rotation.norm() - 1.0) < 1e-3)) refuse(name, "has no unit quaternion");
  set_point.yaw = rollPitchYaw(Eigen::Quaterniond(to_world.linear()) * rotation.normalized()).z();
  if (!set_point.valid()) refuse(name, "has a number that is not finite");
  return set_point;
}

SetPoint toSetPoint(const trajectory_msgs::MultiDOFJointTrajectoryPoint& point, std::size_t index,
                    const Eigen::Isometry3d& to_world) {
  if (point.transforms.empty()) refuse(nameOf(index), "has no transform");
  const auto turned = [&to_world](const geometry_msgs::Vector3& vector) -> Eigen::Vector3d {
    return to_world.linear() * toEigen(vector);
  };
  SetPoint set_point;
  set_point.position = to_world * toEigen(point.transforms.front().translation);
  if (!point.velocities.empty()) {
    set_point.velocity = turned(point.velocities.front().linear);
    set_point.yaw_rate = turned(point.velocities.front().angular).z();
  }
  if (!point.accelerations.empty()) {
    set_point.acceleration = turned(point.accelerations.front().linear);
    set_point.yaw_acceleration = turned(point.accelerations.front().angular).z();
  }
  return withYaw(set_point, point.transforms.front().rotation, nameOf(index), to_world);
}

// What one step of a path may take at most to count as sampled from it [s].
constexpr double kLongestSample = 0.2;

// The jerk, which the message has no place for, from its accelerations.
void differentiate(const trajectory_msgs::MultiDOFJointTrajectory& trajectory,
                   std::vector<TimedSetPoint>& set_points) {
  for (std::size_t i = 0; i + 1 < set_points.size(); ++i) {
    const auto& accelerations = trajectory.points[i].accelerations;
    const auto& next_accelerations = trajectory.points[i + 1].accelerations;
    if (accelerations.empty() || next_accelerations.empty()) continue;
    const double interval = toSeconds(set_points[i + 1].time - set_points[i].time);
    if (!(interval > 0.0 && interval <= kLongestSample)) continue;
    SetPoint& set_point = set_points[i].set_point;
    const SetPoint& next = set_points[i + 1].set_point;
    set_point.jerk = (next.acceleration - set_point.acceleration) / interval;
    if (!set_point.valid()) refuse(nameOf(i), "has an acceleration too far from the next one's");
  }
}

}  // namespace

ros::Time toRosTime(Nanoseconds time) {
  ros::Time result;
  result.fromNSec(static_cast<std::uint64_t>(time));
  return result;
}

Eigen::Vector3d toEigen(const geometry_msgs::Vector3& v) {
  return {v.x, v.y, v.z};
}
Eigen::Vector3d toEigen(const geometry_msgs::Point& p) {
  return {p.x, p.y, p.z};
}
Eigen::Quaterniond toEigen(const geometry_msgs::Quaternion& q) {
  return {q.w, q.x, q.y, q.z};
}

geometry_msgs::Vector3 toVector3(const Eigen::Vector3d& vector) {
  geometry_msgs::Vector3 message;
  message.x = vector.x();
  message.y = vector.y();
  message.z = vector.z();
  return message;
}

geometry_msgs::Point toPoint(const Eigen::Vector3d& point) {
  geometry_msgs::Point message;
  message.x = point.x();
  message.y = point.y();
  message.z = point.z();
  return message;
}

geometry_msgs::Quaternion toQuaternion(const Eigen::Quaterniond& quaternion) {
  geometry_msgs::Quaternion message;
  message.w = quaternion.w();
  message.x = quaternion.x();
  message.y = quaternion.y();
  message.z = quaternion.z();
  return message;
}

State toState(const nav_msgs::Odometry& odometry) {
  State state;
  state.position = toEigen(odometry.pose.pose.position);
  state.attitude = toEigen(odometry.pose.pose.orientation);
  if (state.valid()) state.attitude.normalize();
  state.velocity = state.attitude * toEigen(odometry.twist.twist.linear);
  state.body_rate = toEigen(odometry.twist.twist.angular);
  return state;
}

nav_msgs::Odometry toOdometry(const State& state, Nanoseconds time) {
  nav_msgs::Odometry odometry;
  odometry.header.stamp = toRosTime(time);
  odometry.header.frame_id = kWorldFrame;
  odometry.child_frame_id = kBodyFrame;
  odometry.pose.pose.position = toPoint(state.position);
  odometry.pose.pose.orientation = toQuaternion(state.attitude);
  odometry.twist.twist.linear = toVector3(state.attitude.conjugate() * state.velocity);
  odometry.twist.twist.angular = toVector3(state.body_rate);
  return odometry;
}

std::vector<TimedSetPoint> toSetPoints(const trajectory_msgs::MultiDOFJointTrajectory& trajectory,
                                       Nanoseconds begin, const Eigen::Isometry3d& to_world) {
  if (trajectory.points.empty()) throw std::invalid_argument("the trajectory has no points");
  std::vector<TimedSetPoint> set_points;
  set_points.reserve(trajectory.points.size());
  for (std::size_t i = 0; i < trajectory.points.size(); ++i) {
    const Nanoseconds time = begin + trajectory.points[i].time_from_start.toNSec();
    if (i > 0 && time < set_points.back().time) refuse(nameOf(i), "is earlier than the one before");
    set_points.push_back({time, toSetPoint(trajectory.points[i], i, to_world)});
  }
  differentiate(trajectory, set_points);
  return set_points;
}

trajectory_msgs::MultiDOFJointTrajectory toTrajectory(const std::vector<TimedSetPoint>& set_points,
                                                      Nanoseconds begin) {
  trajectory_msgs::MultiDOFJointTrajectory trajectory;
  trajectory.header.stamp = toRosTime(begin);
  trajectory.header.frame_id = kWorldFrame;
  trajectory.joint_names = {kBodyFrame};
  for (const TimedSetPoint& timed : set_points) {
    const SetPoint& set_point = timed.set_point;
    trajectory_msgs::MultiDOFJointTrajectoryPoint point;
    point.time_from_start.fromNSec(timed.time - begin);
    point.transforms.resize(1);
    point.transforms[0].translation = toVector3(set_point.position);
    point.transforms[0].rotation = toQuaternion(yawRotation(set_point.yaw));
    point.velocities.resize(1);
    point.velocities[0].linear = toVector3(set_point.velocity);
    point.velocities[0].angular.z = set_point.yaw_rate;
    point.accelerations.resize(1);
    point.accelerations[0].linear = toVector3(set_point.acceleration);
    point.accelerations[0].angular.z = set_point.yaw_acceleration;
    trajectory.points.push_back(point);
  }
  return trajectory;
}

SetPoint toSetPoint(const geometry_msgs::Pose& pose, const std::string& name,
                    const Eigen::Isometry3d& to_world) {
  SetPoint set_point;
  set_point.position = to_world * toEigen(pose.position);
  return withYaw(set_point, pose.orientation, name, to_world);
}

void fill(const FlightSample& sample, msgs::ControllerState& message) {
  const Telemetry& telemetry = sample.telemetry;
  const Allocation& allocation = sample.allocation;
  message.header.stamp = toRosTime(sample.time);
  message.header.frame_id = kWorldFrame;
  message.flying = sample.flying;
  message.position = toPoint(sample.state.position);
  message.attitude = toQuaternion(sample.state.attitude);
  message.velocity = toVector3(sample.state.velocity);
  message.body_rate = toVector3(sample.state.body_rate);
  message.desired_position = toPoint(sample.set_point.position);
  message.desired_velocity = toVector3(sample.set_point.velocity);
  message.desired_acceleration = toVector3(sample.set_point.acceleration);
  message.desired_yaw = sample.set_point.yaw;
  message.desired_yaw_rate = sample.set_point.yaw_rate;
  message.desired_attitude = toQuaternion(telemetry.desired_attitude);
  message.position_error = toVector3(telemetry.position_error);
  message.velocity_error = toVector3(telemetry.velocity_error);
  message.attitude_error = toVector3(telemetry.attitude_error);
  message.rate_error = toVector3(telemetry.rate_error);
  message.sliding_position = toVector3(telemetry.sliding_position);
  message.sliding_attitude = toVector3(telemetry.sliding_attitude);
  message.force = toVector3(telemetry.force);
  message.mass_estimate = telemetry.mass_estimate;
  message.weighed_mass = telemetry.weighed_mass;
  message.adaptive_values.assign(telemetry.adaptive.begin(), telemetry.adaptive.end());
  message.thrust = allocation.requested.thrust;
  message.moment = toVector3(allocation.requested.moment);
  message.thrust_achieved = allocation.achieved.thrust;
  message.moment_achieved = toVector3(allocation.achieved.moment);
  message.saturated = allocation.saturated;
  message.rotor_speeds.assign(allocation.speeds.begin(), allocation.speeds.end());
}

FlightSample toSample(const msgs::ControllerState& message) {
  FlightSample sample;
  Telemetry& telemetry = sample.telemetry;
  Allocation& allocation = sample.allocation;
  sample.time = toNanoseconds(message.header.stamp);
  sample.flying = message.flying;
  sample.state.position = toEigen(message.position);
  sample.state.attitude = toEigen(message.attitude);
  sample.state.velocity = toEigen(message.velocity);
  sample.state.body_rate = toEigen(message.body_rate);
  sample.set_point.position = toEigen(message.desired_position);
  sample.set_point.velocity = toEigen(message.desired_velocity);
  sample.set_point.acceleration = toEigen(message.desired_acceleration);
  sample.set_point.yaw = message.desired_yaw;
  sample.set_point.yaw_rate = message.desired_yaw_rate;
  telemetry.desired_attitude = toEigen(message.desired_attitude);
  telemetry.position_error = toEigen(message.position_error);
  telemetry.velocity_error = toEigen(message.velocity_error);
  telemetry.attitude_error = toEigen(message.attitude_error);
  telemetry.rate_error = toEigen(message.rate_error);
  telemetry.sliding_position = toEigen(message.sliding_position);
  telemetry.sliding_attitude = toEigen(message.sliding_attitude);
  telemetry.force = toEigen(message.force);
  telemetry.mass_estimate = message.mass_estimate;
  telemetry.weighed_mass = message.weighed_mass;
  telemetry.adaptive = Eigen::Map<const Eigen::VectorXd>(
      message.adaptive_values.data(), static_cast<Eigen::Index>(message.adaptive_values.size()));
  allocation.requested = {message.thrust, toEigen(message.moment)};
  allocation.achieved = {message.thrust_achieved, toEigen(message.moment_achieved)};
  allocation.saturated = message.saturated;
  allocation.speeds = Eigen::Map<const Eigen::VectorXd>(
      message.rotor_speeds.data(), static_cast<Eigen::Index>(message.rotor_speeds.size()));
  return sample;
}

void fill(const std::vector<AdaptiveQuantity>& quantities, msgs::ControllerState& message) {
  message.adaptive_names.clear();
  message.adaptive_units.clear();
  for (const AdaptiveQuantity& quantity : quantities) {
    message.adaptive_names.push_back(quantity.name);
    message.adaptive_units.push_back(quantity.unit);
  }
}

std::vector<AdaptiveQuantity> toQuantities(const msgs::ControllerState& message) {
  std::vector<AdaptiveQuantity> quantities;
  for (const std::string& name : message.adaptive_names) quantities.push_back({name, ""});
  const std::size_t units = std::min(quantities.size(), message.adaptive_units.size());
  for (std::size_t i = 0; i < units; ++i) quantities[i].unit = message.adaptive_units[i];
  return quantities;
}

StepReport toReport(const msgs::ControllerState& message) {
  StepReport report;
  report.sample = toSample(message);
  report.controller = message.controller;
  report.adaptive_quantities = toQuantities(message);
  report.plan_stamp = toNanoseconds(message.trajectory_stamp);
  report.objections = {message.switch_refusals, message.refused_subsystem, message.switch_refusal,
                       toNanoseconds(message.next_switch_allowed)};
  return report;
}

Truth toTruth(const msgs::PlantStatus& message) {
  Truth truth;
  truth.time = toNanoseconds(message.header.stamp);
  truth.payload_mass = message.payload_mass;
  truth.touching = message.touching;
  truth.disturbance = {toEigen(message.disturbance_force), toEigen(message.disturbance_moment)};
  if (message.crashed) truth.crash_time = toNanoseconds(message.crash_time);
  truth.crash_reason = message.crash_reason;
  return truth;
}

}  // namespace aqc
