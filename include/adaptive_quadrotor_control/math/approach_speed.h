#pragma once

#include <cmath>

namespace aqc {

/// A speed to approach a place with, and how it changes with the distance.
struct ApproachSpeed {
  double speed;  ///< [m/s], or [rad/s]
  double slope;  ///< [1/s], >= 0
};

/// From which `braking` (> 0) stops at the place: proportional to the distance (>= 0) by `gain`
/// [1/s] (> 0) up to braking / gain^2, and so that it brakes evenly further away; both meet
/// smoothly.
inline ApproachSpeed approachSpeed(double distance, double gain, double braking) noexcept {
  const double linear = braking / (gain * gain);
  if (distance <= linear) return {gain * distance, gain};
  const double speed = std::sqrt(2.0 * braking * (distance - 0.5 * linear));
  return {speed, braking / speed};
}

}  // namespace aqc
