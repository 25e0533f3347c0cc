#pragma once

#include <cmath>

namespace aqc {

/// A quantity with the leaky adaptive law dK/dt = u - alpha K (thesis adap_out, q_adap_K).
///
/// Integrated exactly for a drive that is constant over the step, so that the gain is independent
/// of how a time span is cut into steps and stays >= 0 for u >= 0 and K(0) >= 0 at any step size.
class AdaptiveGain {
 public:
  /// `leak` is alpha [1/s], > 0.
  AdaptiveGain(double initial, double leak) : initial_(initial), leak_(leak), value_(initial) {}

  double value() const noexcept { return value_; }
  void reset() noexcept { value_ = initial_; }
  /// Goes on from `value`; initial value and leak stay.
  void adopt(double value) noexcept { value_ = value; }

  /// Integrates the drive u over `dt` seconds.
  void step(double drive, double dt) noexcept {
    if (dt != dt_) {  // a fixed rate pays for the exponential once
      dt_ = dt;
      decay_ = std::exp(-leak_ * dt);
      rise_ = -std::expm1(-leak_ * dt) / leak_;
    }
    value_ = decay_ * value_ + rise_ * drive;
  }

 private:
  double initial_;
  double leak_;
  double value_;
  double dt_ = 0.0;
  double decay_ = 1.0;
  double rise_ = 0.0;
};

}  // namespace aqc
