#pragma once

#include <Eigen/Core>

#include "adaptive_quadrotor_control/model/state.h"
#include "adaptive_quadrotor_control/model/vehicle.h"

namespace aqc {

/// What the rotors are told, and what that really gives.
struct Allocation {
  RotorArray speeds;  ///< omega_i [rad/s], in [0, omega_max]
  Wrench requested;   ///< what the control law asked for
  /// What the rotors are to reach: what `speeds` give in the end or, when they are told to hurry
  /// (see RotorLag::lead()), what those give that were allocated.
  Wrench achieved;
  bool saturated = false;  ///< true when achieved differs from requested
};

/// Turns a wrench into rotor speeds and back (thesis chapter 1, with omega_i squared throughout).
///
/// Rotor i at angle a_i and arm length l gives, per squared speed: thrust k_f; roll k_f l sin(a_i);
/// pitch -k_f l cos(a_i); yaw -dir_i k_f k_m. The inverse is the least-squares one (Moore-Penrose).
///
/// When a request cannot be met, it gives way in this order: yaw moment first, then thrust (raised
/// or lowered just enough to leave room for roll and pitch: a vehicle that cannot tilt falls over,
/// one that lifts too little merely sinks), roll and pitch last, keeping their direction.
class RotorAllocation {
 public:
  explicit RotorAllocation(const Vehicle& vehicle);

  /// False when the rotors cannot give thrust, roll, pitch and yaw independently.
  bool wellPosed() const;

  /// Never fails; a request that is not finite, or so large that its numbers overflow, gives zero
  /// speeds, reported as saturated.
  Allocation allocate(const Wrench& request) const noexcept;
  /// The same, into an allocation that is there already.
  void allocate(const Wrench& request, Allocation& result) const noexcept;

  /// The most thrust [N] that leaves room for the roll and pitch of a moment [N m], yaw giving way;
  /// 0 where there is no room even so.
  double mostThrust(const Eigen::Vector3d& moment) const noexcept;

  /// The wrench of given rotor speeds [rad/s].
  Wrench wrench(const RotorArray& speeds) const noexcept;

 private:
  using Forward = Eigen::Matrix<double, 4, Eigen::Dynamic, Eigen::ColMajor, 4, kMaxRotors>;
  using Inverse = Eigen::Matrix<double, Eigen::Dynamic, 4, Eigen::ColMajor, kMaxRotors, 4>;

  template <int Rotors>
  void allocate(const Wrench& request, Allocation& result) const noexcept;
  void fit(const Wrench& request, RotorArray& squared) const noexcept;

  Forward forward_;           // squared speeds to (thrust, roll, pitch, yaw)
  Inverse inverse_;           // its pseudo-inverse
  double max_squared_speed_;  // omega_max^2
};

}  // namespace aqc
