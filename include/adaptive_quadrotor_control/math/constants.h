#pragma once

namespace aqc {

/// Standard gravity as the thesis and RotorS use it [m/s^2]; it acts along -z of the world W.
constexpr double kGravity = 9.81;

}  // namespace aqc
