#include "ros/waypoints/waypoint_node.h"

#include <tf2_geometry_msgs/tf2_geometry_msgs.h>

#include <cmath>
#include <stdexcept>

#include "adaptive_quadrotor_control/reference/braking.h"
#include "adaptive_quadrotor_control/reference/sampling.h"
#include "ros/border/names.h"
#include "ros/border/parameter_tree.h"
#include "ros/border/run_node.h"

namespace aqc {
namespace {

constexpr double kTransformPatience = 0.2;  // [s]

Eigen::Vector4d withYaw(const Eigen::Vector3d& vector, double yaw) {
  return {vector.x(), vector.y(), vector.z(), yaw};
}

}  // namespace

WaypointNode::WaypointNode() {
  const ParameterReader own = parameterReader(private_node_, "");
  limits_.speed = own.number("speed", Range::positiveUpTo(50.0), 2.0);
  limits_.acceleration = own.number("acceleration", Range::positiveUpTo(50.0), 2.0);
  limits_.tilt = own.angle("max_tilt_deg", Range::positiveUpTo(80.0), M_PI / 6.0);
  limits_.thrust_to_weight = own.number("thrust_to_weight", Range{1.0, 10.0, true}, 1.5);
  flight_limits_ = limits_;
  set_point_period_ =
      fromSeconds(1.0 / own.number("set_point_rate", Range::between(1.0, 1000.0), 100.0));
  own.finish();

  trajectory_publisher_ =
      node_.advertise<trajectory_msgs::MultiDOFJointTrajectory>(kTrajectoryTopic, 1);
  progress_publisher_ = private_node_.advertise<msgs::PathProgress>("progress", 10, true);
  const auto fast = ros::TransportHints().tcpNoDelay();
  subscribers_ = {
      node_.subscribe("waypoints", 10, &WaypointNode::onPath, this, fast),
      node_.subscribe<nav_msgs::Odometry>(
          kOdometryTopic, 1, [this](const nav_msgs::Odometry::ConstPtr& m) { odometry_ = m; },
          ros::VoidConstPtr(), fast),
      node_.subscribe<msgs::ControllerState>(
          kStateTopic, 1, [this](const msgs::ControllerState::ConstPtr& m) { controller_ = m; },
          ros::VoidConstPtr(), fast)};
  services_ = {private_node_.advertiseService("fly_path", &WaypointNode::onFlyPath, this),
               private_node_.advertiseService("cancel", &WaypointNode::onCancel, this)};
  timer_ = node_.createTimer(ros::Duration(0.1), &WaypointNode::onTimer, this);
}

Waypoint WaypointNode::presentWaypoint() const {
  Waypoint present;
  if (controller_ && controller_->flying) {
    present.position = toEigen(controller_->desired_position);
    present.yaw = controller_->desired_yaw;
    present.velocity =
        withYaw(toEigen(controller_->desired_velocity), controller_->desired_yaw_rate);
    present.acceleration = withYaw(toEigen(controller_->desired_acceleration), 0.0);
  } else if (odometry_) {
    present.position = toEigen(odometry_->pose.pose.position);
    present.yaw = toSetPoint(odometry_->pose.pose, "the odometry").yaw;
  } else {
    throw std::invalid_argument("no odometry has arrived yet; where to begin is unknown");
  }
  return present;
}

std::vector<Waypoint> WaypointNode::toWaypoints(const nav_msgs::Path& path) const {
  if (path.poses.empty()) throw std::invalid_argument("the path has no poses");
  geometry_msgs::TransformStamped to_world;
  const std::string& frame = path.header.frame_id;
  const bool transform = !frame.empty() && frame != kWorldFrame;
  if (transform) {
    try {
      to_world = transforms_.lookupTransform(kWorldFrame, frame, ros::Time(0),
                                             ros::Duration(kTransformPatience));
    } catch (const tf2::TransformException& error) {
      throw std::invalid_argument("the path's frame '" + frame +
                                  "' is not known in the world: " + error.what());
    }
  }
  std::vector<Waypoint> waypoints;
  for (std::size_t i = 0; i < path.poses.size(); ++i) {
    geometry_msgs::Pose pose = path.poses[i].pose;
    if (transform) tf2::doTransform(pose, pose, to_world);
    const SetPoint set_point = toSetPoint(pose, "pose " + std::to_string(i) + " of the path");
    waypoints.emplace_back();
    waypoints.back().position = set_point.position;
    waypoints.back().yaw = set_point.yaw;
  }
  return waypoints;
}

double WaypointNode::fly(const nav_msgs::Path& path, const MotionLimits& limits) {
  std::vector<Waypoint> waypoints = toWaypoints(path);
  waypoints.insert(waypoints.begin(), presentWaypoint());
  const PolynomialTrajectory trajectory = minimumSnapWithin(waypoints, limits);
  send(trajectory, msgs::PathProgress::FLYING);
  flight_limits_ = limits;
  return trajectory.duration();
}

void WaypointNode::send(const PolynomialTrajectory& trajectory, std::uint8_t phase) {
  const ros::Time begin = ros::Time::now();
  const std::vector<TimedSetPoint> set_points =
      sample(trajectory, toNanoseconds(begin), set_point_period_);
  begin_ = begin;
  duration_ = trajectory.duration();
  phase_ = phase;
  trajectory_publisher_.publish(toTrajectory(set_points, toNanoseconds(begin)));
}

void WaypointNode::onPath(const nav_msgs::Path::ConstPtr& path) {
  try {
    fly(*path, limits_);
  } catch (const std::invalid_argument& error) {
    ROS_WARN("path refused: %s", error.what());
  }
}

bool WaypointNode::onFlyPath(msgs::FlyPath::Request& request, msgs::FlyPath::Response& response) {
  MotionLimits limits = limits_;
  if (request.speed != 0.0) limits.speed = request.speed;
  if (request.acceleration != 0.0) limits.acceleration = request.acceleration;
  try {
    response.duration = fly(request.path, limits);
    response.success = true;
  } catch (const std::invalid_argument& error) {
    response.success = false;
    response.message = error.what();
  }
  return true;
}

bool WaypointNode::onCancel(std_srvs::Trigger::Request&, std_srvs::Trigger::Response& response) {
  if (phase_ != msgs::PathProgress::FLYING) {
    response.success = false;
    response.message = "no path is being flown";
    return true;
  }
  try {
    const PolynomialTrajectory stop = brakeWithin(presentWaypoint(), flight_limits_);
    send(stop, msgs::PathProgress::CANCELLED);
    const FlatOutput begin = stop.evaluate(0.0);
    const FlatOutput end = stop.evaluate(stop.duration());
    const double distance = (end.derivative[0] - begin.derivative[0]).head<3>().norm();
    response.success = true;
    response.message = formatted("stops in %.2f s, %.2f m from here", stop.duration(), distance);
  } catch (const std::invalid_argument& error) {
    response.success = false;
    response.message = error.what();
  }
  return true;
}

void WaypointNode::onTimer(const ros::TimerEvent&) {
  const ros::Time now = ros::Time::now();
  // The controller begins anew, too, and has forgotten the path.
  if (startedAnew(toNanoseconds(begin_), toNanoseconds(now))) phase_ = msgs::PathProgress::IDLE;
  const double elapsed = (now - begin_).toSec();
  if (phase_ == msgs::PathProgress::FLYING && elapsed >= duration_) {
    phase_ = msgs::PathProgress::DONE;
  }
  msgs::PathProgress progress;
  progress.header.stamp = now;
  progress.phase = phase_;
  if (phase_ != msgs::PathProgress::IDLE) {
    progress.fraction = duration_ > 0.0 ? std::min(1.0, elapsed / duration_) : 1.0;
    progress.remaining = std::max(0.0, duration_ - elapsed);
  }
  progress_publisher_.publish(progress);
}

}  // namespace aqc

int main(int argc, char** argv) {
  return aqc::spinNode<aqc::WaypointNode>(argc, argv, "waypoints");
}
