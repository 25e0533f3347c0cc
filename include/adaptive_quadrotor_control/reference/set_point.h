#pragma once

#include <Eigen/Core>
#include <cmath>

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

  bool valid() const noexcept {
    return position.allFinite() && velocity.allFinite() && acceleration.allFinite() &&
           jerk.allFinite() && std::isfinite(yaw) && std::isfinite(yaw_rate) &&
           std::isfinite(yaw_acceleration);
  }
};

}  // namespace aqc
