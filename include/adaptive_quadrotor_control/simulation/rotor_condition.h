#pragma once

#include <optional>

namespace aqc {

/// What is wrong with a rotor; by default nothing.
struct RotorCondition {
  /// Share of thrust and drag moment that it still gives at its speed, 0 to 1: e k_f omega^2 and
  /// e k_m k_f omega^2, as of a blade that is broken or iced. What the air does to it across its
  /// axis (drag_coefficient, rolling_moment_coefficient) stays whole.
  double effectiveness = 1.0;
  /// It turns at this speed [rad/s], >= 0, from now on, whatever is commanded: a motor that is
  /// blocked (0) or whose driver hangs. Clamped to what a rotor of a full battery can do.
  std::optional<double> stuck_at;
  /// Both its time constants are so many times the vehicle's, >= 1.
  double slower = 1.0;

  bool sound() const noexcept { return effectiveness == 1.0 && !stuck_at && slower == 1.0; }
};

}  // namespace aqc
