#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>

#include "adaptive_quadrotor_control/model/state.h"

namespace aqc {

/// What the rotors gave lately, as they are predicted to have turned: what every observer of the
/// vehicle's motion compares with. Of 32 steps; before them it was as in the first of these.
class AppliedWrench {
 public:
  /// Integrals over the last part of the past.
  struct Impulse {
    double thrust = 0.0;                               ///< [N s]
    Eigen::Vector3d moment = Eigen::Vector3d::Zero();  ///< [N m s]
    /// The integral of that of the moment [N m s^2]: over an inertia the angle turned from rest.
    Eigen::Vector3d turn = Eigen::Vector3d::Zero();
  };

  /// A step of `dt` seconds (> 0) ended with `given`, towards which the wrench went evenly.
  void observe(const Wrench& given, double dt) noexcept;

  /// At the end of the last step.
  const Wrench& now() const noexcept { return now_; }
  /// Over the last `age` seconds (>= 0).
  Impulse since(double age) const noexcept;
  /// On average over the `span` seconds (> 0) that ended `age` seconds (>= 0) ago.
  Wrench mean(double age, double span) const noexcept { return mean(since(age), age, span); }
  /// The same, where `late` is since(age) already.
  Wrench mean(const Impulse& late, double age, double span) const noexcept;

 private:
  struct Step {
    Wrench mean;
    double dt = 0.0;  // [s]
  };
  static constexpr std::size_t kSteps = 32;

  std::array<Step, kSteps> steps_ = {};
  std::size_t last_ = 0;
  std::size_t count_ = 0;  // at most kSteps
  Wrench now_;
};

}  // namespace aqc
