#include "adaptive_quadrotor_control/model/rotor_allocation.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>

#include "support/fixtures.h"

namespace aqc {
namespace {

Eigen::Vector4d numbers(const Wrench& wrench) {
  return {wrench.thrust, wrench.moment.x(), wrench.moment.y(), wrench.moment.z()};
}

double distance(const Wrench& a, const Wrench& b) {
  return (numbers(a) - numbers(b)).norm();
}

class EveryVehicle : public ::testing::TestWithParam<const char*> {
 protected:
  const Vehicle vehicle_ = test::vehicleNamed(GetParam());
  const RotorAllocation rotors_{vehicle_};
  const double hover_ = vehicle_.mass * kGravity;
};

TEST_P(EveryVehicle, RotorsGiveExactlyTheWrenchAskedFor) {
  ASSERT_TRUE(rotors_.wellPosed());
  test::Dice dice(1);
  for (int i = 0; i < 200; ++i) {
    const Wrench request{hover_ * dice.between(0.8, 1.2),
                         hover_ * vehicle_.rotors[0].arm_length * dice.vector(0.1)};
    const Wrench gentle{request.thrust, request.moment.cwiseProduct(Eigen::Vector3d(1, 1, 0.02))};
    const Allocation allocation = rotors_.allocate(gentle);
    EXPECT_FALSE(allocation.saturated);
    EXPECT_LT(distance(rotors_.wrench(allocation.speeds), gentle), 1e-10);
    EXPECT_EQ(distance(allocation.achieved, gentle), 0.0);
    EXPECT_EQ(distance(allocation.requested, gentle), 0.0);
  }
}

TEST_P(EveryVehicle, WrenchIsTheSumOverTheRotors) {
  test::Dice dice(2);
  for (int i = 0; i < 50; ++i) {
    const RotorArray speeds = dice.speeds(vehicle_);
    Wrench sum;
    for (std::size_t r = 0; r < vehicle_.rotors.size(); ++r) {
      const Rotor& rotor = vehicle_.rotors[r];
      const double square = std::pow(speeds[static_cast<Eigen::Index>(r)], 2);
      const double thrust = vehicle_.force_constant * square;
      sum.thrust += thrust;
      sum.moment.x() += thrust * rotor.arm_length * std::sin(rotor.angle);
      sum.moment.y() -= thrust * rotor.arm_length * std::cos(rotor.angle);
      sum.moment.z() -= thrust * rotor.direction * vehicle_.moment_constant;
    }
    EXPECT_LT(distance(rotors_.wrench(speeds), sum), 1e-10);
  }
}

TEST_P(EveryVehicle, YawGivesWayFirst) {
  const double roll = 0.2 * hover_ * vehicle_.rotors[0].arm_length;
  const Wrench request{hover_, {roll, 0.0, 1e3}};
  const Allocation allocation = rotors_.allocate(request);
  EXPECT_TRUE(allocation.saturated);
  EXPECT_NEAR(allocation.achieved.thrust, hover_, 1e-6 * hover_);
  EXPECT_NEAR(allocation.achieved.moment.x(), roll, 1e-6);
  EXPECT_NEAR(allocation.achieved.moment.y(), 0.0, 1e-6);
  EXPECT_GT(allocation.achieved.moment.z(), 0.01) << "as much as the rotors have left";
  EXPECT_LT(allocation.achieved.moment.z(), 1e3);
}

TEST_P(EveryVehicle, ThrustGivesWayNext) {
  // Full thrust leaves no room for a moment, no thrust neither.
  const Eigen::Vector3d moment =
      0.2 * vehicle_.maxThrust() * vehicle_.rotors[0].arm_length * Eigen::Vector3d(0.6, -0.3, 0.0);
  for (const double thrust : {-100.0, 0.0, vehicle_.maxThrust(), 1e4}) {
    const Allocation allocation = rotors_.allocate({thrust, moment});
    EXPECT_TRUE(allocation.saturated);
    EXPECT_LT((allocation.achieved.moment - moment).norm(), 1e-6);
    EXPECT_GT(allocation.achieved.thrust, 0.0);
    EXPECT_LT(allocation.achieved.thrust, vehicle_.maxThrust());
  }
}

TEST_P(EveryVehicle, ThrustMovesNoFurtherThanItMust) {
  const double roll = 0.1 * vehicle_.maxThrust() * vehicle_.rotors[0].arm_length;
  const double low = rotors_.allocate({0.0, {roll, 0.0, 0.0}}).achieved.thrust;
  const double high = rotors_.allocate({1e4, {roll, 0.0, 0.0}}).achieved.thrust;
  EXPECT_LT(low, high);
  EXPECT_NEAR(low + high, vehicle_.maxThrust(), 1e-5) << "both ends have the same room";
  EXPECT_NEAR(rotors_.allocate({0.0, {roll, 0.0, 0.0}}).speeds.minCoeff(), 0.0,
              1e-3 * vehicle_.max_rotor_speed);
  EXPECT_NEAR(rotors_.allocate({1e4, {roll, 0.0, 0.0}}).speeds.maxCoeff(), vehicle_.max_rotor_speed,
              1e-6 * vehicle_.max_rotor_speed);
}

TEST_P(EveryVehicle, RollAndPitchGiveWayLastAndKeepTheirDirection) {
  test::Dice dice(3);
  for (int i = 0; i < 100; ++i) {
    const double angle = dice.between(-M_PI, M_PI);
    const Eigen::Vector2d direction(std::cos(angle), std::sin(angle));
    const Wrench request{hover_, {1e3 * direction.x(), 1e3 * direction.y(), dice.between(-5, 5)}};
    const Allocation allocation = rotors_.allocate(request);
    EXPECT_TRUE(allocation.saturated);
    const Eigen::Vector2d achieved = allocation.achieved.moment.head<2>();
    EXPECT_LT((achieved.normalized() - direction).norm(), 1e-6);
    EXPECT_GT(achieved.norm(), 0.2 * vehicle_.maxThrust() * vehicle_.rotors[0].arm_length);
    EXPECT_NEAR(allocation.achieved.moment.z(), 0.0, 1e-6) << "no room for yaw";
  }
}

TEST_P(EveryVehicle, AnyRequestIsAnsweredWithinLimitsAndTruthfully) {
  test::Dice dice(4);
  for (int i = 0; i < 2000; ++i) {
    const double size = std::pow(10.0, dice.between(-3.0, 6.0));
    const Wrench request{dice.between(-size, size), dice.vector(size)};
    const Allocation allocation = rotors_.allocate(request);
    ASSERT_GE(allocation.speeds.minCoeff(), 0.0);
    ASSERT_LE(allocation.speeds.maxCoeff(), vehicle_.max_rotor_speed * (1.0 + 1e-12));
    ASSERT_LT(distance(allocation.achieved, rotors_.wrench(allocation.speeds)), 1e-8);
    ASSERT_EQ(allocation.saturated, distance(allocation.achieved, request) > 1e-7);
  }
}

TEST_P(EveryVehicle, NonFiniteRequestsStopTheRotors) {
  for (const double bad :
       {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity(),
        -std::numeric_limits<double>::infinity()}) {
    for (int entry = 0; entry < 4; ++entry) {
      Wrench request{hover_, Eigen::Vector3d::Zero()};
      (entry == 0 ? request.thrust : request.moment[entry - 1]) = bad;
      const Allocation allocation = rotors_.allocate(request);
      EXPECT_TRUE(allocation.saturated);
      EXPECT_EQ(allocation.speeds.size(), static_cast<Eigen::Index>(vehicle_.rotors.size()));
      EXPECT_EQ(allocation.speeds.norm(), 0.0);
      EXPECT_EQ(numbers(allocation.achieved).norm(), 0.0);
    }
  }
}

TEST_P(EveryVehicle, HugeFiniteRequestsStayFinite) {
  for (const double size : {1e100, 1e300, std::numeric_limits<double>::max()}) {
    const Allocation allocation = rotors_.allocate({size, {-size, size, size}});
    EXPECT_TRUE(allocation.speeds.allFinite());
    EXPECT_TRUE(numbers(allocation.achieved).allFinite());
    EXPECT_LE(allocation.speeds.maxCoeff(), vehicle_.max_rotor_speed * (1.0 + 1e-12));
  }
}

INSTANTIATE_TEST_SUITE_P(RotorAllocation, EveryVehicle,
                         ::testing::Values("pelican_thesis", "pelican", "hummingbird", "firefly"),
                         [](const auto& parameter) { return std::string(parameter.param); });

TEST(RotorAllocation, PelicanWorkedByHand) {
  // "+" layout. Roll tau needs rotor 2 (left) up and rotor 4 (right) down by tau / (2 l).
  const Vehicle vehicle = test::pelican();
  const RotorAllocation rotors(vehicle);
  const Allocation allocation = rotors.allocate({20.0, {0.42, 0.0, 0.0}});
  const double k = vehicle.force_constant;
  EXPECT_NEAR(k * std::pow(allocation.speeds[0], 2), 5.0, 1e-12);
  EXPECT_NEAR(k * std::pow(allocation.speeds[1], 2), 6.0, 1e-12);
  EXPECT_NEAR(k * std::pow(allocation.speeds[2], 2), 5.0, 1e-12);
  EXPECT_NEAR(k * std::pow(allocation.speeds[3], 2), 4.0, 1e-12);
  // Yaw 0.064 = 0.016 * 4 N: the clockwise rotors 1 and 3 take one newton more each.
  const Allocation yaw = rotors.allocate({20.0, {0.0, 0.0, 0.064}});
  EXPECT_NEAR(k * std::pow(yaw.speeds[0], 2), 6.0, 1e-12);
  EXPECT_NEAR(k * std::pow(yaw.speeds[1], 2), 4.0, 1e-12);
}

TEST(RotorAllocation, SeesLayoutsThatCannotFly) {
  Vehicle vehicle = test::pelican();
  for (Rotor& rotor : vehicle.rotors) rotor.direction = 1;
  EXPECT_FALSE(RotorAllocation(vehicle).wellPosed()) << "no yaw";
  vehicle = test::pelican();
  for (Rotor& rotor : vehicle.rotors) rotor.angle = 0.0;
  EXPECT_FALSE(RotorAllocation(vehicle).wellPosed()) << "no roll";
}

}  // namespace
}  // namespace aqc
