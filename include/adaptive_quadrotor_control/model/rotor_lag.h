#pragma once

#include "adaptive_quadrotor_control/model/vehicle.h"

namespace aqc {

/// What is left after `dt` [s] of a rotor's distance from its command: exp(-dt / tau), and 0 for a
/// time constant tau of 0 [s].
double lagDecay(double dt, double time_constant) noexcept;

/// Where the rotors are, predicted from what they were told: each follows its command with the
/// vehicle's time constant up or down, d omega_i/dt = (omega_i,cmd - omega_i) / tau, solved exactly
/// for a command that is held.
class RotorLag {
 public:
  /// All rotors stand still.
  explicit RotorLag(const Vehicle& vehicle);

  /// The rotors turn for `dt` seconds (> 0) under the speeds of `command` [rad/s]. A time constant
  /// of 0 makes a rotor that is where it is told at once. Allocates nothing, never throws.
  void turn(const RotorArray& command, double dt) noexcept;

  /// What to tell the rotors for the next `dt` seconds (> 0) so that they come to where they should
  /// be, `command` [rad/s], sooner: omega + lead (command - omega), within [0, most]. `lead` is >=
  /// 1, where 1 changes nothing. None goes beyond its place within `dt`, so that a rotor without a
  /// lag is told its place.
  void lead(RotorArray& command, double lead, double most, double dt) noexcept;

  const RotorArray& speeds() const noexcept { return speeds_; }  ///< omega_i [rad/s]

 private:
  void prepare(double dt) noexcept;

  double time_constant_up_;    // [s]
  double time_constant_down_;  // [s]
  RotorArray speeds_;
  double dt_ = 0.0;  // that the decays belong to [s]
  double decay_up_ = 0.0;
  double decay_down_ = 0.0;
};

}  // namespace aqc
