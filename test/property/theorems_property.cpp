#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <limits>
#include <vector>

#include "adaptive_quadrotor_control/control/dwell_time.h"
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

SwitchedInput anyInput(Dice& dice, double size) {
  SwitchedInput in;
  for (double& entry : in.error) entry = dice.between(-size, size);
  in.desired_acceleration = test::anyVector(dice, -2.0, 2.0);
  in.acceleration = dice.between(0.0, 8.0);
  return in;
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
    const SwitchedInput in = anyInput(dice, 1.5);
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
    const SwitchedInput in = anyInput(dice, 1.5);
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
    const SwitchedInput in = anyInput(dice, 1.0);
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

/// A closed loop under the worst uncertainty, switched as often as the dwell time allows. It starts
/// with a large error and small gains: whatever makes the gains large makes the bound larger still,
/// and V would never be above it.
struct Loop {
  SwitchedLaw law;
  std::vector<Eigen::Vector4d> theta;  // Theta*
  DwellTime dwell;
  double chatter;  // N_0
  unsigned seed;
};

constexpr double kStep = 2.5e-4;    // [s]
constexpr double kDuration = 12.0;  // [s]
constexpr double kQuiet = 5.0;      // before the first switch [s]

Loop anyLoop(Dice& dice, unsigned seed) {
  std::vector<SubsystemParameters> subsystems;
  for (int count = 2 + dice.index(3); count > 0; --count) {
    subsystems.push_back(test::anySubsystem(dice));
    SubsystemParameters& p = subsystems.back();
    p.initial_theta = test::anyVector(dice, 0.01, 0.1);
    p.initial_zeta = p.zeta_drive * dice.between(1.05, 1.3);
    p.initial_gamma = p.gamma_drive * dice.between(1.05, 1.3);
    p.leak *= 2.0;
  }
  Loop loop{SwitchedLaw(subsystems, dice.between(0.05, 0.2)), {}, {}, dice.between(1.0, 3.0), seed};
  for (int s = 0; s < loop.law.count(); ++s) {
    loop.theta.push_back(test::anyVector(dice, 0.0, 0.2));
  }
  loop.dwell = averageDwellTime(loop.law.spectra(), dice.between(0.05, 0.2));
  return loop;
}

Eigen::Vector4d worstUncertainty(const SwitchedInput& in, const Eigen::Vector4d& r,
                                 const Eigen::Vector4d& theta, double time) {
  const Eigen::Vector4d aside(0.5, -0.5, std::sin(time), 0.0);
  const Eigen::Vector4d direction = std::fmod(time, 2.0) < 1.5 && r.norm() > 0.0 ? r : aside;
  return test::uncertaintyBound(in, theta) * direction.normalized();
}

/// Runs the loop and shows every step to visit(law, active subsystem, xi). The same every time.
template <typename Visitor>
void run(const Loop& loop, Visitor&& visit) {
  Dice dice(loop.seed);
  SwitchedLaw law = loop.law;
  DwellTimeMonitor monitor(fromSeconds(loop.dwell.least) + 1, loop.chatter);
  SwitchedInput in = anyInput(dice, 2.5);
  int active = 0;
  for (double time = 0.0; time < kDuration; time += kStep) {
    if (time > kQuiet && dice.index(2000) == 0 && monitor.allows(fromSeconds(time))) {
      monitor.record(fromSeconds(time));
      active = (active + 1 + dice.index(law.count() - 1)) % law.count();
    }
    visit(law, active, in.error);
    in.acceleration = 0.05 + 0.05 * std::sin(3.0 * time);
    in.desired_acceleration.setConstant(std::sin(time));
    const SwitchedOutput out = law.output(active, in);
    const Eigen::Vector4d chi = worstUncertainty(
        in, out.filtered_error, loop.theta[static_cast<std::size_t>(active)], time);
    in.error += kStep * test::errorRate(law.subsystem(active), in, out, chi);
    law.adapt(active, in, out.filtered_error.norm(), kStep);
  }
}

/// What the theorem takes from the run itself: see the docs on what that is worth.
struct RunBounds {
  Truth truth;
  double layer = 0.0;  // delta_1
};

void expectInBounds(const SubsystemGains& gains, const SubsystemParameters& p) {
  ASSERT_GE(gains.theta.minCoeff(), 0.0);
  ASSERT_GT(gains.zeta, 0.0);
  ASSERT_LE(gains.zeta, p.initial_zeta);
  ASSERT_GT(gains.gamma, 0.0);
  ASSERT_LE(gains.gamma, p.initial_gamma);
}

RunBounds measureBounds(const Loop& loop) {
  constexpr double kMost = std::numeric_limits<double>::max();
  RunBounds bounds{{loop.theta, kMost, kMost}};
  run(loop, [&bounds](const SwitchedLaw& law, int active, const Vector8d& xi) {
    for (int s = 0; s < law.count(); ++s) {
      const SubsystemGains& gains = law.subsystem(s).gains();
      expectInBounds(gains, law.subsystem(s).parameters());
      bounds.truth.least_zeta = std::min(bounds.truth.least_zeta, gains.zeta);
      bounds.truth.least_gamma = std::min(bounds.truth.least_gamma, gains.gamma);
    }
    const SwitchedSubsystem& subsystem = law.subsystem(active);
    const Eigen::Vector4d r = subsystem.lyapunovMatrix().bottomRows<4>() * xi;
    if (r.norm() < law.boundaryLayer()) {
      bounds.layer = std::max(bounds.layer, test::layerTerm(subsystem, xi));
    }
  });
  return bounds;
}

/// The theorem, checked at every step of a second run.
class Judge {
 public:
  Judge(const Loop& loop, const RunBounds& bounds)
      : truth_(bounds.truth), dwell_(loop.dwell), ceiling_(std::pow(dwell_.mu, loop.chatter)) {
    for (int s = 0; s < loop.law.count(); ++s) {
      delta_ = std::max(delta_, test::derivedDelta(loop.law, s, truth_));
      p_min_ = std::min(p_min_, loop.law.subsystem(s).spectrum().p_min);
    }
    delta_ += 0.25 * loop.law.boundaryLayer() * bounds.layer;
    bound_ = delta_ / (dwell_.varrho - dwell_.kappa);
  }

  void operator()(const SwitchedLaw& law, int active, const Vector8d& xi) {
    if (active_ >= 0) expectDecay(test::lyapunov(law, active_, xi, truth_));
    const double V = test::lyapunov(law, active, xi, truth_);
    if (active_ >= 0 && active != active_) {
      ++switches;
      EXPECT_LE(V, dwell_.mu * test::lyapunov(law, active_, xi, truth_));
    }
    if (active_ < 0) start_ = V;
    active_ = active;
    V_ = V;
    entered = entered || V < bound_;
    const double most = ceiling_ * (entered ? bound_ : start_);
    EXPECT_LE(V, most);
    EXPECT_LE(xi.norm(), std::sqrt(2.0 * most / p_min_));  // less by sqrt(mu) than printed
  }

  int above = 0;  // steps that began above the bound B
  int switches = 0;
  bool entered = false;

 private:
  // Over one step with one subsystem active.
  void expectDecay(double next) {
    EXPECT_LE(next - V_, kStep * (-dwell_.varrho * V_ + delta_) + 1e-3 * kStep * (1.0 + V_));
    if (V_ < bound_) return;
    ++above;
    EXPECT_LE(next, V_ * (1.0 - 0.99 * dwell_.kappa * kStep));
  }

  Truth truth_;
  DwellTime dwell_;
  double ceiling_;  // c = mu^N_0
  double delta_ = 0.0;
  double p_min_ = std::numeric_limits<double>::max();
  double bound_ = 0.0;  // B
  int active_ = -1;
  double V_ = 0.0;
  double start_ = 0.0;
};

TEST(SwitchedTheorem, HoldsAlongSwitchedClosedLoops) {
  Dice dice(16);
  int above = 0;
  int switches = 0;
  for (unsigned seed = 1; seed <= 12 && !HasFailure(); ++seed) {
    const Loop loop = anyLoop(dice, seed);
    Judge judge(loop, measureBounds(loop));
    run(loop, [&judge](const SwitchedLaw& law, int active, const Vector8d& xi) {
      judge(law, active, xi);
    });
    EXPECT_TRUE(judge.entered) << seed;
    above += judge.above;
    switches += judge.switches;
  }
  EXPECT_GT(above, 1000);
  EXPECT_GT(switches, 10);
  RecordProperty("steps_above_bound", above);
  RecordProperty("switches", switches);
}

}  // namespace
}  // namespace aqc
