#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

namespace aqc {

/// A quantity with the leaky adaptive law dK/dt = u - alpha K (thesis adap_out, q_adap_K).
///
/// Integrated exactly for a drive that is constant over the step, so that the gain is independent
/// of how a time span is cut into steps and stays >= 0 for u >= 0 and K(0) >= 0 at any step size.
/// Without bounds unless they are asked for; with bounds it is projected onto them, which for a
/// constant drive is independent of the steps, too.
class AdaptiveGain {
 public:
  /// `leak` is alpha [1/s], > 0.
  AdaptiveGain(double initial, double leak) : initial_(initial), leak_(leak), value_(initial) {}

  double value() const noexcept { return value_; }
  void reset() noexcept { set(initial_); }
  /// Goes on from `value`; initial value, leak and bounds stay.
  void adopt(double value) noexcept { set(value); }
  /// From here on the value is in [least, most]; needs least <= most.
  void bound(double least, double most) noexcept {
    least_ = least;
    most_ = most;
    set(value_);
  }

  /// Integrates the drive u over `dt` seconds.
  void step(double drive, double dt) noexcept {
    if (dt != dt_) {  // a fixed rate pays for the exponential once
      dt_ = dt;
      decay_ = std::exp(-leak_ * dt);
      rise_ = -std::expm1(-leak_ * dt) / leak_;
    }
    set(decay_ * value_ + rise_ * drive);
  }

 private:
  // Not-a-number stays, for whoever looks whether all is well.
  void set(double value) noexcept { value_ = std::min(std::max(value, least_), most_); }

  double initial_;
  double leak_;
  double value_;
  double least_ = -std::numeric_limits<double>::infinity();
  double most_ = std::numeric_limits<double>::infinity();
  double dt_ = 0.0;
  double decay_ = 1.0;
  double rise_ = 0.0;
};

}  // namespace aqc
