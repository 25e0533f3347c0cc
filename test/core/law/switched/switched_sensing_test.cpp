#include <gtest/gtest.h>

#include <cmath>

#include "adaptive_quadrotor_control/math/filtered_derivative.h"
#include "support/euler_model.h"
#include "support/switched_laws.h"

namespace aqc {
namespace {

using test::kClimbing;
using test::makeLaw;
using test::plainTree;
using test::thesisTree;

// What the switched law makes of attitude, body rate and accelerometer.

constexpr double kStep = 0.01;  // [s]

TEST(Switched, ErrorsAreEulerAnglesAndTheirRates) {
  const auto law = makeLaw(plainTree());
  test::Dice dice(3);
  for (int i = 0; i < 100; ++i) {
    test::EulerMotion motion;
    motion.q << dice.between(-3.0, 3.0), dice.between(-3.0, 3.0), dice.between(-1.4, 1.4),
        dice.between(-3.0, 3.0);
    motion.rate.tail<3>() = dice.vector(3.0);
    test::step(*law, {test::toState(motion)}, {}, kStep);
    EXPECT_LT((law->telemetry().attitude_error - motion.q.tail<3>()).norm(), 1e-9);
    EXPECT_LT((law->telemetry().rate_error - motion.rate.tail<3>()).norm(), 1e-9);
  }
}

TEST(Switched, YawErrorTakesTheShortWay) {
  const auto law = makeLaw(plainTree());
  test::EulerMotion motion;
  motion.q[3] = 3.0;
  SetPoint set_point;
  set_point.yaw = -3.0 + 4.0 * M_PI;
  set_point.yaw_rate = 0.5;
  test::step(*law, {test::toState(motion)}, set_point, kStep);
  EXPECT_NEAR(law->telemetry().attitude_error.z(), 6.0 - 2.0 * M_PI, 1e-9);
  EXPECT_NEAR(law->telemetry().rate_error.z(), -0.5, 1e-12);
}

TEST(Switched, StaysFiniteAtVerticalPitch) {
  const auto law = makeLaw(thesisTree());
  for (const double pitch : {0.5 * M_PI, -0.5 * M_PI, 0.5 * M_PI - 1e-9, 1.55}) {
    State state;
    state.attitude = Eigen::AngleAxisd(pitch, Eigen::Vector3d::UnitY());
    state.body_rate = {1.0, 2.0, 3.0};
    const Wrench wrench = test::step(*law, {state}, {}, kStep);
    EXPECT_TRUE(std::isfinite(wrench.thrust) && wrench.moment.allFinite()) << pitch;
    EXPECT_LT(law->telemetry().rate_error.norm(), 50.0) << pitch;
  }
}

// ||q-ddot|| in rho: 0.4 of it here, all else equal.
double accelerationSeen(const Switched& law, const State& state, const SetPoint& set_point) {
  Vector8d xi;
  xi << (state.position - set_point.position).z(), law.telemetry().attitude_error,
      (state.velocity - set_point.velocity).z(), law.telemetry().rate_error;
  const double rest = 0.1 + 0.2 * xi.norm() + 0.3 * xi.squaredNorm() + 0.75;
  const AdaptiveValues& values = law.telemetry().adaptive;
  return (values[values.size() - 1] - rest) / 0.4;
}

TEST(Switched, AccelerationComesFromTheAccelerometer) {
  test::Dice dice(5);
  for (int i = 0; i < 20; ++i) {
    const auto law = makeLaw(plainTree());
    State state = dice.airborneState();
    const Eigen::Vector3d acceleration = dice.vector(10.0);
    const Eigen::Vector3d felt =
        state.attitude.conjugate() * (acceleration + kGravity * Eigen::Vector3d::UnitZ());
    test::step(*law, {state, felt}, {}, kStep);
    EXPECT_NEAR(accelerationSeen(*law, state, {}), acceleration.norm(), 1e-9);
  }
}

TEST(Switched, HoldsNoSampleBeyondItsStep) {
  const auto silent = makeLaw(plainTree());
  const auto law = makeLaw(plainTree());
  State state;
  state.velocity.z() = 0.1;
  for (int i = 0; i < 5; ++i) {
    state.velocity.z() += 0.01;
    EXPECT_EQ(test::step(*law, {state}, {}, kStep).thrust,
              test::step(*silent, {state}, {}, kStep).thrust);
  }
  EXPECT_NE(test::step(*law, {state, kClimbing}, {}, kStep).thrust,
            test::step(*silent, {state}, {}, kStep).thrust);
}

TEST(Switched, WithoutOneItComesFromTheVelocityBehindTheLowPass) {
  const auto law = makeLaw(plainTree());
  State state;
  test::step(*law, {state}, {}, kStep);
  EXPECT_NEAR(accelerationSeen(*law, state, {}), 0.0, 1e-12);
  state.velocity = {0.03, 0.0, 0.0};   // 3 m/s^2 over one step
  state.body_rate = {0.04, 0.0, 0.0};  // 4 rad/s^2
  test::step(*law, {state}, {}, kStep);
  const double share = 1.0 - std::exp(-2.0 * M_PI * 10.0 * kStep);
  // The gains themselves moved a little during the first step.
  EXPECT_NEAR(accelerationSeen(*law, state, {}), 5.0 * share, 0.15);
}

TEST(Switched, FilteredDerivativeSettlesOnTheSlope) {
  FilteredDerivative derivative(10.0);
  for (int i = 0; i < 200; ++i) derivative.step({0.03 * i, -1.0, -0.02 * i}, kStep);
  EXPECT_LT((derivative.value() - Eigen::Vector3d(3.0, 0.0, -2.0)).norm(), 1e-9);
  derivative.reset();
  derivative.step({100.0, 0.0, 0.0}, kStep);
  EXPECT_EQ(derivative.value(), Eigen::Vector3d::Zero());
}

}  // namespace
}  // namespace aqc
