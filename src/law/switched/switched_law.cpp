#include "adaptive_quadrotor_control/law/switched/switched_law.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

#include "adaptive_quadrotor_control/math/eigenvalues.h"
#include "adaptive_quadrotor_control/math/lyapunov.h"
#include "adaptive_quadrotor_control/math/number_text.h"

namespace aqc {
namespace {

// Solution after `dt` of dx/dt = -rate x + drive for constants rate, drive >= 0.
double relax(double x, double rate, double drive, double dt) noexcept {
  const double change = -std::expm1(-rate * dt);  // 1 - exp(-rate dt), in [0, 1)
  return x + change * (drive / rate - x);
}

// A = [0 I; -K_1 -K_2]
Matrix8d errorDynamics(const SubsystemParameters& parameters) {
  Matrix8d A = Matrix8d::Zero();
  A.topRightCorner<4, 4>().setIdentity();
  A.bottomLeftCorner<4, 4>() = -parameters.error_gain;
  A.bottomRightCorner<4, 4>() = -parameters.rate_gain;
  return A;
}

void requireAbove(const char* what, double value, double least) {
  if (value > least) return;
  throw std::domain_error(std::string(what) + " is " + numberText(value) + "; it must be > " +
                          numberText(least));
}

// Eqs. alpha and init.
void check(const SubsystemParameters& p, const LyapunovSpectrum& spectrum) {
  requireAbove("the least alpha", p.leak.minCoeff(), 0.5 * spectrum.decay());
  requireAbove("the least initial theta", p.initial_theta.minCoeff(), 0.0);
  if (!(p.most_theta.array() >= p.initial_theta.array()).all()) {
    throw std::domain_error("the most theta must be >= the initial one in every entry");
  }
  requireAbove("the drive of zeta", p.zeta_drive, 0.0);
  requireAbove("the drive of gamma", p.gamma_drive, 0.0);
  requireAbove("the initial zeta", p.initial_zeta, p.zeta_drive);
  requireAbove("the initial gamma", p.initial_gamma, p.gamma_drive);
}

}  // namespace

SubsystemLyapunov solveSubsystem(const SubsystemParameters& parameters) {
  const Matrix8d P = solveLyapunov(errorDynamics(parameters), parameters.weight);
  const EigenvalueRange range = eigenvalueRange(P);
  return {P, {range.min, range.max, eigenvalueRange(parameters.weight).min}};
}

SwitchedSubsystem::SwitchedSubsystem(const SubsystemParameters& parameters)
    : parameters_(parameters),
      lyapunov_(solveSubsystem(parameters)),
      gains_{parameters.initial_theta, parameters.initial_zeta, parameters.initial_gamma} {
  check(parameters, lyapunov_.spectrum);
  filter_ = lyapunov_.P.bottomRows<4>();
  feedback_ << parameters.input_gain * parameters.error_gain,
      parameters.input_gain * parameters.rate_gain;
}

SwitchedOutput SwitchedSubsystem::output(const SwitchedInput& in,
                                         double boundary_layer) const noexcept {
  const double xi = in.error.norm();
  const Eigen::Vector4d Y(1.0, xi, xi * xi, in.acceleration);
  SwitchedOutput out;
  out.filtered_error.noalias() = filter_ * in.error;
  out.robust_gain = Y.dot(gains_.theta) + gains_.zeta + gains_.gamma;
  const double scale = out.robust_gain / std::max(out.filtered_error.norm(), boundary_layer);
  out.input.noalias() =
      parameters_.input_gain * (in.desired_acceleration - scale * out.filtered_error);
  out.input.noalias() -= feedback_ * in.error;
  return out;
}

void SwitchedSubsystem::adaptActive(const SwitchedInput& in, double filtered_error,
                                    double dt) noexcept {
  if (dt != dt_) {
    dt_ = dt;
    for (int i = 0; i < 4; ++i) {
      const double change = -std::expm1(-parameters_.leak[i] * dt);
      decay_[i] = 1.0 - change;
      rise_[i] = change / parameters_.leak[i];
    }
  }
  const double xi = in.error.norm();
  const Eigen::Vector4d Y(1.0, xi, xi * xi, in.acceleration);
  const double zeta_rate = 1.0 + gains_.theta[3] * in.acceleration * filtered_error;
  gains_.theta = decay_.cwiseProduct(gains_.theta) + rise_.cwiseProduct(filtered_error * Y);
  project();
  gains_.zeta = relax(gains_.zeta, zeta_rate, parameters_.zeta_drive, dt);
}

void SwitchedSubsystem::adaptInactive(double dt) noexcept {
  const double rate = 1.0 + 0.5 * spectrum().decay() * gains_.theta.squaredNorm();
  gains_.gamma = relax(gains_.gamma, rate, parameters_.gamma_drive, dt);
}

void SwitchedSubsystem::reset() noexcept {
  gains_ = {parameters_.initial_theta, parameters_.initial_zeta, parameters_.initial_gamma};
}

void SwitchedSubsystem::adopt(const SubsystemGains& gains) noexcept {
  gains_ = gains;
  project();
}

bool SwitchedSubsystem::finite() const noexcept {
  return gains_.theta.allFinite() && std::isfinite(gains_.zeta) && std::isfinite(gains_.gamma);
}

// Not-a-number stays, for whoever looks whether all is well.
void SwitchedSubsystem::project() noexcept {
  for (int i = 0; i < 4; ++i) {
    gains_.theta[i] = std::min(gains_.theta[i], parameters_.most_theta[i]);
  }
}

SwitchedLaw::SwitchedLaw(const std::vector<SubsystemParameters>& subsystems, double boundary_layer)
    : boundary_layer_(boundary_layer) {
  if (subsystems.empty()) throw std::domain_error("there must be a subsystem");
  requireAbove("the boundary layer", boundary_layer, 0.0);
  for (const SubsystemParameters& parameters : subsystems) subsystems_.emplace_back(parameters);
}

SwitchedOutput SwitchedLaw::output(int active, const SwitchedInput& in) const noexcept {
  return subsystem(active).output(in, boundary_layer_);
}

void SwitchedLaw::adapt(int active, const SwitchedInput& in, double filtered_error,
                        double dt) noexcept {
  for (std::size_t i = 0; i < subsystems_.size(); ++i) {
    if (static_cast<int>(i) == active) {
      subsystems_[i].adaptActive(in, filtered_error, dt);
    } else {
      subsystems_[i].adaptInactive(dt);
    }
  }
}

void SwitchedLaw::reset() noexcept {
  for (SwitchedSubsystem& subsystem : subsystems_) subsystem.reset();
}

void SwitchedLaw::adopt(const SwitchedLaw& old) noexcept {
  for (std::size_t i = 0; i < std::min(subsystems_.size(), old.subsystems_.size()); ++i) {
    subsystems_[i].adopt(old.subsystems_[i].gains());
  }
}

bool SwitchedLaw::finite() const noexcept {
  return std::all_of(subsystems_.begin(), subsystems_.end(),
                     [](const SwitchedSubsystem& subsystem) { return subsystem.finite(); });
}

std::vector<LyapunovSpectrum> SwitchedLaw::spectra() const {
  std::vector<LyapunovSpectrum> spectra;
  for (const SwitchedSubsystem& subsystem : subsystems_) spectra.push_back(subsystem.spectrum());
  return spectra;
}

}  // namespace aqc
