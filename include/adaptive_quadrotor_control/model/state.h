#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cmath>

#include "adaptive_quadrotor_control/math/constants.h"

namespace aqc {

/// Motion of a rigid body. W is the ENU world, B the FLU body (REP-103).
struct State {
  Eigen::Vector3d position = Eigen::Vector3d::Zero();            ///< p, origin of B in W [m]
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero();            ///< dp/dt in W [m/s]
  Eigen::Quaterniond attitude = Eigen::Quaterniond::Identity();  ///< R_B^W, unit norm
  Eigen::Vector3d body_rate = Eigen::Vector3d::Zero();  ///< omega of B against W, in B [rad/s]

  /// True when every number is finite and the attitude is a unit quaternion within 1e-3.
  bool valid() const noexcept {
    return position.allFinite() && velocity.allFinite() && body_rate.allFinite() &&
           attitude.coeffs().allFinite() && std::abs(attitude.norm() - 1.0) < 1e-3;
  }
};

/// What the rotors do to the body together.
struct Wrench {
  double thrust = 0.0;                               ///< u_1, along +z of B [N]
  Eigen::Vector3d moment = Eigen::Vector3d::Zero();  ///< tau_q = (u_2, u_3, u_4), in B [N m]
};

}  // namespace aqc
