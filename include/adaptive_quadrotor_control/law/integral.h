#pragma once

#include "adaptive_quadrotor_control/law/bearable.h"
#include "adaptive_quadrotor_control/law/geometric.h"

namespace aqc {

/// Geometric tracking control with integral action in force and moment (Goodarzi, Lee and Lee,
/// "Geometric nonlinear PID control of a quadrotor UAV on SE(3)", ECC 2013):
///
///     F = m (a_d + g) - k_x e_p - k_v de_p - f_I,        df_I = k_Ip (de_p + c_p e_p)
///     M = omega x J omega - k_R e_q - k_omega de_q - m_I, dm_I = k_Iq (de_q + c_q e_q)
///
/// and omega_d follows the set point's jerk. While the rotors give less than was asked for, or
/// more, no integral asks for more of it (conditional integration); none is larger than bearable().
class Integral final : public Geometric {
 public:
  /// Names and meaning: config/controller/integral.yaml. Throws ParameterError.
  Integral(const ParameterReader& reader, const Vehicle& vehicle);

  void adapt(const Achieved& achieved, double dt) noexcept override;
  void reset() noexcept override;
  /// From an integral both integrals; from another law the weight that it held up.
  void adopt(const ControlLaw& old) noexcept override;
  bool finite() const noexcept override;
  std::unique_ptr<ControlLaw> clone() const override { return std::make_unique<Integral>(*this); }
  const char* name() const noexcept override { return kName; }
  static constexpr const char* kName = "integral";
  /// f_I in W [N] and m_I in B [N m].
  std::vector<AdaptiveQuantity> adaptiveQuantities() const override;

 private:
  struct Words;
  struct Action {
    Action(const ParameterReader& reader, const Words& words);
    Eigen::Vector3d drive(const Eigen::Vector3d& error, const Eigen::Vector3d& rate) const noexcept;

    Eigen::Vector3d gain;  // k_I
    double mix;            // c [1/s]
  };

  Eigen::Vector3d force(const PositionErrors& errors, const SetPoint& set_point) noexcept override;
  Eigen::Vector3d moment(const State& state, const AttitudeErrors& errors) noexcept override;
  void report() noexcept;

  Action force_action_;
  Action moment_action_;
  Bearable most_;
  Eigen::Vector3d force_ = Eigen::Vector3d::Zero();   // f_I in W [N]
  Eigen::Vector3d moment_ = Eigen::Vector3d::Zero();  // m_I in B [N m]
  // Of the last command.
  PositionErrors position_errors_;
  AttitudeErrors attitude_errors_;
  Eigen::Vector3d z_body_ = Eigen::Vector3d::UnitZ();  // in W
};

}  // namespace aqc
