#pragma once

#include <Eigen/Core>
#include <limits>
#include <vector>

#include "adaptive_quadrotor_control/law/switched/dwell_time.h"

namespace aqc {

using Vector8d = Eigen::Matrix<double, 8, 1>;
using Matrix8d = Eigen::Matrix<double, 8, 8>;
using Matrix4x8d = Eigen::Matrix<double, 4, 8>;

/// The coordinates q = (z, phi, theta, psi) of thesis chapter 3 [m, rad, rad, rad]; its inputs tau
/// are (T, tau_phi, tau_theta, tau_psi) [N, N, N, N m]: tau_phi and tau_theta act on I_xx / l and
/// I_yy / l, so they are moment / arm length.

/// What the designer chooses for one subsystem. K_1, K_2, D (4 x 4) and Q (8 x 8) are symmetric
/// positive definite.
struct SubsystemParameters {
  Eigen::Matrix4d error_gain = Eigen::Matrix4d::Zero();  ///< K_1 [1/s^2]
  Eigen::Matrix4d rate_gain = Eigen::Matrix4d::Zero();   ///< K_2 [1/s]
  Eigen::Matrix4d input_gain =
      Eigen::Matrix4d::Zero();  ///< D, stands where an inertia would [kg, kg m, kg m, kg m^2]
  Matrix8d weight = Matrix8d::Zero();  ///< Q
  Eigen::Vector4d leak =
      Eigen::Vector4d::Zero();  ///< alpha_0 .. alpha_3 [1/s], each > varrho / 2 (eq. alpha)
  double gamma_drive = 0.0;     ///< epsilon, > 0
  double zeta_drive = 0.0;      ///< bar-epsilon, > 0
  Eigen::Vector4d initial_theta =
      Eigen::Vector4d::Zero();  ///< theta-hat_0 .. theta-hat_3 at the start, > 0 (eq. init)
  /// Of theta-hat, >= initial_theta; the thesis has no bound.
  Eigen::Vector4d most_theta = Eigen::Vector4d::Constant(std::numeric_limits<double>::infinity());
  double initial_zeta = 0.0;   ///< bar-zeta, > bar-epsilon
  double initial_gamma = 0.0;  ///< bar-gamma, > epsilon
};

/// The Lyapunov equation of a subsystem, solved.
struct SubsystemLyapunov {
  Matrix8d P = Matrix8d::Zero();  ///< of A'P + P A = -Q with A = [0 I; -K_1 -K_2]
  LyapunovSpectrum spectrum;
};
/// Throws std::domain_error when there is no positive definite P.
SubsystemLyapunov solveSubsystem(const SubsystemParameters& parameters);

/// What a subsystem has learned.
struct SubsystemGains {
  Eigen::Vector4d theta = Eigen::Vector4d::Zero();  ///< theta-hat_0 .. theta-hat_3, >= 0
  double zeta = 0.0;                                ///< in (0, bar-zeta]
  double gamma = 0.0;                               ///< in (0, bar-gamma]
};

/// What the law is fed with in one step.
struct SwitchedInput {
  Vector8d error = Vector8d::Zero();  ///< xi = [e, de], e = q - q_d
  /// Second derivative of q_d.
  Eigen::Vector4d desired_acceleration = Eigen::Vector4d::Zero();
  double acceleration = 0.0;  ///< norm of the second derivative of (z, phi, theta, psi, x, y)
};

/// What it decides.
struct SwitchedOutput {
  Eigen::Vector4d filtered_error = Eigen::Vector4d::Zero();  ///< r = B'P xi (eq. r)
  double robust_gain = 0.0;                                  ///< rho (eq. rho)
  Eigen::Vector4d input = Eigen::Vector4d::Zero();           ///< tau (eq. split_input)
};

/// One subsystem of the switched adaptive law: its constant matrices and its gains.
class SwitchedSubsystem {
 public:
  /// Solves A'P + P A = -Q. Throws std::domain_error when that fails or when eqs. alpha and init
  /// do not hold.
  explicit SwitchedSubsystem(const SubsystemParameters& parameters);

  /// The law with the gains as they are. `boundary_layer` is varpi > 0.
  SwitchedOutput output(const SwitchedInput& in, double boundary_layer) const noexcept;

  /// Eqs. hat_theta1, hat_theta, zeta over `dt` seconds while the subsystem is active; gamma rests.
  /// `filtered_error` is ||r||. Exact for inputs that are constant over the step.
  void adaptActive(const SwitchedInput& in, double filtered_error, double dt) noexcept;
  /// Eq. gamma over `dt` seconds while the subsystem is inactive; theta-hat and zeta rest.
  void adaptInactive(double dt) noexcept;

  void reset() noexcept;
  /// Goes on from `gains`.
  void adopt(const SubsystemGains& gains) noexcept;
  bool finite() const noexcept;

  const SubsystemGains& gains() const noexcept { return gains_; }
  const SubsystemParameters& parameters() const noexcept { return parameters_; }
  const Matrix8d& lyapunovMatrix() const noexcept { return lyapunov_.P; }  ///< P
  const LyapunovSpectrum& spectrum() const noexcept { return lyapunov_.spectrum; }

 private:
  void project() noexcept;

  SubsystemParameters parameters_;
  SubsystemLyapunov lyapunov_;
  Matrix4x8d filter_;    // B'P
  Matrix4x8d feedback_;  // D Lambda = D [K_1 K_2]
  SubsystemGains gains_;
  double dt_ = 0.0;  // of the two below, so that a fixed rate pays for them once
  Eigen::Vector4d decay_ = Eigen::Vector4d::Ones();  // exp(-alpha dt)
  Eigen::Vector4d rise_ = Eigen::Vector4d::Zero();   // (1 - exp(-alpha dt)) / alpha
};

/// The switched adaptive law of thesis chapter 3 in its own coordinates (eqs. r, split_input, rob,
/// rho, split_adap). It knows neither masses nor inertias nor bounds on them.
///
/// After construction nothing allocates or throws. Subsystems count from 0 here.
class SwitchedLaw {
 public:
  /// At least one subsystem; `boundary_layer` is varpi > 0. Throws std::domain_error.
  SwitchedLaw(const std::vector<SubsystemParameters>& subsystems, double boundary_layer);

  /// What the subsystem `active` commands; changes nothing.
  SwitchedOutput output(int active, const SwitchedInput& in) const noexcept;
  /// The gains of every subsystem over `dt` seconds; `filtered_error` is ||r|| of output().
  void adapt(int active, const SwitchedInput& in, double filtered_error, double dt) noexcept;
  void reset() noexcept;
  /// The gains of a law of as many subsystems, but maybe other parameters, go on here.
  void adopt(const SwitchedLaw& old) noexcept;
  bool finite() const noexcept;

  int count() const noexcept { return static_cast<int>(subsystems_.size()); }
  const SwitchedSubsystem& subsystem(int index) const noexcept {
    return subsystems_[static_cast<std::size_t>(index)];
  }
  double boundaryLayer() const noexcept { return boundary_layer_; }
  std::vector<LyapunovSpectrum> spectra() const;

 private:
  std::vector<SwitchedSubsystem> subsystems_;
  double boundary_layer_;
};

}  // namespace aqc
