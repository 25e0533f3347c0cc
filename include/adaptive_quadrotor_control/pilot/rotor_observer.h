#pragma once

#include <Eigen/Core>

#include "adaptive_quadrotor_control/model/vehicle.h"

namespace aqc {

/// Tells when rotors do not deliver what they are told: what turns the body about x and y though no
/// rotor should, in units of what one rotor gives in a hover.
///
/// A momentum observer (De Luca and Mattone, "Actuator failure detection and isolation using
/// generalized momenta", ICRA 2003): the unexplained moment is what the momentum J omega is ahead
/// of the one integrated from the rotors' predicted moments, fed back. It follows the true one like
/// a filter of first order and needs no acceleration. All that pushes aside counts: a rotor that
/// lacks the share e of its thrust f gives e f l, a load m off by r gives m g r.
///
/// Thrust is not looked at: a body that falls behind its thrust may have lost rotors or picked up a
/// load, and from within nothing tells which. Nothing in it allocates or throws.
class RotorObserver {
 public:
  explicit RotorObserver(const Vehicle& vehicle);

  /// Begins anew with a body that turns at `body_rate` [rad/s] in B: nothing is unexplained.
  void restart(const Eigen::Vector3d& body_rate) noexcept;
  /// The body turns so after `dt` seconds (> 0) in which the rotors should have given `moment`
  /// [N m] in B.
  void observe(const Eigen::Vector3d& body_rate, const Eigen::Vector3d& moment, double dt) noexcept;

  /// The unexplained moment about x and y: that of so many rotors of the hovering, empty vehicle,
  /// >= 0.
  double missing() const noexcept { return unexplained_.head<2>().norm() * per_rotor_; }

 private:
  Eigen::Matrix3d inertia_;
  double per_rotor_;                                    // 1 / a hovering rotor's moment [1/(N m)]
  Eigen::Vector3d momentum_ = Eigen::Vector3d::Zero();  // as it should be [N m s]
  Eigen::Vector3d unexplained_ = Eigen::Vector3d::Zero();  // [N m]
};

}  // namespace aqc
