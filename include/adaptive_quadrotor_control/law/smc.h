#pragma once

#include "adaptive_quadrotor_control/law/cascaded_law.h"

namespace aqc {

/// Sliding-mode control with fixed gains (Xu and Ozguner 2008), the thesis's robust baseline: it
/// must be told the nominal mass and inertia and a bound on what a payload adds to them.
///
/// Per axis and in both loops: tau = M0 b - kappa sat(s / varpi), kappa = eta + F |b|, with
/// b = g + a_d - Phi_p de_p for the position and b = -Phi_q de_q for the attitude.
class Smc final : public CascadedLaw {
 public:
  /// Names and meaning: config/controller/smc.yaml. Throws ParameterError.
  explicit Smc(const ParameterReader& reader);

  void adapt(const Achieved&, double) noexcept override {}
  void reset() noexcept override {}
  std::unique_ptr<ControlLaw> clone() const override { return std::make_unique<Smc>(*this); }
  const char* name() const noexcept override { return kName; }
  static constexpr const char* kName = "smc";

 private:
  Eigen::Vector3d force(const PositionErrors& errors, const SetPoint& set_point) noexcept override;
  Eigen::Vector3d moment(const State& state, const AttitudeErrors& errors) noexcept override;

  struct Words;
  struct Loop {
    Loop(const ParameterReader& reader, const Words& words);
    Eigen::Vector3d update(const Eigen::Vector3d& error, const Eigen::Vector3d& rate,
                           const Eigen::Vector3d& feed_forward,
                           Eigen::Vector3d& sliding) const noexcept;

    Eigen::Vector3d slope;          // Phi [1/s]
    Eigen::Vector3d reaching_gain;  // eta
    Eigen::Vector3d nominal;        // M0: mass [kg] or principal moments [kg m^2]
    Eigen::Vector3d payload_bound;  // F, in the unit of M0
    double boundary_layer;          // varpi
  };

  Loop position_;
  Loop attitude_;
};

}  // namespace aqc
