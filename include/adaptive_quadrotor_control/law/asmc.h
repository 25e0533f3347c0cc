#pragma once

#include <array>

#include "adaptive_quadrotor_control/law/adaptive_gain.h"
#include "adaptive_quadrotor_control/law/cascaded_law.h"

namespace aqc {

/// The adaptive sliding-mode controller of thesis chapter 2 (eqs. ip_out, adap_out, ip_inn,
/// q_adap_K with sat for sgn). It knows neither mass nor inertia nor payload.
///
/// As printed, without cures: the leak alpha_m leaves a steady sag of about
/// alpha_m m / (g Phi_z), the law keeps adapting while the rotors saturate, and neither K_i, rho
/// nor m-hat has an upper bound. Bounds of these are options.
class Asmc final : public CascadedLaw {
 public:
  /// Names and meaning: config/controller/asmc.yaml. Throws ParameterError.
  explicit Asmc(const ParameterReader& reader);

  void adapt(const Achieved& achieved, double dt) noexcept override;
  void reset() noexcept override;
  /// From an asmc all gains and m-hat; from another law m-hat alone, its liftedMass(), unless the
  /// initial one is larger.
  void adopt(const ControlLaw& old) noexcept override;
  /// 0 <= m-hat <= the smaller one of `most_mass` and the parameter `mass_estimate/most`.
  void bound(const EstimateBounds& bounds) noexcept override;
  bool finite() const noexcept override;
  std::unique_ptr<ControlLaw> clone() const override { return std::make_unique<Asmc>(*this); }
  const char* name() const noexcept override { return kName; }
  static constexpr const char* kName = "asmc";
  std::vector<AdaptiveQuantity> adaptiveQuantities() const override;

 private:
  Eigen::Vector3d force(const PositionErrors& errors, const SetPoint& set_point) noexcept override;
  Eigen::Vector3d moment(const State& state, const AttitudeErrors& errors) noexcept override;
  void report() noexcept;

  struct Words;

  // One loop's law without its feed-forward: -Lambda s - rho sat(s, varpi), where
  // rho = sum_i K_i ||xi||^i and each K_i adapts with ||s|| ||xi||^i.
  template <std::size_t Count>
  class Loop {
   public:
    Loop(const ParameterReader& reader, const Words& words);
    Eigen::Vector3d output(const Eigen::Vector3d& error, const Eigen::Vector3d& rate) noexcept;
    void adapt(double dt) noexcept;
    void reset() noexcept;
    void adopt(const Loop& old) noexcept;
    bool finite() const noexcept;
    const Eigen::Vector3d& sliding() const noexcept { return sliding_; }
    const std::array<AdaptiveGain, Count>& gains() const noexcept { return gains_; }

   private:
    Eigen::Matrix3d slope_;                  // Phi [1/s]
    Eigen::Matrix3d gain_;                   // Lambda
    double boundary_layer_;                  // varpi
    std::array<AdaptiveGain, Count> gains_;  // K_i
    double most_rho_;                        // infinity: no bound
    // Of the last output(), for adapt().
    Eigen::Vector3d sliding_ = Eigen::Vector3d::Zero();  // s
    double xi_ = 0.0;                                    // ||xi||
  };

  Loop<2> position_;
  Loop<3> attitude_;
  double most_mass_;   // of the parameters [kg]; infinity: no bound
  AdaptiveGain mass_;  // m-hat [kg]
};

}  // namespace aqc
