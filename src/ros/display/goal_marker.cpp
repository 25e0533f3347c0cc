#include "ros/display/goal_marker.h"

#include <cmath>
#include <string>

#include "adaptive_quadrotor_control/math/rotations.h"
#include "ros/display/marker_parts.h"

namespace aqc {
namespace {

using visualization_msgs::InteractiveMarkerControl;

constexpr double kSize = 0.9;   // [m]
constexpr double kBall = 0.11;  // [m]

// A control acts along, around or across the x axis of its frame.
InteractiveMarkerControl control(const std::string& name, unsigned char mode,
                                 const Eigen::Vector3d& axis) {
  InteractiveMarkerControl result;
  result.name = name;
  result.orientation =
      toQuaternion(Eigen::Quaterniond::FromTwoVectors(Eigen::Vector3d::UnitX(), axis));
  result.orientation_mode = InteractiveMarkerControl::FIXED;
  result.interaction_mode = mode;
  return result;
}

InteractiveMarkerControl ball() {
  InteractiveMarkerControl result =
      control("plane", InteractiveMarkerControl::MOVE_PLANE, Eigen::Vector3d::UnitZ());
  result.always_visible = true;
  visualization_msgs::Marker sphere =
      marker("", "", 0, visualization_msgs::Marker::SPHERE, colour(0.35, 0.85, 1.0, 0.8));
  sphere.scale.x = sphere.scale.y = sphere.scale.z = kBall;
  result.markers.push_back(sphere);
  return result;
}

}  // namespace

visualization_msgs::InteractiveMarker goalMarker(const SetPoint& set_point) {
  visualization_msgs::InteractiveMarker goal;
  goal.header.frame_id = kWorldFrame;
  goal.name = kGoalName;
  goal.description = "";
  goal.scale = static_cast<float>(kSize);
  goal.pose.position = toPoint(set_point.position);
  goal.pose.orientation = toQuaternion(yawRotation(set_point.yaw));
  goal.controls = {control("x", InteractiveMarkerControl::MOVE_AXIS, Eigen::Vector3d::UnitX()),
                   control("y", InteractiveMarkerControl::MOVE_AXIS, Eigen::Vector3d::UnitY()),
                   control("z", InteractiveMarkerControl::MOVE_AXIS, Eigen::Vector3d::UnitZ()),
                   control("yaw", InteractiveMarkerControl::ROTATE_AXIS, Eigen::Vector3d::UnitZ()),
                   ball()};
  return goal;
}

}  // namespace aqc
