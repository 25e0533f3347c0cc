#include "adaptive_quadrotor_control/reference/governor.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

namespace aqc {
namespace {

using Eigen::Vector3d;

constexpr double kPlenty = 3.0;  // thrust to weight
constexpr double kNoFloor = -std::numeric_limits<double>::infinity();

SetPoint at(const Vector3d& position) {
  SetPoint set_point;
  set_point.position = position;
  return set_point;
}

// A step with the vehicle where the reference is.
const SetPoint& followExactly(ReferenceGovernor& governor, const SetPoint& wanted, double dt) {
  const Vector3d here = governor.setPoint().position;
  return governor.follow(wanted, here, kPlenty, kNoFloor, dt);
}

void expectWithin(const SetPoint& before, const SetPoint& now, const GovernorLimits& limits,
                  double dt) {
  constexpr double kRounding = 1e-9;
  EXPECT_LE(now.velocity.head<2>().norm(), limits.horizontal_speed + kRounding);
  EXPECT_LE(now.velocity.z(), limits.climb_speed + kRounding);
  EXPECT_GE(now.velocity.z(), -limits.descent_speed - kRounding);
  EXPECT_LE(now.acceleration.head<2>().norm(), limits.acceleration + kRounding);
  EXPECT_LE(std::abs(now.acceleration.z()), limits.vertical_acceleration + kRounding);
  EXPECT_LE(now.jerk.head<2>().norm(), limits.jerk + kRounding);
  EXPECT_LE(std::abs(now.jerk.z()), limits.jerk + kRounding);
  const Vector3d change = now.acceleration - before.acceleration;
  EXPECT_LE(change.head<2>().norm(), limits.jerk * dt + kRounding);
  EXPECT_LE(std::abs(change.z()), limits.jerk * dt + kRounding);
  EXPECT_LE(std::abs(now.yaw_rate), limits.yaw_rate + kRounding);
  EXPECT_LE(std::abs(now.yaw_acceleration), limits.yaw_acceleration + kRounding);
}

TEST(Governor, KeepsTheLimitsWhateverIsWanted) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> any(-1.0, 1.0);
  const GovernorLimits limits;
  for (int run = 0; run < 40; ++run) {
    ReferenceGovernor governor(limits);
    governor.restart({});
    SetPoint wanted;
    for (int i = 0; i < 1000; ++i) {
      if (any(random) > 0.95) {
        const double size = std::pow(10.0, 3.0 * any(random));
        wanted.position = size * Vector3d(any(random), any(random), any(random));
        wanted.velocity = 5.0 * Vector3d(any(random), any(random), any(random));
        wanted.acceleration = 5.0 * Vector3d(any(random), any(random), any(random));
        wanted.yaw = 7.0 * any(random);
      }
      const double dt = 0.0101 + 0.01 * any(random);
      const SetPoint before = governor.setPoint();
      expectWithin(before, followExactly(governor, wanted, dt), limits, dt);
    }
    if (HasFailure()) return;
  }
}

TEST(Governor, StepsArriveSoonAndDoNotOvershoot) {
  const double dt = 0.01;
  for (const double distance : {1.0, 10.0, 100.0, 1e4}) {
    const GovernorLimits limits;
    ReferenceGovernor governor(limits);
    governor.restart({});
    const Vector3d direction(0.6, -0.8, 0.0);
    const double v = limits.horizontal_speed, a = limits.acceleration;
    const double shortest =
        distance > v * v / a ? distance / v + v / a : 2.0 * std::sqrt(distance / a);
    for (double t = 0.0; t < 1.5 * shortest; t += dt) {
      const SetPoint& now = followExactly(governor, at(distance * direction), dt);
      ASSERT_LE(now.position.dot(direction), distance + 0.01);
    }
    EXPECT_NEAR(governor.setPoint().position.dot(direction), distance, 0.01) << distance;
  }
}

TEST(Governor, PassesOnAMotionWithinTheLimits) {
  ReferenceGovernor governor({});
  governor.restart({});
  const double dt = 0.01;
  for (double t = 0.0; t < 20.0; t += dt) {
    SetPoint wanted = at(Vector3d(2.0 * std::sin(t), 2.0 * std::cos(t), 1.0));
    wanted.velocity = Vector3d(2.0 * std::cos(t), -2.0 * std::sin(t), 0.0);
    wanted.acceleration = Vector3d(-2.0 * std::sin(t), -2.0 * std::cos(t), 0.0);
    wanted.jerk = Vector3d(-2.0 * std::cos(t), 2.0 * std::sin(t), 0.0);
    const SetPoint& now = followExactly(governor, wanted, dt);
    if (t < 8.0) continue;
    ASSERT_LT((now.position - wanted.position).norm(), 1e-3) << t;
    ASSERT_EQ(now.acceleration, wanted.acceleration) << t;
    ASSERT_EQ(now.jerk, wanted.jerk) << t;
  }
}

TEST(Governor, IsNeverFurtherAheadThanTheLead) {
  ReferenceGovernor governor({});
  governor.restart({});
  for (int i = 0; i < 1000; ++i) {
    const double there = i < 500 ? 0.0 : 50.0;  // the vehicle is stuck, then somewhere else
    const SetPoint& now =
        governor.follow(at({100.0, 0.0, 0.0}), {there, 0.0, 0.0}, kPlenty, kNoFloor, 0.01);
    ASSERT_LE(std::abs(now.position.x() - there), 1.0 + 1e-9);
  }
}

TEST(Governor, StaysAboveTheFloorAndTurnsTheShortWay) {
  ReferenceGovernor governor({});
  SetPoint start = at({0.0, 0.0, 2.0});
  start.yaw = 3.0;
  governor.restart(start);
  SetPoint wanted = at({0.0, 0.0, -5.0});
  wanted.yaw = -3.0;
  for (int i = 0; i < 1000; ++i) {
    const Vector3d here = governor.setPoint().position;
    ASSERT_GE(governor.follow(wanted, here, kPlenty, 0.5, 0.01).position.z(), 0.49);
    ASSERT_GE(governor.setPoint().yaw, 3.0);
  }
  EXPECT_NEAR(governor.setPoint().position.z(), 0.5, 1e-3);
  EXPECT_NEAR(governor.setPoint().yaw, 2.0 * M_PI - 3.0, 1e-3);
  wanted.position.x() = std::nan("");
  EXPECT_NEAR(followExactly(governor, wanted, 0.01).position.z(), 0.5, 1e-2);
}

}  // namespace
}  // namespace aqc
