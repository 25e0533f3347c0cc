#pragma once

#include <algorithm>
#include <cmath>

#include "adaptive_quadrotor_control/math/rotations.h"
#include "adaptive_quadrotor_control/model/state.h"
#include "adaptive_quadrotor_control/reference/set_point.h"

namespace aqc {

// Terms in which the sources of Guard talk about a vehicle.

constexpr double kNear = 0.3;      // [m] above the ground: close to it
constexpr double kSettling = 0.1;  // [s], part of touch_down_time: what does not sink stands

inline double yaw(const Eigen::Quaterniond& attitude) noexcept {
  return rollPitchYaw(attitude).z();
}

inline double tilt(const State& state) noexcept {
  return std::acos(std::clamp(uprightness(state.attitude), -1.0, 1.0));
}

inline SetPoint standing(const State& state) noexcept {
  SetPoint place;
  place.position = state.position;
  place.yaw = yaw(state.attitude);
  return place;
}

}  // namespace aqc
