#pragma once

#include <optional>

#include "adaptive_quadrotor_control/law/bearable.h"
#include "adaptive_quadrotor_control/law/geometric.h"
#include "adaptive_quadrotor_control/law/low_pass.h"

namespace aqc {

/// L1 adaptive augmentation of the geometric law (Wu, Cheng, Ackerman, Gahlawat, Lakshmanan, Zhao
/// and Hovakimyan, "L1 adaptive augmentation for geometric tracking control of quadrotors", ICRA
/// 2022), with its piecewise-constant adaptation. Of a predictor
///
///     m dv^ = T z_B - m g e_z + sigma_f - m a_v (v^ - v)
///     J domega^ = M - omega x J omega + sigma_m - J a_w (omega^ - omega)
///
/// the estimates are, from one sample to the next T_s later, what makes its error vanish then:
///
///     sigma_f = -m a_v / (exp(a_v T_s) - 1) (v^ - v),  sigma_m = -J a_w / (exp(a_w T_s) - 1)
///     (...).
///
/// Thrust and moment are lessened by sigma_f'z_B and sigma_m behind a low-pass filter C(s). The
/// part of sigma_f across the thrust is unmatched: no rotor pushes there, and nobody answers it. T
/// and M are what the rotors are told to give, so that their limits are no disturbance. omega_d
/// follows the set point's jerk.
class L1 final : public Geometric {
 public:
  /// Names and meaning: config/controller/l1.yaml. Throws ParameterError.
  L1(const ParameterReader& reader, const Vehicle& vehicle);

  Wrench command(const Sensed& sensed, const SetPoint& set_point, double dt) noexcept override;
  void adapt(const Achieved& achieved, double dt) noexcept override;
  void reset() noexcept override;
  /// From an L1 all that it knows; from another law the weight that it held up.
  void adopt(const ControlLaw& old) noexcept override;
  bool finite() const noexcept override;
  std::unique_ptr<ControlLaw> clone() const override { return std::make_unique<L1>(*this); }
  const char* name() const noexcept override { return kName; }
  static constexpr const char* kName = "l1";
  /// sigma_f in W [N] and sigma_m in B [N m].
  std::vector<AdaptiveQuantity> adaptiveQuantities() const override;

 private:
  // A first-order predictor of one sample.
  class Predictor {
   public:
    explicit Predictor(double decay) : decay_(decay), lag_(1.0 / decay) {}
    // a / (exp(a T_s) - 1), of the adaptation law.
    double gain(double dt) noexcept { return decay_ * lag_.rest(dt) / lag_.share(dt); }

   private:
    double decay_;  // a [1/s]
    LowPass lag_;
  };
  struct Values {
    Eigen::Vector3d force = Eigen::Vector3d::Zero();   // sigma_f in W [N]
    Eigen::Vector3d moment = Eigen::Vector3d::Zero();  // sigma_m in B [N m]
    Wrench answer;                                     // -C(s) of their matched parts
  };

  void estimate(const State& state, double dt) noexcept;
  void report() noexcept;

  Eigen::Matrix3d inverse_inertia_;  // [1/(kg m^2)]
  Bearable most_;
  Predictor velocity_;
  Predictor rate_;
  LowPass thrust_filter_;
  LowPass moment_filter_;
  Values learned_;
  Values values_;                // with the last command
  State state_;                  // of the last command
  std::optional<Wrench> given_;  // since then; nothing: nobody said, and nothing is estimated
};

}  // namespace aqc
