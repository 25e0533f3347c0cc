#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace aqc {

/// Vee map: the vector v of a skew-symmetric matrix [v]x.
inline Eigen::Vector3d vee(const Eigen::Matrix3d& skew) {
  return {skew(2, 1), skew(0, 2), skew(1, 0)};
}

/// Rotation about the vertical by `yaw` [rad].
inline Eigen::Quaterniond yawRotation(double yaw) {
  return Eigen::Quaterniond(Eigen::AngleAxisd(yaw, Eigen::Vector3d::UnitZ()));
}

/// Roll, pitch, yaw (phi, theta, psi) [rad] of the Z-Y-X convention (thesis eq. rot_matrix);
/// pitch in [-pi/2, pi/2].
inline Eigen::Vector3d rollPitchYaw(const Eigen::Quaterniond& attitude) {
  const Eigen::Matrix3d R = attitude.toRotationMatrix();
  return {std::atan2(R(2, 1), R(2, 2)), std::asin(std::min(1.0, std::max(-1.0, -R(2, 0)))),
          std::atan2(R(1, 0), R(0, 0))};
}

}  // namespace aqc
