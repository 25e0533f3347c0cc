#pragma once

#include <Eigen/Core>
#include <cmath>

#include "adaptive_quadrotor_control/model/state.h"
#include "adaptive_quadrotor_control/reference/set_point.h"

namespace aqc {

/// e_q carries the factor 1/2 of Lee (2010), as in the thesis's flights; its text omits it.
constexpr double kAttitudeErrorScale = 0.5;

/// What is e_q. Both are the angle times the axis of R_d' R as long as the angle is small.
enum class AttitudeErrorKind {
  /// 1/2 (R_d' R - R' R_d)^vee: sin(angle) along the axis. From 90 deg on it falls and vanishes at
  /// 180 deg, where a vehicle at rest would stay for ever.
  kThesis,
  /// 2 sgn(w) v of the quaternion (w, v) of R_d' R: 2 sin(angle / 2) along the axis of the shorter
  /// turn, largest at 180 deg, where one of both ways round is taken.
  kQuaternion,
};

struct AttitudeErrors {
  Eigen::Vector3d angle = Eigen::Vector3d::Zero();  ///< e_q, in B [rad]
  Eigen::Vector3d rate = Eigen::Vector3d::Zero();   ///< de_q = omega - R' R_d omega_d, in B [rad/s]
};

/// Limits that keep assumption 2 of the thesis, |phi_d|, |theta_d| < pi/2, whatever force a law
/// asks for. Both raise the vertical part of the force for the attitude's sake only.
struct TiltLimits {
  TiltLimits(double tilt, double lift)
      : max_tilt(tilt), min_lift(lift), least_ratio(1.0 / std::tan(tilt)) {}

  double max_tilt;  ///< of the desired attitude [rad], in (0, pi/2)
  /// Least vertical force that decides the attitude [N], > 0. A law that asks for a dive asks for a
  /// small or downward force, whose direction is no attitude to fly.
  double min_lift;
  double least_ratio;  ///< of the vertical force to the horizontal one: that of max_tilt
};

/// The attitude R_d whose z axis points along the commanded force (thesis eq. int_co).
///
/// `force` is tau_p in W [N], `yaw` psi_d [rad]. Always a rotation, whatever the force: one that is
/// zero or not finite gives the level attitude at that yaw.
Eigen::Matrix3d desiredAttitude(const Eigen::Vector3d& force, double yaw,
                                const TiltLimits& limits) noexcept;

/// Errors of `state` against R_d, which turns about the vertical at `yaw_rate` [rad/s].
/// The thesis prints R_d' R omega_d for the second term of de_q, which is not in B.
AttitudeErrors attitudeErrors(const State& state, const Eigen::Matrix3d& desired, double yaw_rate,
                              AttitudeErrorKind kind = AttitudeErrorKind::kThesis) noexcept;

/// How fast the direction of `force` [N] turns while the force changes by `change` [N/s]:
/// F x F' / |F|^2, at most 3 [rad/s].
Eigen::Vector3d turnOf(const Eigen::Vector3d& force, const Eigen::Vector3d& change) noexcept;

}  // namespace aqc
