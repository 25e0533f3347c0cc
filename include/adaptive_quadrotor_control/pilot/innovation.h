#pragma once

#include "adaptive_quadrotor_control/model/state.h"

namespace aqc {

/// How far one state is from another one, as an estimator speaks of odometry and what it expected.
struct Innovation {
  Eigen::Vector3d position;  ///< in W [m]
  Eigen::Vector3d velocity;  ///< in W [m/s]
  /// From the expected attitude to the other, in its B: about its axis, twice the sine of half the
  /// angle, which is the angle of small turns [rad]. The shorter way round.
  Eigen::Vector3d turned;
};

inline Innovation innovationOf(const State& said, const State& expected) noexcept {
  const Eigen::Quaterniond apart = expected.attitude.conjugate() * said.attitude;
  const double sign = apart.w() < 0.0 ? -2.0 : 2.0;
  return {said.position - expected.position, said.velocity - expected.velocity, sign * apart.vec()};
}

}  // namespace aqc
