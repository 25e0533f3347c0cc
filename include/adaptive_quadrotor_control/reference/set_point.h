#pragma once

#include <Eigen/Core>

namespace aqc {

/// Where the vehicle should be now: the desired trajectory p_d, psi_d of the thesis at one time.
struct SetPoint {
  Eigen::Vector3d position = Eigen::Vector3d::Zero();      ///< p_d in W [m]
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero();      ///< in W [m/s]
  Eigen::Vector3d acceleration = Eigen::Vector3d::Zero();  ///< in W [m/s^2]
  Eigen::Vector3d jerk = Eigen::Vector3d::Zero();          ///< in W [m/s^3]
  double yaw = 0.0;                                        ///< psi_d [rad], any branch
  double yaw_rate = 0.0;                                   ///< [rad/s]
  double yaw_acceleration = 0.0;                           ///< [rad/s^2]

  /// Whether every number is finite. Asked in every step of a guard: zero times a number that is
  /// not finite is no zero, and sums need no branch.
  bool valid() const noexcept {
    const Eigen::Vector3d none = 0.0 * position + 0.0 * velocity + 0.0 * acceleration + 0.0 * jerk;
    return none.sum() + 0.0 * yaw + 0.0 * yaw_rate + 0.0 * yaw_acceleration == 0.0;
  }
};

}  // namespace aqc
