#include "adaptive_quadrotor_control/law/attitude.h"

#include <algorithm>
#include <cmath>

#include "adaptive_quadrotor_control/math/rotations.h"
#include "law/within.h"

namespace aqc {
namespace {

constexpr double kMostTurn = 3.0;     // [rad/s]
constexpr double kLeastForce = 1e-3;  // [N]: less has no direction to follow

Eigen::Vector3d angleError(const Eigen::Matrix3d& relative, AttitudeErrorKind kind) {
  if (kind == AttitudeErrorKind::kThesis) {
    return kAttitudeErrorScale * vee(relative - relative.transpose());
  }
  const Eigen::Quaterniond turn(relative);
  return std::copysign(2.0, turn.w()) * turn.vec();
}

// The force's direction within the limits.
Eigen::Vector3d thrustDirection(const Eigen::Vector3d& force, const TiltLimits& limits) {
  const double vertical =
      std::max({force.z(), limits.min_lift, force.head<2>().norm() * limits.least_ratio});
  const Eigen::Vector3d limited(force.x(), force.y(), vertical);
  const double norm = limited.norm();
  return std::isfinite(norm) ? Eigen::Vector3d(limited / norm) : Eigen::Vector3d::UnitZ();
}

}  // namespace

Eigen::Matrix3d desiredAttitude(const Eigen::Vector3d& force, double yaw,
                                const TiltLimits& limits) noexcept {
  const Eigen::Vector3d z_body = thrustDirection(force, limits);
  const Eigen::Vector3d y_intermediate(-std::sin(yaw), std::cos(yaw), 0.0);
  // z_body is never level (max_tilt < pi/2), so this product cannot vanish.
  const Eigen::Vector3d x_body = y_intermediate.cross(z_body).normalized();
  Eigen::Matrix3d desired;
  desired << x_body, z_body.cross(x_body), z_body;
  return desired;
}

AttitudeErrors attitudeErrors(const State& state, const Eigen::Matrix3d& desired, double yaw_rate,
                              AttitudeErrorKind kind) noexcept {
  const Eigen::Matrix3d R = state.attitude.toRotationMatrix();
  const Eigen::Matrix3d relative = desired.transpose() * R;  // R_d' R
  AttitudeErrors errors;
  errors.angle = angleError(relative, kind);
  // omega_d = R_d' (0, 0, dpsi_d), so R' R_d omega_d is the third row of R times the yaw rate.
  errors.rate = state.body_rate - R.row(2).transpose() * yaw_rate;
  return errors;
}

Eigen::Vector3d turnOf(const Eigen::Vector3d& force, const Eigen::Vector3d& change) noexcept {
  const double norm = std::max(force.norm(), kLeastForce);
  return within((force / norm).cross(change / norm), kMostTurn);
}

}  // namespace aqc
