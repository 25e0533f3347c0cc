#include "adaptive_quadrotor_control/law/integral.h"

#include <gtest/gtest.h>
#include <yaml-cpp/yaml.h>

#include <Eigen/Eigenvalues>
#include <complex>

#include "adaptive_quadrotor_control/law/bearable.h"
#include "adaptive_quadrotor_control/parameters/parameter_reader.h"
#include "support/fixtures.h"

namespace aqc {
namespace {

// Round numbers, the same in every axis.
constexpr double kPosition = 8.0;   // k_x
constexpr double kVelocity = 4.0;   // k_v
constexpr double kForce = 3.0;      // k_Ip
constexpr double kForceMix = 1.5;   // c_p
constexpr double kMoment = 0.5;     // k_Iq
constexpr double kMomentMix = 2.0;  // c_q

std::unique_ptr<ControlLaw> made() {
  YAML::Node gains = YAML::Load(R"(
    law: integral
    max_tilt_deg: 45
    min_lift: 2
    position_gain: [8, 8, 8]
    velocity_gain: [4, 4, 4]
    attitude_gain: [1, 1, 1]
    rate_gain: [0.2, 0.2, 0.2]
    force_integral: {gain: [3, 3, 3], mix: 1.5}
    moment_integral: {gain: [0.5, 0.5, 0.5], mix: 2}
  )");
  return makeLaw(ParameterReader(gains, "gains"), test::pelican());
}

Eigen::Vector3d forceOf(const ControlLaw& law) {
  return law.telemetry().adaptive.head<3>();
}
Eigen::Vector3d momentOf(const ControlLaw& law) {
  return law.telemetry().adaptive.tail<3>();
}

State displaced() {
  State state;
  state.position = {0.2, 0.0, -0.1};
  state.velocity = {0.0, 0.3, 0.4};
  return state;
}

TEST(IntegralLaw, IntegratesErrorAndRateAndTakesItFromTheNextCommand) {
  const auto law = made();
  test::step(*law, {displaced()}, {}, 0.01);
  // df_I = 3 (de + 1.5 e) = 3 (0.3, 0.3, 0.4 - 0.15).
  EXPECT_LT((forceOf(*law) - Eigen::Vector3d(0.009, 0.009, 0.0075)).norm(), 1e-15);
  const Eigen::Vector3d before = law->telemetry().force;
  test::step(*law, {displaced()}, {}, 0.01);
  EXPECT_LT((before - law->telemetry().force - Eigen::Vector3d(0.009, 0.009, 0.0075)).norm(),
            1e-13);
}

TEST(IntegralLaw, IntegratesTheAttitudesErrorToo) {
  const auto law = made();
  State state;
  state.attitude = Eigen::AngleAxisd(M_PI / 6.0, Eigen::Vector3d::UnitX());
  state.body_rate = {0.4, 0.0, 0.0};
  const Wrench first = test::step(*law, {state}, {}, 0.01);
  // e_q = sin 30 deg: dm_I = 0.5 (0.4 + 2 * 0.5) about x.
  EXPECT_LT((momentOf(*law) - Eigen::Vector3d(0.007, 0.0, 0.0)).norm(), 1e-12);
  const Wrench second = test::step(*law, {state}, {}, 0.01);
  EXPECT_NEAR(first.moment.x() - second.moment.x(), 0.007, 1e-12);
}

// Upwards m dde = -k_v de - k_x e - f_I + d, df_I = k_I (de + c e): by the modes of that matrix.
TEST(IntegralLaw, RemovesAConstantForceAsFastAsItsPolesSay) {
  const double mass = test::pelican().mass;
  constexpr double kPush = -4.0;
  Eigen::Matrix3d rates;  // of (e, de, f_I - d)
  rates << 0.0, 1.0, 0.0, -kPosition / mass, -kVelocity / mass, -1.0 / mass, kForce * kForceMix,
      kForce, 0.0;
  const Eigen::EigenSolver<Eigen::Matrix3d> modes(rates);
  const Eigen::Vector3cd start =
      modes.eigenvectors().lu().solve(Eigen::Vector3cd(0.0, 0.0, -kPush));
  const auto law = made();
  State state;
  constexpr double kStep = 1e-4;
  double peak = 0.0;
  for (int i = 1; i <= 60'000; ++i) {
    const double thrust = test::step(*law, {state}, {}, kStep).thrust;
    const double acceleration = (thrust + kPush) / mass - kGravity;
    state.position.z() += kStep * (state.velocity.z() + 0.5 * kStep * acceleration);
    state.velocity.z() += kStep * acceleration;
    peak = std::max(peak, std::abs(state.position.z()));
    if (i % 5'000 != 0) continue;
    const Eigen::Vector3cd decayed =
        (modes.eigenvalues() * (i * kStep)).array().exp() * start.array();
    const double expected = (modes.eigenvectors() * decayed)[0].real();
    EXPECT_NEAR(state.position.z(), expected, 1e-4) << "after " << i * kStep << " s";
  }
  EXPECT_GT(peak, 0.2);
  EXPECT_LT(std::abs(state.position.z()), 0.1 * peak);
}

/// One step in which the rotors give `given` of what was asked for.
template <class Change>
void stepWith(ControlLaw& law, const State& state, const Change& change) {
  Allocation allocation;
  allocation.requested = allocation.achieved = law.command({state}, {}, 0.01);
  change(allocation.achieved);
  allocation.saturated = true;
  law.adapt({allocation, allocation.speeds}, 0.01);
}

TEST(IntegralLaw, AsksForNoMoreOfAThrustThatIsNotThere) {
  State low, high;
  low.position = {0.5, 0.0, -1.0};
  high.position = {0.5, 0.0, 1.0};
  const auto less = [](Wrench& given) { given.thrust -= 1.0; };
  const auto more = [](Wrench& given) { given.thrust += 1.0; };
  const auto law = made();
  stepWith(*law, low, less);
  EXPECT_EQ(forceOf(*law).z(), 0.0) << "it would ask for more";
  EXPECT_GT(forceOf(*law).x(), 0.0) << "across the thrust it goes on";
  stepWith(*law, high, more);
  EXPECT_EQ(forceOf(*law).z(), 0.0) << "it would ask for less";
  stepWith(*law, high, less);
  EXPECT_GT(forceOf(*law).z(), 0.0) << "on the way back";
  stepWith(*law, low, more);
  EXPECT_NEAR(forceOf(*law).z(), 0.0, 1e-15) << "on the way back";
}

TEST(IntegralLaw, AsksForNoMoreOfAMomentThatIsNotThere) {
  State tilted;
  tilted.attitude = Eigen::AngleAxisd(0.3, Eigen::Vector3d::UnitX());
  const auto law = made();
  stepWith(*law, tilted, [](Wrench& given) { given.moment.x() = 0.0; });
  EXPECT_EQ(momentOf(*law).x(), 0.0);
  stepWith(*law, tilted, [](Wrench& given) { given.moment.x() -= 1.0; });
  EXPECT_GT(momentOf(*law).x(), 0.0);
}

TEST(IntegralLaw, HoldsItsIntegralsWithinWhatRotorsBear) {
  const auto law = made();
  State far;
  far.position = {0.0, 300.0, -400.0};
  far.attitude = Eigen::AngleAxisd(1.0, Eigen::Vector3d::UnitZ());
  for (int i = 0; i < 200; ++i) test::step(*law, {far}, {}, 0.01);
  const Bearable most = bearable(test::pelican());
  EXPECT_NEAR(forceOf(*law).norm(), most.force, 1e-9);
  EXPECT_NEAR(forceOf(*law).y(), 0.6 * most.force, 1e-9) << "the direction stays";
  EXPECT_EQ(momentOf(*law).z(), most.moment.z());
}

TEST(IntegralLaw, FollowsTheTurnThatTheJerkAsksFor) {
  const auto law = made();
  SetPoint set_point;
  set_point.jerk = {0.0, -kGravity, 0.0};
  const Wrench wrench = test::step(*law, {}, set_point, 0.01);
  // F = m g e_z turns with m j: e_z x j / g = (1, 0, 0) rad/s; de_q = -omega_d, k_omega = 0.2.
  EXPECT_LT((law->telemetry().rate_error - Eigen::Vector3d(-1.0, 0.0, 0.0)).norm(), 1e-12);
  EXPECT_NEAR(wrench.moment.x(), 0.2, 1e-12);
}

TEST(IntegralLaw, TakesOverTheWeightThatAnotherLawHeldUp) {
  const Vehicle vehicle = test::pelican();
  const auto old = test::lawNamed("smc", vehicle);
  State low;
  low.position.z() = -0.1;
  test::step(*old, {low}, {}, 0.01);
  const auto law = made();
  law->adopt(*old);
  EXPECT_NEAR(law->command({}, {}, 0.01).thrust, old->telemetry().force.z(), 1e-12);
  EXPECT_NE(old->telemetry().force.z(), vehicle.mass * kGravity);
}

}  // namespace
}  // namespace aqc
