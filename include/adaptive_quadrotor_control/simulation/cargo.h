#pragma once

#include <Eigen/Core>
#include <string>

#include "adaptive_quadrotor_control/simulation/payload.h"

namespace aqc {

/// A payload on its own: it rests where it was put or falls until it meets the ground, if any.
struct Cargo {
  std::string name;
  Payload payload;
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  ///< of its centre, in W [m]
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero();  ///< in W [m/s]

  /// Free fall for `dt` seconds, without air drag and without turning; with `ground` at z = 0 it
  /// stays where it lands.
  void fall(double dt, bool ground) noexcept;
};

}  // namespace aqc
