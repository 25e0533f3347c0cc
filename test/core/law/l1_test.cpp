#include "adaptive_quadrotor_control/law/l1.h"

#include <gtest/gtest.h>
#include <yaml-cpp/yaml.h>

#include <cmath>

#include "adaptive_quadrotor_control/law/bearable.h"
#include "adaptive_quadrotor_control/parameters/parameter_reader.h"
#include "support/fixtures.h"

namespace aqc {
namespace {

constexpr double kStep = 0.004;
constexpr double kVelocityDecay = 20.0;  // a_v [1/s]
constexpr double kRateDecay = 50.0;      // a_w [1/s]
constexpr double kThrust = 15.0;         // omega_c [rad/s]
constexpr double kMoment = 8.0;

std::unique_ptr<ControlLaw> made() {
  YAML::Node gains = YAML::Load(R"(
    law: l1
    max_tilt_deg: 45
    min_lift: 2
    position_gain: [8, 8, 8]
    velocity_gain: [4, 4, 4]
    attitude_gain: [1, 1, 1]
    rate_gain: [0.2, 0.2, 0.2]
    predictor: {decay: [20, 50], bandwidth: [15, 8]}
  )");
  return makeLaw(ParameterReader(gains, "gains"), test::pelican());
}

Eigen::Vector3d forceOf(const ControlLaw& law) {
  return law.telemetry().adaptive.head<3>();
}
Eigen::Vector3d momentOf(const ControlLaw& law) {
  return law.telemetry().adaptive.tail<3>();
}

// What the discrete adaptation law leaves of a constant disturbance: a T / (exp(a T) - 1).
double seenOf(double decay) {
  return decay * kStep / std::expm1(decay * kStep);
}

// A vehicle whose velocity and rate are linear in what the rotors give: it is at its place, level,
// and turns about one axis only. All that it is given is what was asked for.
class Pushed {
 public:
  explicit Pushed(ControlLaw& law) : law_(law) {}

  Wrench step(const Eigen::Vector3d& force, double moment_z) {
    const Wrench wrench = test::step(law_, {state_}, {}, kStep);
    const Eigen::Vector3d thrust(0.0, 0.0, wrench.thrust);
    state_.velocity +=
        kStep * ((thrust + force) / vehicle_.mass - kGravity * Eigen::Vector3d::UnitZ());
    state_.body_rate.z() += kStep * (wrench.moment.z() + moment_z) / vehicle_.inertia(2, 2);
    return wrench;
  }
  const State& state() const { return state_; }

 private:
  ControlLaw& law_;
  State state_;
  const Vehicle vehicle_ = test::pelican();
};

TEST(L1Law, KnowsAConstantDisturbanceOneSampleLater) {
  const auto law = made();
  Pushed vehicle(*law);
  const Eigen::Vector3d force(1.0, -2.0, -3.0);
  vehicle.step(force, 0.1);
  EXPECT_EQ(forceOf(*law).norm(), 0.0) << "nobody knows it yet";
  for (int i = 0; i < 5; ++i) {
    vehicle.step(force, 0.1);
    EXPECT_LT((forceOf(*law) - seenOf(kVelocityDecay) * force).norm(), 1e-9);
    EXPECT_NEAR(momentOf(*law).z(), seenOf(kRateDecay) * 0.1, 1e-9);
  }
  vehicle.step({0.0, 0.0, 0.0}, 0.0);  // was pushed until now
  vehicle.step({0.0, 0.0, 0.0}, 0.0);
  EXPECT_LT(forceOf(*law).norm(), 1e-9) << "and that it is gone";
}

TEST(L1Law, AnswersBehindALowPassOfItsBandwidth) {
  const auto law = made();
  const auto base = made();  // never told what was given, it estimates nothing
  Pushed vehicle(*law);
  for (int i = 0; i < 200; ++i) {
    const State state = vehicle.state();
    const Wrench wrench = vehicle.step({0.0, 0.0, -3.0}, 0.1);
    const Wrench without = base->command({state}, {}, kStep);
    const double time = i * kStep;
    EXPECT_NEAR(wrench.thrust - without.thrust,
                seenOf(kVelocityDecay) * 3.0 * -std::expm1(-kThrust * time), 1e-9);
    EXPECT_NEAR(wrench.moment.z() - without.moment.z(),
                seenOf(kRateDecay) * 0.1 * std::expm1(-kMoment * time), 1e-9);
  }
}

TEST(L1Law, DoesNotAnswerWhatPushesAcrossTheThrust) {
  const auto law = made();
  const auto base = made();
  Pushed vehicle(*law);
  for (int i = 0; i < 50; ++i) {
    const State state = vehicle.state();
    const Wrench wrench = vehicle.step({2.0, 1.0, 0.0}, 0.0);
    EXPECT_NEAR(wrench.thrust, base->command({state}, {}, kStep).thrust, 1e-12);
  }
  EXPECT_GT(forceOf(*law).norm(), 2.0);
}

TEST(L1Law, TakesNoLimitOfTheRotorsForADisturbance) {
  const auto law = made();
  State state;
  const Vehicle vehicle = test::pelican();
  for (int i = 0; i < 10; ++i) {
    Allocation allocation;
    allocation.requested = law->command({state}, {}, kStep);
    allocation.achieved = allocation.requested;
    allocation.achieved.thrust -= 5.0;
    allocation.achieved.moment.z() += 0.05;
    allocation.saturated = true;
    law->adapt({allocation, allocation.speeds}, kStep);
    state.velocity.z() += kStep * (allocation.achieved.thrust / vehicle.mass - kGravity);
    state.body_rate.z() += kStep * allocation.achieved.moment.z() / vehicle.inertia(2, 2);
  }
  EXPECT_LT(forceOf(*law).norm(), 1e-9);
  EXPECT_LT(momentOf(*law).norm(), 1e-9);
}

TEST(L1Law, BelievesNoMoreThanRotorsBear) {
  const auto law = made();
  State state;
  test::step(*law, {state}, {}, kStep);
  state.velocity = {0.0, 3e3, 4e3};
  state.body_rate = {0.0, 0.0, 1e5};
  test::step(*law, {state}, {}, kStep);
  const Bearable most = bearable(test::pelican());
  EXPECT_NEAR(forceOf(*law).norm(), most.force, 1e-9);
  EXPECT_EQ(momentOf(*law).z(), most.moment.z());
}

TEST(L1Law, AfterARestComparesNothing) {
  const auto law = made();
  Pushed vehicle(*law);
  for (int i = 0; i < 3; ++i) vehicle.step({0.0, 0.0, -3.0}, 0.0);
  const Eigen::Vector3d learned = forceOf(*law);
  State fast = vehicle.state();
  fast.velocity.z() += 5.0;
  law->command({fast}, {}, kStep);  // adaptation rests
  fast.velocity.z() += 5.0;
  test::step(*law, {fast}, {}, kStep);
  EXPECT_EQ((forceOf(*law) - learned).norm(), 0.0);
}

TEST(L1Law, TakesOverTheWeightThatAnotherLawHeldUp) {
  const Vehicle vehicle = test::pelican();
  const auto old = test::lawNamed("smc", vehicle);
  State low;
  low.position.z() = -0.1;
  test::step(*old, {low}, {}, kStep);
  const auto law = made();
  law->adopt(*old);
  EXPECT_NEAR(law->command({}, {}, kStep).thrust, old->telemetry().force.z(), 1e-12);
  EXPECT_NEAR(law->telemetry().liftedMass(), old->telemetry().liftedMass(), 1e-12);
}

}  // namespace
}  // namespace aqc
