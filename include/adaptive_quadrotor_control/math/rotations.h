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

/// The vertical part of the body's z axis, 1 when it is level; `attitude` of unit norm.
inline double uprightness(const Eigen::Quaterniond& attitude) noexcept {
  return 1.0 - 2.0 * (attitude.x() * attitude.x() + attitude.y() * attitude.y());
}

/// Brings a norm that rounding has moved from 1 back, without a root (a step of Newton's method).
inline void keepUnit(Eigen::Quaterniond& attitude) noexcept {
  attitude.coeffs() *= 1.5 - 0.5 * attitude.squaredNorm();
}

/// Roll, pitch, yaw (phi, theta, psi) [rad] of the Z-Y-X convention (thesis eq. rot_matrix);
/// pitch in [-pi/2, pi/2].
inline Eigen::Vector3d rollPitchYaw(const Eigen::Quaterniond& attitude) {
  const Eigen::Matrix3d R = attitude.toRotationMatrix();
  return {std::atan2(R(2, 1), R(2, 2)), std::asin(std::min(1.0, std::max(-1.0, -R(2, 0)))),
          std::atan2(R(1, 0), R(0, 0))};
}

/// The turn of a body that spins at `rate` [rad/s], in its own frame, for `dt` seconds: a unit
/// quaternion.
inline Eigen::Quaterniond turn(const Eigen::Vector3d& rate, double dt) noexcept {
  constexpr double kSmall = 2.5e-3;  // of half the angle, squared: 0.05 rad
  const double squared = 0.25 * dt * dt * rate.squaredNorm();  // of half the angle
  double cosine, scale;
  if (squared < kSmall) {  // series that are exact there, for the time of sines and cosines
    cosine = 1.0 - squared / 2.0 * (1.0 - squared / 12.0 * (1.0 - squared / 30.0));
    scale = 0.5 * dt * (1.0 - squared / 6.0 * (1.0 - squared / 20.0 * (1.0 - squared / 42.0)));
  } else {
    const double half = std::sqrt(squared);
    cosine = std::cos(half);
    scale = 0.5 * dt * std::sin(half) / half;
  }
  return {cosine, scale * rate.x(), scale * rate.y(), scale * rate.z()};
}

}  // namespace aqc
