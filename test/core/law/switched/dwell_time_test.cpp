#include "adaptive_quadrotor_control/law/switched/dwell_time.h"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <cmath>
#include <stdexcept>

#include "adaptive_quadrotor_control/law/switched/subsystem_switch.h"
#include "adaptive_quadrotor_control/math/lyapunov.h"
#include "support/refusal.h"
#include "support/switched_laws.h"

namespace aqc {
namespace {

// P of one scalar axis with Q = 2 I, by hand: the three equations of A'P + P A = -Q.
Eigen::Matrix2d handSolved(double k1, double k2) {
  const double p12 = 1.0 / k1;
  const double p22 = (1.0 + p12) / k2;
  Eigen::Matrix2d P;
  P << k2 * p12 + k1 * p22, p12, p12, p22;
  return P;
}

Eigen::Matrix2d companion(double k1, double k2) {
  Eigen::Matrix2d A;
  A << 0.0, 1.0, -k1, -k2;
  return A;
}

TEST(Lyapunov, MatchesTheSolutionByHand) {
  for (const auto& [k1, k2] : {std::pair(120.0, 100.0), std::pair(0.5, 3.0), std::pair(7.0, 0.1)}) {
    const Eigen::MatrixXd P = solveLyapunov(companion(k1, k2), 2.0 * Eigen::Matrix2d::Identity());
    EXPECT_LT((P - handSolved(k1, k2)).norm(), 1e-11 * P.norm()) << k1 << ' ' << k2;
  }
}

TEST(Lyapunov, RefusesWhatHasNoLyapunovFunction) {
  const Eigen::Matrix2d Q = Eigen::Matrix2d::Identity();
  const auto refusal = [](const Eigen::MatrixXd& A, const Eigen::MatrixXd& weight) {
    return test::refusal<std::domain_error>([&] { solveLyapunov(A, weight); });
  };
  EXPECT_EQ(refusal(companion(1.0, 0.0), Q).substr(0, 35), "A is not Hurwitz, or badly scaled: ")
      << "oscillates";
  EXPECT_EQ(refusal(companion(-2.0, -1.0), Q),  // diverges
            "A is not Hurwitz: P has the eigenvalue -0.309016994375; every one must be > 0");
  EXPECT_EQ(refusal(companion(1.0, 1.0), -Q), "Q has the eigenvalue -1; every one must be > 0");
  Eigen::Matrix2d skew = Q;
  skew(0, 1) = 0.1;
  EXPECT_EQ(refusal(companion(1.0, 1.0), skew), "Q is not symmetric");
  const Eigen::Matrix2d A = companion(1.0, 1.0);
  const std::pair<Eigen::MatrixXd, Eigen::MatrixXd> unfit[] = {
      {companion(NAN, 1.0), Q},
      {A, Eigen::Matrix2d::Constant(NAN)},
      {A.topRows(1), Eigen::MatrixXd::Ones(1, 1)},
      {A, Eigen::MatrixXd::Ones(2, 3)},
      {A, Eigen::MatrixXd::Ones(3, 2)}};
  for (const auto& [dynamics, weight] : unfit) {
    EXPECT_EQ(refusal(dynamics, weight), "A and Q must be square, of one size and finite")
        << dynamics << "\n"
        << weight;
  }
}

// The thesis prints 6.57 s, its parameters in its own definitions give 6.760 s.
TEST(DwellTime, OfTheThesisParameters) {
  const DwellTime bound = test::makeLaw(test::thesisTree())->subsystems()->bound();
  EXPECT_NEAR(bound.mu, 298.0, 0.05);
  EXPECT_NEAR(bound.varrho, 0.93645, 5e-6);
  EXPECT_DOUBLE_EQ(bound.kappa, 0.9 * bound.varrho);
  EXPECT_NEAR(bound.least, 6.760, 5e-4);
  EXPECT_NEAR(bound.least, std::log(bound.mu) / bound.kappa, 1e-12);
  EXPECT_NE(bound.text().find("theta* = 6.7597 s"), std::string::npos) << bound.text();
}

// Where the printed value comes from: lambda_min of subsystem 2 instead of the least of all three.
TEST(DwellTime, PrintedValueUsesTheWrongSubsystem) {
  const auto law = test::makeLaw(test::thesisTree());
  const double p_min = law->law().subsystem(1).spectrum().p_min;
  double p_max = 0.0;
  for (const LyapunovSpectrum& spectrum : law->law().spectra()) {
    p_max = std::max(p_max, spectrum.p_max);
    EXPECT_LE(law->law().subsystem(2).spectrum().p_min, spectrum.p_min);
  }
  EXPECT_NEAR(std::log(p_max / p_min) / law->subsystems()->bound().kappa, 6.576, 5e-4);
}

TEST(DwellTime, RefusesWhatGivesNone) {
  const LyapunovSpectrum good{1.0, 2.0, 1.0};
  EXPECT_THROW(averageDwellTime({}, 0.9), std::invalid_argument);
  EXPECT_THROW(averageDwellTime({good}, 0.0), std::invalid_argument);
  EXPECT_EQ(test::refusal([&] { averageDwellTime({good}, 1.0); }),
            "kappa / varrho is 1; it must be > 0 and < 1");
  EXPECT_THROW(averageDwellTime({good, {0.0, 2.0, 1.0}}, 0.9), std::invalid_argument);
  EXPECT_THROW(averageDwellTime({{1.0, 2.0, NAN}}, 0.9), std::invalid_argument);
}

TEST(DwellTime, TakesTheWorstOverAllSubsystems) {
  const DwellTime bound =
      averageDwellTime({{0.5, 2.0, 1.0}, {0.1, 1.0, 0.3}, {1.0, 4.0, 4.0}}, 0.5);
  EXPECT_DOUBLE_EQ(bound.mu, 4.0 / 0.1);
  EXPECT_DOUBLE_EQ(bound.varrho, 0.3);
  EXPECT_DOUBLE_EQ(bound.least, std::log(40.0) / 0.15);
}

TEST(DwellTimeMonitor, RefusesNumbersThatForbidEverySwitch) {
  EXPECT_EQ(test::refusal([] { DwellTimeMonitor(10, 0.999); }),
            "the chatter bound N_0 is 0.999; it must be >= 1 and <= 1000");
  EXPECT_THROW(DwellTimeMonitor(10, NAN), std::invalid_argument);
  EXPECT_THROW(DwellTimeMonitor(10, 1001.0), std::invalid_argument);
  EXPECT_EQ(test::refusal([] { DwellTimeMonitor(0, 1.0); }),
            "the dwell time is 0 ns; it must be >= 1 and <= 1000000000000000");
  EXPECT_NO_THROW(DwellTimeMonitor(1, 1.0));
}

TEST(DwellTimeMonitor, WithoutChatterEverySwitchWaitsOneDwellTime) {
  DwellTimeMonitor monitor(100, 1.0);
  EXPECT_TRUE(monitor.allows(5));
  monitor.record(5);
  EXPECT_EQ(monitor.earliest(5), 105);
  EXPECT_FALSE(monitor.allows(104));
  EXPECT_TRUE(monitor.allows(105));
  EXPECT_EQ(monitor.earliest(300), 300);
}

TEST(DwellTimeMonitor, ChatterBoundLetsABurstPass) {
  DwellTimeMonitor monitor(100, 2.5);
  monitor.record(0);
  monitor.record(0);
  EXPECT_EQ(monitor.earliest(0), 50);  // 3 <= 2.5 + 50 / 100
  monitor.record(50);
  EXPECT_EQ(monitor.earliest(50), 150);  // 4 <= 2.5 + 150 / 100
  EXPECT_EQ(monitor.earliest(1000), 1000);
}

// A quiet time longer than the burst earns no further credit.
TEST(DwellTimeMonitor, CreditIsBounded) {
  DwellTimeMonitor monitor(100, 2.0);
  monitor.record(0);
  monitor.record(1'000'000);
  monitor.record(1'000'000);
  EXPECT_EQ(monitor.earliest(1'000'000), 1'000'100);
}

TEST(DwellTimeMonitor, TimeThatRunsBackwardsEarnsNothing) {
  DwellTimeMonitor monitor(100, 1.0);
  monitor.record(1000);
  EXPECT_EQ(monitor.earliest(10), 1100);
  monitor.record(10);
  EXPECT_EQ(monitor.earliest(10), 1200);
  monitor.reset();
  EXPECT_TRUE(monitor.allows(10));
}

// 0.7 as a double is below seven tenths: seven nanoseconds of ten do not fit.
TEST(DwellTimeMonitor, CapacityIsRoundedDownExactly) {
  DwellTimeMonitor monitor(10, 1.7);
  monitor.record(0);
  EXPECT_EQ(monitor.earliest(0), 4);
  DwellTimeMonitor half(10, 1.5);
  half.record(0);
  EXPECT_EQ(half.earliest(0), 5);
}

SubsystemSwitch makeSwitch(SubsystemSwitch::Policy policy) {
  return {3, 1, averageDwellTime({{1.0, 2.0, 1.0}}, 0.9), DwellTimeMonitor(100, 1.0), policy};
}

TEST(SubsystemSwitch, RefusesEarlySwitchesAndSaysWhen) {
  SubsystemSwitch sigma = makeSwitch(SubsystemSwitch::Policy::kRefuse);
  EXPECT_EQ(sigma.request(2, 1000).outcome, SwitchOutcome::kSwitched);
  const SwitchVerdict early = sigma.request(3, 1099);
  EXPECT_EQ(early.outcome, SwitchOutcome::kTooEarly);
  EXPECT_FALSE(early.accepted());
  EXPECT_EQ(early.earliest, 1100);
  EXPECT_EQ(sigma.active(), 2);
  EXPECT_TRUE(sigma.request(3, early.earliest).accepted());
  EXPECT_EQ(sigma.active(), 3);
  EXPECT_EQ(sigma.counts().switched, 2);
  EXPECT_EQ(sigma.counts().too_early, 1);
}

TEST(SubsystemSwitch, WarnsButSwitches) {
  SubsystemSwitch sigma = makeSwitch(SubsystemSwitch::Policy::kWarn);
  sigma.request(2, 0);
  const SwitchVerdict early = sigma.request(3, 40);
  EXPECT_EQ(early.outcome, SwitchOutcome::kSwitchedTooEarly);
  EXPECT_TRUE(early.accepted());
  EXPECT_EQ(early.earliest, 100);
  EXPECT_EQ(sigma.active(), 3);
  EXPECT_EQ(sigma.earliest(40), 200);  // the early switch counts
  EXPECT_EQ(sigma.counts().too_early, 1);
}

TEST(SubsystemSwitch, CountsOnlyChanges) {
  SubsystemSwitch sigma = makeSwitch(SubsystemSwitch::Policy::kRefuse);
  for (int i = 0; i < 5; ++i) {
    EXPECT_EQ(sigma.request(1, i).outcome, SwitchOutcome::kAlreadyActive);
  }
  EXPECT_EQ(sigma.request(0, 5).outcome, SwitchOutcome::kUnknownSubsystem);
  EXPECT_EQ(sigma.request(4, 5).outcome, SwitchOutcome::kUnknownSubsystem);
  EXPECT_EQ(sigma.counts().unknown, 2);
  EXPECT_EQ(sigma.counts().switched, 0);
  EXPECT_TRUE(sigma.request(2, 5).accepted());
  sigma.restart();
  EXPECT_EQ(sigma.active(), 1);
  EXPECT_EQ(sigma.counts().unknown, 0);
  EXPECT_TRUE(sigma.request(3, 6).accepted());
}

TEST(SubsystemSwitch, RefusesAnInitialSubsystemThatDoesNotExist) {
  const DwellTime bound = averageDwellTime({{1.0, 2.0, 1.0}}, 0.9);
  const DwellTimeMonitor monitor(1, 1.0);
  const auto policy = SubsystemSwitch::Policy::kRefuse;
  EXPECT_EQ(test::refusal([&] { SubsystemSwitch(3, 4, bound, monitor, policy); }),
            "the initial subsystem is 4; it must be >= 1 and <= 3, the number of subsystems");
  EXPECT_THROW(SubsystemSwitch(3, 0, bound, monitor, policy), std::invalid_argument);
  EXPECT_THROW(SubsystemSwitch(0, 1, bound, monitor, policy), std::invalid_argument);
}

// The policy warn lets the bucket overfill without end, and the new dwell time may be far longer.
TEST(DwellTimeMonitor, AdoptedFromAnOverfilledOneItIsFull) {
  DwellTimeMonitor old(1'000'000, 1.0);
  for (int i = 0; i < 100'000; ++i) old.record(0);
  DwellTimeMonitor monitor(DwellTimeMonitor::kLongest, 1.0);
  monitor.adopt(old);
  EXPECT_FALSE(monitor.allows(0));
  EXPECT_EQ(monitor.earliest(0), DwellTimeMonitor::kLongest);
}

TEST(SubsystemSwitch, OfOneSubsystemHasNothingToSwitch) {
  SubsystemSwitch sigma(1, 1, averageDwellTime({{1.0, 2.0, 1.0}}, 0.9), DwellTimeMonitor(1, 1.0),
                        SubsystemSwitch::Policy::kRefuse);
  EXPECT_EQ(sigma.request(1, 0).outcome, SwitchOutcome::kAlreadyActive);
  EXPECT_EQ(sigma.request(2, 0).outcome, SwitchOutcome::kUnknownSubsystem);
}

}  // namespace
}  // namespace aqc
