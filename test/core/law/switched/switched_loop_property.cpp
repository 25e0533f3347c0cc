#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "adaptive_quadrotor_control/law/switched/dwell_time.h"
#include "support/fixtures.h"
#include "support/switched_lyapunov.h"

/// The theorem of thesis chapter 3 along closed loops, with the controller's own code.
/// docs/switched_control.md has the derivations and what is wrong in print.
namespace aqc {
namespace {

using test::Dice;
using test::Truth;

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
  SwitchedInput in = test::anyInput(dice, 2.5);
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
