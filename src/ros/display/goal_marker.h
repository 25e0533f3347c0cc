#pragma once

#include <visualization_msgs/InteractiveMarker.h>

#include "adaptive_quadrotor_control/reference/set_point.h"

namespace aqc {

/// The handle of the goal in rviz: arrows along x, y, z, a ring for the yaw, a ball to be dragged
/// in the horizontal plane. In `world`, at the set point; its name is kGoalName.
visualization_msgs::InteractiveMarker goalMarker(const SetPoint& set_point);

constexpr const char* kGoalName = "goal";

}  // namespace aqc
