#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "adaptive_quadrotor_control/law/switched/dwell_time.h"
#include "support/euler_model.h"
#include "support/fixtures.h"
#include "support/switched_lyapunov.h"

/// The theorem of thesis chapter 3, inequality by inequality, with the controller's own code.
/// docs/switched_control.md has the derivations and what is wrong in print.
namespace aqc {
namespace {

using test::Dice;
using test::Truth;

Truth anyTruth(Dice& dice, const SwitchedLaw& law, double largest) {
  Truth truth{{}, std::numeric_limits<double>::max(), std::numeric_limits<double>::max()};
  for (int s = 0; s < law.count(); ++s) {
    truth.theta.push_back(test::anyVector(dice, 0.0, largest));
    truth.least_zeta = std::min(truth.least_zeta, law.subsystem(s).gains().zeta);
    truth.least_gamma = std::min(truth.least_gamma, law.subsystem(s).gains().gamma);
  }
  truth.least_zeta *= dice.between(0.05, 1.0);
  truth.least_gamma *= dice.between(0.05, 1.0);
  return truth;
}

/// An uncertainty as large as eq. psi_bound lets it be, at worst along r.
Eigen::Vector4d anyUncertainty(Dice& dice, const SwitchedInput& in, const Eigen::Vector4d& r,
                               const Eigen::Vector4d& theta) {
  const Eigen::Vector4d direction =
      dice.index(2) == 0 ? r : Eigen::Vector4d(test::anyVector(dice, -1.0, 1.0));
  return test::uncertaintyBound(in, theta) * direction.normalized();
}

/// dV/dt by the controller's own adaptation over a time that is as good as none.
double lyapunovRate(const SwitchedLaw& law, int active, const SwitchedInput& in,
                    const Eigen::Vector4d& chi, const Truth& truth) {
  constexpr double kMoment = 1e-9;  // [s]
  const SwitchedSubsystem& subsystem = law.subsystem(active);
  const SwitchedOutput out = law.output(active, in);
  double rate = in.error.dot(subsystem.lyapunovMatrix() * test::errorRate(subsystem, in, out, chi));
  SwitchedLaw later = law;
  later.adapt(active, in, out.filtered_error.norm(), kMoment);
  for (int s = 0; s < law.count(); ++s) {
    const SubsystemGains& before = law.subsystem(s).gains();
    const SubsystemGains& after = later.subsystem(s).gains();
    const Eigen::Vector4d& theta = truth.theta[static_cast<std::size_t>(s)];
    rate += (before.theta - theta).dot(after.theta - before.theta) / kMoment;
    rate += (after.gamma - before.gamma) / (truth.least_gamma * kMoment);
    rate += (after.zeta - before.zeta) / (truth.least_zeta * kMoment);
  }
  return rate;
}

double tolerance(double V) {
  return 1e-4 * (1.0 + V);
}  // of the numerical derivative

// Case (i), eq. part 7, and that the printed delta is no smaller than the derived one.
TEST(SwitchedTheorem, DecaysOutsideTheBoundaryLayer) {
  Dice dice(11);
  for (int i = 0; i < 3000; ++i) {
    const SwitchedLaw law = test::anyLaw(dice, 1e-6);
    const int active = dice.index(law.count());
    const Truth truth = anyTruth(dice, law, 4.0);
    const SwitchedInput in = test::anyInput(dice, 1.5);
    const Eigen::Vector4d chi = anyUncertainty(dice, in, law.output(active, in).filtered_error,
                                               truth.theta[static_cast<std::size_t>(active)]);
    const double V = test::lyapunov(law, active, in.error, truth);
    const double rate = lyapunovRate(law, active, in, chi, truth);
    const double delta = test::derivedDelta(law, active, truth);
    ASSERT_LE(rate, -test::leastDecay(law) * V + delta + tolerance(V)) << i;
    ASSERT_LE(delta, test::printedDelta(law, truth)) << i;
  }
}

// The step before the bounds on V come in: nearly an equality when chi points along r, so that any
// error in an adaptive law or in rho shows.
TEST(SwitchedTheorem, UncertaintyCancelsAgainstTheGains) {
  Dice dice(12);
  for (int i = 0; i < 3000; ++i) {
    const SwitchedLaw law = test::anyLaw(dice, 1e-6);
    const int active = dice.index(law.count());
    const Truth truth = anyTruth(dice, law, 4.0);
    const SwitchedInput in = test::anyInput(dice, 1.5);
    const SwitchedSubsystem& p = law.subsystem(active);
    const Eigen::Vector4d r = law.output(active, in).filtered_error;
    const Eigen::Vector4d& theta = truth.theta[static_cast<std::size_t>(active)];
    const Eigen::Vector4d chi = test::uncertaintyBound(in, theta) * r.normalized();
    const SubsystemGains& g = p.gains();
    double expected =
        -0.5 * in.error.dot(p.parameters().weight * in.error) - (g.zeta + g.gamma) * r.norm();
    expected += p.parameters().leak.dot(g.theta.cwiseProduct(theta - g.theta));
    expected +=
        (p.parameters().zeta_drive - (1.0 + g.theta[3] * in.acceleration * r.norm()) * g.zeta) /
        truth.least_zeta;
    for (int s = 0; s < law.count(); ++s) {
      if (s == active) continue;
      const SwitchedSubsystem& idle = law.subsystem(s);
      const double drain = 1.0 + 0.5 * idle.spectrum().decay() * idle.gains().theta.squaredNorm();
      expected += (idle.parameters().gamma_drive - drain * idle.gains().gamma) / truth.least_gamma;
    }
    const double rate = lyapunovRate(law, active, in, chi, truth);
    ASSERT_NEAR(rate, expected, 1e-5 * (1.0 + std::abs(expected)) + 1e-4) << i;
  }
}

// Case (ii): inside, ||r|| (1 - ||r|| / varpi) of the layer term is added, at most a quarter of
// what is printed.
TEST(SwitchedTheorem, GrowsInsideTheBoundaryLayerByAQuarterOfThePrintedTerm) {
  Dice dice(13);
  for (int i = 0; i < 3000; ++i) {
    const double varpi = dice.between(0.5, 20.0);
    const SwitchedLaw law = test::anyLaw(dice, varpi);
    const int active = dice.index(law.count());
    const Truth truth = anyTruth(dice, law, 4.0);
    const SwitchedInput in = test::anyInput(dice, 1.0);
    const Eigen::Vector4d r = law.output(active, in).filtered_error;
    const Eigen::Vector4d chi =
        anyUncertainty(dice, in, r, truth.theta[static_cast<std::size_t>(active)]);
    const double V = test::lyapunov(law, active, in.error, truth);
    const double layer =
        r.norm() < varpi ? 0.25 * varpi * test::layerTerm(law.subsystem(active), in.error) : 0.0;
    ASSERT_LE(
        lyapunovRate(law, active, in, chi, truth),
        -test::leastDecay(law) * V + test::derivedDelta(law, active, truth) + layer + tolerance(V))
        << i;
  }
}

// Eq. mu at any state and any pair of subsystems.
TEST(SwitchedTheorem, ASwitchMultipliesVByAtMostMu) {
  Dice dice(14);
  double largest = 0.0;
  for (int i = 0; i < 1000; ++i) {
    const SwitchedLaw law = test::anyLaw(dice, 0.1);
    const Truth truth = anyTruth(dice, law, 4.0);
    const double mu = averageDwellTime(law.spectra(), 0.9).mu;
    const int from = dice.index(law.count());
    const int to = dice.index(law.count());
    // Along the direction in which the switch hurts most.
    const Matrix8d& before = law.subsystem(from).lyapunovMatrix();
    const Matrix8d& after = law.subsystem(to).lyapunovMatrix();
    const Eigen::GeneralizedSelfAdjointEigenSolver<Matrix8d> solver(after, before);
    const Vector8d xi = dice.between(0.1, 100.0) * solver.eigenvectors().col(7);
    const double ratio = test::lyapunov(law, to, xi, truth) / test::lyapunov(law, from, xi, truth);
    ASSERT_LE(ratio, mu * (1.0 + 1e-12)) << i;
    largest = std::max(largest, ratio);
  }
  EXPECT_GT(largest, 2.0);
}

// Eq. psi_bound with the printed Theta*, on the chapter's model with its lateral motion.
TEST(SwitchedTheorem, UncertaintyOfTheVehicleIsWithinItsBound) {
  Dice dice(15);
  for (int i = 0; i < 3000; ++i) {
    const test::EulerBody body{dice.between(0.5, 3.0), test::anyVector(dice, 0.1, 1.0).head<3>(),
                               dice.between(0.2, 1.0)};
    const Eigen::Matrix4d D = test::anyPositiveDefinite<4>(dice, 0.2, 2.0);
    test::EulerMotion motion;
    motion.q = test::anyVector(dice, -1.4, 1.4);
    motion.rate = test::anyVector(dice, -3.0, 3.0);
    const Eigen::Vector4d tau = test::anyVector(dice, -20.0, 20.0);
    const Eigen::Vector4d d = test::anyVector(dice, -1.0, 1.0);
    const test::EulerAcceleration a = test::accelerate(body, motion, tau, d);
    const Eigen::Vector4d desired_rate = test::anyVector(dice, -1.0, 1.0);
    const Eigen::Vector4d error = test::anyVector(dice, -2.0, 2.0);
    const double xi = std::hypot(error.norm(), (motion.rate - desired_rate).norm());

    Eigen::Matrix4d M = Eigen::Matrix4d::Zero();
    M(0, 0) = body.mass * std::cos(motion.q[1]) * std::cos(motion.q[2]);
    M.diagonal().tail<3>() = body.effectiveInertia();
    const Eigen::Matrix4d inverse = D.inverse();
    const Eigen::Vector4d chi = inverse * (D * a.q - tau);  // -D^-1 E
    const auto norm = [](const Eigen::MatrixXd& m) { return m.operatorNorm(); };
    const Eigen::Vector3d& I = body.inertia;
    const double c = std::max({std::abs(I.z() - I.y()) / body.arm_length,
                               std::abs(I.x() - I.z()) / body.arm_length, std::abs(I.y() - I.x())});
    const double slope = desired_rate.norm();
    const Eigen::Vector4d theta(
        norm(inverse) * (body.mass * kGravity + d.norm() + c * slope * slope),
        2.0 * c * norm(inverse) * slope, c * norm(inverse),
        norm(inverse * M - Eigen::Matrix4d::Identity()) + norm(inverse) * body.mass);
    ASSERT_LE(chi.norm(), theta.dot(Eigen::Vector4d(1.0, xi, xi * xi, a.norm())) + 1e-9) << i;
  }
}

}  // namespace
}  // namespace aqc
