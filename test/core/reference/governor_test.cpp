#include "adaptive_quadrotor_control/reference/governor.h"

#include <gtest/gtest.h>
#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "adaptive_quadrotor_control/math/constants.h"
#include "adaptive_quadrotor_control/math/rotations.h"
#include "adaptive_quadrotor_control/parameters/parameter_reader.h"

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

TEST(Governor, IsNeverFurtherAboveThanTheLead) {
  ReferenceGovernor governor({});
  governor.restart(at({0.0, 0.0, 5.0}));
  const SetPoint here = at({0.0, 0.0, 5.0});
  for (const double height : {5.0, 2.0, 9.0}) {  // the vehicle falls, and is lifted
    const SetPoint& now = governor.follow(here, {0.0, 0.0, height}, kPlenty, kNoFloor, 0.01);
    ASSERT_LE(std::abs(now.position.z() - height), 1.0 + 1e-9) << height;
  }
}

TEST(Governor, RestsAtTheFloorWhateverTheSpeedWantedBelow) {
  ReferenceGovernor governor({});
  governor.restart(at({0.0, 0.0, 2.0}));
  SetPoint wanted = at({0.0, 0.0, -5.0});
  wanted.velocity.z() = -1.0;
  wanted.acceleration.z() = -1.0;
  for (int i = 0; i < 1000; ++i) {
    const Vector3d here = governor.setPoint().position;
    ASSERT_GE(governor.follow(wanted, here, kPlenty, 0.5, 0.01).position.z(), 0.49);
  }
  EXPECT_NEAR(governor.setPoint().position.z(), 0.5, 1e-6);
  EXPECT_NEAR(governor.setPoint().velocity.z(), 0.0, 1e-6);
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

const std::vector<std::pair<const char*, double GovernorLimits::*>> kLimits = {
    {"horizontal_speed", &GovernorLimits::horizontal_speed},
    {"climb_speed", &GovernorLimits::climb_speed},
    {"descent_speed", &GovernorLimits::descent_speed},
    {"acceleration", &GovernorLimits::acceleration},
    {"vertical_acceleration", &GovernorLimits::vertical_acceleration},
    {"jerk", &GovernorLimits::jerk},
    {"yaw_rate", &GovernorLimits::yaw_rate},
    {"yaw_acceleration", &GovernorLimits::yaw_acceleration},
    {"lead", &GovernorLimits::lead}};

GovernorLimits readFrom(const YAML::Node& tree) {
  const ParameterReader reader(tree, "governor");
  const GovernorLimits limits = readGovernorLimits(reader);
  reader.finish();
  return limits;
}

TEST(GovernorLimits, AreReadByNameOrStayAsTheyAre) {
  YAML::Node tree(YAML::NodeType::Map);
  for (const auto& [name, limit] : kLimits) {
    EXPECT_EQ(readFrom(tree).*limit, GovernorLimits().*limit) << name;
  }
  double value = 0.5;
  for (const auto& [name, limit] : kLimits) tree[name] = value += 1.0;
  tree["floor"] = -3.0;
  const GovernorLimits limits = readFrom(tree);
  value = 0.5;
  for (const auto& [name, limit] : kLimits) EXPECT_EQ(limits.*limit, value += 1.0) << name;
  EXPECT_EQ(limits.floor, -3.0);
}

TEST(GovernorLimits, OutOfRangeAreRefusedByName) {
  const auto expectRefused = [](const std::string& name, const char* value) {
    YAML::Node tree;
    tree[name] = value;
    try {
      readFrom(tree);
      ADD_FAILURE() << name << ": " << value;
    } catch (const ParameterError& error) {
      EXPECT_NE(std::string(error.what()).find(name), std::string::npos) << error.what();
    }
  };
  for (const auto& [name, limit] : kLimits) {
    for (const char* value : {"0", "-1", "1e7", ".nan", ".inf", "fast"}) expectRefused(name, value);
  }
  for (const char* value : {".nan", ".inf", "low"}) expectRefused("floor", value);
}

TEST(Governor, ShiftMovesAndTurnsTheWholeMotion) {
  ReferenceGovernor governor({});
  governor.restart({});
  SetPoint wanted = at({30.0, 0.0, 2.0});
  wanted.yaw = 1.0;
  for (int i = 0; i < 60; ++i) followExactly(governor, wanted, 0.01);
  ReferenceGovernor shifted = governor;
  const Vector3d shift(5.0, -3.0, 0.7);
  shifted.shift(shift, M_PI_2);
  const Eigen::Quaterniond turn = yawRotation(M_PI_2);
  const SetPoint& before = governor.setPoint();
  const SetPoint& after = shifted.setPoint();
  EXPECT_GT(before.velocity.x(), 0.5);
  EXPECT_LT((after.position - before.position - shift).norm(), 1e-12);
  EXPECT_LT((after.velocity - turn * before.velocity).norm(), 1e-12);
  EXPECT_LT((after.acceleration - turn * before.acceleration).norm(), 1e-12);
  EXPECT_LT((after.jerk - turn * before.jerk).norm(), 1e-12);
  EXPECT_NEAR(after.yaw, before.yaw + M_PI_2, 1e-12);
  EXPECT_EQ(after.yaw_rate, before.yaw_rate);
  // What is not valid means to stay at the last one, which has moved as well.
  wanted.position.x() = std::nan("");
  for (int i = 0; i < 2000; ++i) followExactly(shifted, wanted, 0.01);
  EXPECT_LT((after.position - Vector3d(35.0, -3.0, 2.7)).norm(), 1e-3);
  EXPECT_NEAR(after.yaw, 1.0 + M_PI_2, 1e-3);
}

// The greatest thrust over the weight that a way through the room takes, and whether it arrives.
double greatestThrust(double thrust_to_weight, Vector3d& fastest) {
  ReferenceGovernor governor({});
  governor.restart(at({0.0, 0.0, 1.0}));
  const SetPoint wanted = at({20.0, 10.0, 6.0});
  double greatest = 0.0;
  fastest.setZero();
  for (int i = 0; i < 12000; ++i) {
    const Vector3d here = governor.setPoint().position;
    const SetPoint& now = governor.follow(wanted, here, thrust_to_weight, kNoFloor, 0.01);
    const Vector3d force = now.acceleration + kGravity * Vector3d::UnitZ();
    greatest = std::max(greatest, force.norm() / kGravity);
    fastest = fastest.cwiseMax(now.acceleration.cwiseAbs());
  }
  EXPECT_LT((governor.setPoint().position - wanted.position).norm(), 1e-3) << thrust_to_weight;
  return greatest;
}

TEST(Governor, AsksForNoMoreThanTheRotorsCanDo) {
  Vector3d fastest;
  for (const double ratio : {1.15, 1.3, 2.0}) {
    EXPECT_LE(greatestThrust(ratio, fastest), 0.9 * ratio + 1e-9);
    EXPECT_GT(fastest.head<2>().norm(), 1.5) << ratio;
  }
  greatestThrust(0.8, fastest);  // nothing to spare: slowly, but there
  EXPECT_LE(fastest.head<2>().norm(), 0.15);
  EXPECT_LE(fastest.z(), 0.1 + 1e-9);
  greatestThrust(std::nan(""), fastest);
  EXPECT_GT(fastest.z(), 2.0) << "what is not a number bounds nothing";
  EXPECT_GT(fastest.head<2>().norm(), 3.0);
}

TEST(Governor, BeginsFasterThanTheLimitsAndBrakesWithinThem) {
  const GovernorLimits limits;
  ReferenceGovernor governor(limits);
  SetPoint fast = at({0.0, 0.0, 50.0});
  fast.velocity = {8.0, -6.0, -5.0};
  fast.yaw_rate = 4.0;
  governor.restart(fast);
  EXPECT_EQ(governor.setPoint().velocity, fast.velocity);
  EXPECT_EQ(governor.setPoint().acceleration, Vector3d(Vector3d::Zero()));
  const SetPoint wanted = at({0.0, 0.0, 40.0});
  for (int i = 0; i < 4000; ++i) {
    const SetPoint before = governor.setPoint();
    const SetPoint& now = followExactly(governor, wanted, 0.01);
    const double speed = before.velocity.head<2>().norm();
    ASSERT_LE(now.velocity.head<2>().norm(), std::max(limits.horizontal_speed, speed) + 1e-9) << i;
    ASSERT_LE(now.acceleration.head<2>().norm(), limits.acceleration + 1e-9) << i;
    ASSERT_LE(std::abs(now.acceleration.z()), limits.vertical_acceleration + 1e-9) << i;
    ASSERT_LE((now.acceleration - before.acceleration).head<2>().norm(), 0.01 * limits.jerk + 1e-9);
    ASSERT_LE(std::abs(now.yaw_acceleration), limits.yaw_acceleration + 1e-9) << i;
  }
  EXPECT_LT((governor.setPoint().position - wanted.position).norm(), 1e-3);
  EXPECT_LT(governor.setPoint().velocity.norm(), 1e-3);
}

TEST(Governor, KnowsNoNorth) {
  const double angle = 1.1;
  const Eigen::Quaterniond turn = yawRotation(angle);
  std::mt19937 random(7);
  std::uniform_real_distribution<double> any(-1.0, 1.0);
  ReferenceGovernor plain({}), turned({});
  plain.restart({});
  SetPoint start;
  start.yaw = angle;
  turned.restart(start);
  SetPoint wanted, wanted_turned;
  for (int i = 0; i < 4000; ++i) {
    if (i % 300 == 0) {
      wanted.position = 6.0 * Vector3d(any(random), any(random), any(random));
      wanted.velocity = Vector3d(any(random), any(random), any(random));
      wanted.yaw = any(random);
      wanted_turned = wanted;
      wanted_turned.position = turn * wanted.position;
      wanted_turned.velocity = turn * wanted.velocity;
      wanted_turned.yaw += angle;
    }
    const Vector3d here = 0.7 * plain.setPoint().position;
    const SetPoint& a = plain.follow(wanted, here, 1.5, kNoFloor, 0.01);
    const SetPoint& b = turned.follow(wanted_turned, turn * here, 1.5, kNoFloor, 0.01);
    ASSERT_LT((turn * a.position - b.position).norm(), 1e-6) << i;
    ASSERT_LT((turn * a.velocity - b.velocity).norm(), 1e-5) << i;
    ASSERT_NEAR(a.yaw + angle, b.yaw, 1e-6) << i;
  }
}

}  // namespace
}  // namespace aqc
