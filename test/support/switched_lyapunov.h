#pragma once

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <vector>

#include "adaptive_quadrotor_control/law/switched/switched_law.h"
#include "support/fixtures.h"

/// What the theorem of thesis chapter 3 needs to know and the controller does not.
namespace aqc::test {

/// Theta* of every subsystem and the bounds of eq. low_bound that hold for all of them.
struct Truth {
  std::vector<Eigen::Vector4d> theta;  // Theta*_s, >= 0
  double least_zeta;                   // underline-zeta, > 0
  double least_gamma;                  // underline-gamma, > 0
};

inline double leastDecay(const SwitchedLaw& law) {
  double varrho = law.subsystem(0).spectrum().decay();
  for (const LyapunovSpectrum& spectrum : law.spectra()) {
    varrho = std::min(varrho, spectrum.decay());
  }
  return varrho;
}

/// V of eq. lyap; every subsystem's gamma and zeta count once.
inline double lyapunov(const SwitchedLaw& law, int active, const Vector8d& xi, const Truth& truth) {
  double V = 0.5 * xi.dot(law.subsystem(active).lyapunovMatrix() * xi);
  for (int s = 0; s < law.count(); ++s) {
    const SubsystemGains& gains = law.subsystem(s).gains();
    V += 0.5 * (gains.theta - truth.theta[static_cast<std::size_t>(s)]).squaredNorm();
    V += gains.gamma / truth.least_gamma + gains.zeta / truth.least_zeta;
  }
  return V;
}

/// The constant of dV/dt <= -varrho V + delta outside the boundary layer while `active` is active,
/// as docs/switched_control.md derives it. Smaller than the printed delta.
inline double derivedDelta(const SwitchedLaw& law, int active, const Truth& truth) {
  const double varrho = leastDecay(law);
  double delta = 0.0;
  for (int s = 0; s < law.count(); ++s) {
    const SubsystemParameters& p = law.subsystem(s).parameters();
    const Eigen::Vector4d& theta = truth.theta[static_cast<std::size_t>(s)];
    delta += 0.5 * varrho * theta.squaredNorm();
    delta += varrho * (p.initial_gamma / truth.least_gamma + p.initial_zeta / truth.least_zeta);
    if (s != active) {
      delta += p.gamma_drive / truth.least_gamma - 1.0;
      continue;
    }
    delta += p.zeta_drive / truth.least_zeta - 1.0;
    for (int i = 0; i < 4; ++i) {
      delta += std::pow(p.leak[i] * theta[i], 2) / (4.0 * (p.leak[i] - 0.5 * varrho));
    }
  }
  return delta;
}

/// The thesis's delta (below eq. part 7) with the sums over gamma and zeta outside the sum over i.
inline double printedDelta(const SwitchedLaw& law, const Truth& truth) {
  double worst = 0.0;
  double sum = 0.0;
  for (int s = 0; s < law.count(); ++s) {
    const SubsystemParameters& p = law.subsystem(s).parameters();
    const double varrho = law.subsystem(s).spectrum().decay();
    const Eigen::Vector4d& theta = truth.theta[static_cast<std::size_t>(s)];
    double own = p.zeta_drive / truth.least_zeta;
    for (int i = 0; i < 4; ++i) {
      own += std::pow(p.leak[i] * theta[i], 2) / (4.0 * (p.leak[i] - 0.5 * varrho));
    }
    worst = std::max(worst, own);
    sum += 0.5 * varrho * theta.squaredNorm() + p.gamma_drive / truth.least_gamma +
           varrho * (p.initial_gamma / truth.least_gamma + p.initial_zeta / truth.least_zeta);
  }
  return worst + sum;
}

/// sum over j = 0..2 of theta-hat_j ||xi||^j: what delta_1 bounds inside the boundary layer.
inline double layerTerm(const SwitchedSubsystem& active, const Vector8d& xi) {
  const double norm = xi.norm();
  return active.gains().theta.head<3>().dot(Eigen::Vector3d(1.0, norm, norm * norm));
}

/// d xi / dt under the uncertainty chi (eq. error_dyn). The robust part comes out of the command.
inline Vector8d errorRate(const SwitchedSubsystem& active, const SwitchedInput& in,
                          const SwitchedOutput& out, const Eigen::Vector4d& chi) {
  Vector8d rate;
  rate.head<4>() = in.error.tail<4>();
  rate.tail<4>() =
      active.parameters().input_gain.llt().solve(out.input) - in.desired_acceleration + chi;
  return rate;
}

/// Y'Theta* (eq. psi_bound).
inline double uncertaintyBound(const SwitchedInput& in, const Eigen::Vector4d& theta) {
  const double xi = in.error.norm();
  return theta.dot(Eigen::Vector4d(1.0, xi, xi * xi, in.acceleration));
}

template <int Size>
Eigen::Matrix<double, Size, Size> anyPositiveDefinite(Dice& dice, double low, double high) {
  Eigen::Matrix<double, Size, Size> random;
  for (Eigen::Index i = 0; i < random.size(); ++i) random(i) = dice.between(-1.0, 1.0);
  const Eigen::HouseholderQR<Eigen::Matrix<double, Size, Size>> qr(random);
  const Eigen::Matrix<double, Size, Size> turn = qr.householderQ();
  Eigen::Matrix<double, Size, 1> values;
  for (double& value : values) value = dice.between(low, high);
  const Eigen::Matrix<double, Size, Size> matrix = turn * values.asDiagonal() * turn.transpose();
  return 0.5 * (matrix + matrix.transpose());
}

inline Eigen::Vector4d anyVector(Dice& dice, double low, double high) {
  Eigen::Vector4d v;
  for (double& value : v) value = dice.between(low, high);
  return v;
}

/// Errors in [-size, size], accelerations as large as a vehicle has them.
inline SwitchedInput anyInput(Dice& dice, double size) {
  SwitchedInput in;
  for (double& entry : in.error) entry = dice.between(-size, size);
  in.desired_acceleration = anyVector(dice, -2.0, 2.0);
  in.acceleration = dice.between(0.0, 8.0);
  return in;
}

inline SubsystemParameters anySubsystem(Dice& dice) {
  SubsystemParameters p;
  p.error_gain = anyPositiveDefinite<4>(dice, 0.8, 3.0);
  p.rate_gain = anyPositiveDefinite<4>(dice, 1.0, 3.0);
  p.input_gain = anyPositiveDefinite<4>(dice, 0.3, 2.0);
  p.weight = anyPositiveDefinite<8>(dice, 1.0, 3.0);
  const double varrho = solveSubsystem(p).spectrum.decay();
  p.leak = varrho * anyVector(dice, 0.55, 3.0);
  p.gamma_drive = dice.between(0.001, 0.5);
  p.zeta_drive = dice.between(0.001, 0.5);
  p.initial_theta = anyVector(dice, 0.01, 3.0);
  p.initial_zeta = p.zeta_drive * dice.between(1.01, 10.0);
  p.initial_gamma = p.gamma_drive * dice.between(1.01, 10.0);
  return p;
}

inline SwitchedLaw anyLaw(Dice& dice, double boundary_layer) {
  std::vector<SubsystemParameters> subsystems;
  for (int count = 1 + dice.index(4); count > 0; --count) subsystems.push_back(anySubsystem(dice));
  return SwitchedLaw(subsystems, boundary_layer);
}

}  // namespace aqc::test
