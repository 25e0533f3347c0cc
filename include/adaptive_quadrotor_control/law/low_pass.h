#pragma once

#include <cmath>

namespace aqc {

/// What a first-order lag does in a step, its exponential kept for steps of the same length.
class LowPass {
 public:
  /// `time_constant` [s], > 0.
  explicit LowPass(double time_constant) : time_constant_(time_constant) {}

  /// The share of the way to a constant input that it goes in `dt` [s]: 1 - exp(-dt / tau).
  double share(double dt) noexcept {
    if (dt != dt_) {
      dt_ = dt;
      share_ = -std::expm1(-dt / time_constant_);
    }
    return share_;
  }
  /// What is left of the way: exp(-dt / tau).
  double rest(double dt) noexcept { return 1.0 - share(dt); }

 private:
  double time_constant_;
  double dt_ = 0.0;
  double share_ = 0.0;
};

}  // namespace aqc
