#pragma once

#include <Eigen/Core>

#include "adaptive_quadrotor_control/reference/set_point.h"

namespace aqc {

/// A level circle that begins at rest.
struct Circle {
  Eigen::Vector3d start = Eigen::Vector3d::Zero();   ///< where it begins, in W [m]
  Eigen::Vector2d centre = Eigen::Vector2d::Zero();  ///< [m]
  double rate = 0.0;                                 ///< psi' [rad/s], > 0: counter-clockwise
  double ease = 0.0;  ///< until it has that rate [s], >= 0; 0: at once
};

/// Position to jerk `time` seconds (>= 0) after the start; yaw is 0. The rate grows as 3 x^2 - 2
/// x^3 of the share x of `ease` that has passed, so that the acceleration is continuous.
SetPoint onCircle(const Circle& circle, double time) noexcept;

}  // namespace aqc
