#pragma once

#include <Eigen/Core>
#include <cmath>

namespace aqc {

/// Derivative of a sampled vector behind a first-order low-pass.
///
/// The difference quotient of the last two samples goes through 1 / (1 + s / (2 pi f)), exact for a
/// quotient that is constant over the step. On a ramp it settles at the slope; it lags a growing
/// slope by 1 / (2 pi f) seconds plus half a step. The first sample gives 0.
class FilteredDerivative {
 public:
  /// `cut_off` is f [Hz], > 0.
  explicit FilteredDerivative(double cut_off) : rate_(2.0 * M_PI * cut_off) {}

  /// The next sample, `dt` seconds (> 0) after the last one.
  void step(const Eigen::Vector3d& sample, double dt) noexcept {
    if (dt != dt_) {  // a fixed rate pays for the exponential once
      dt_ = dt;
      share_ = -std::expm1(-rate_ * dt);
    }
    if (started_) value_ += share_ * ((sample - last_) / dt - value_);
    started_ = true;
    last_ = sample;
  }

  const Eigen::Vector3d& value() const noexcept { return value_; }

  /// Goes on from the last sample and value of `old`; the cut-off stays.
  void adopt(const FilteredDerivative& old) noexcept {
    started_ = old.started_;
    last_ = old.last_;
    value_ = old.value_;
  }

  void reset() noexcept {
    started_ = false;
    value_.setZero();
  }

 private:
  double rate_;  // [rad/s]
  double dt_ = 0.0;
  double share_ = 0.0;
  bool started_ = false;
  Eigen::Vector3d last_ = Eigen::Vector3d::Zero();
  Eigen::Vector3d value_ = Eigen::Vector3d::Zero();
};

}  // namespace aqc
