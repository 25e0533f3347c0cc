#pragma once

#include <cmath>

namespace aqc {

/// Standard gravity as the thesis and RotorS use it [m/s^2]; it acts along -z of the world W.
constexpr double kGravity = 9.81;

constexpr double kDegree = M_PI / 180.0;  ///< [rad]

}  // namespace aqc
