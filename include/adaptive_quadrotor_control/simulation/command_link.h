#pragma once

#include <cstdint>

#include "adaptive_quadrotor_control/math/time.h"
#include "adaptive_quadrotor_control/model/vehicle.h"
#include "adaptive_quadrotor_control/simulation/random.h"

namespace aqc {

/// The line from who commands the rotors to the rotors: commands get lost on it, and after a
/// silence the rotors are switched off, as motor drivers (ESC) do. What was heard last holds until
/// then. No clock is in it: whoever simulates says what time it is, which does not go back.
class CommandLink {
 public:
  /// For `rotors` rotors, which are commanded 0 until a command comes. `timeout` [ns]: a silence of
  /// that length is too long; 0: none is. Throws std::invalid_argument when it is < 0.
  CommandLink(Eigen::Index rotors, Nanoseconds timeout);

  /// From now on until `until` each command is lost with a probability of `share`, 0 to 1, by dice
  /// of that seed; in place of what was so before.
  void lose(double share, Nanoseconds until, std::uint64_t seed);
  /// A command [rad/s] is on its way at `now`: it is heard at once, or lost.
  void send(const RotorArray& command, Nanoseconds now);

  /// What the rotors are commanded at `now` [rad/s].
  const RotorArray& told(Nanoseconds now) const noexcept { return silent(now) ? off_ : last_; }
  /// Whether they are commanded 0 because the last command came too long ago.
  bool silent(Nanoseconds now) const noexcept {
    return timeout_ > 0 && heard_any_ && now - heard_ >= timeout_;
  }

 private:
  RotorArray off_;
  RotorArray last_;  // that was heard
  Nanoseconds timeout_;
  Nanoseconds heard_ = 0;  // when
  bool heard_any_ = false;
  double lost_share_ = 0.0;
  Nanoseconds lost_until_ = 0;
  Random dice_{0};
};

}  // namespace aqc
