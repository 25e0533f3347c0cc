// The ways to lose a vehicle that a review found, numbered as there, flown with a guard.

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "support/guarded_flight.h"

namespace aqc {
namespace {

using test::expectLanded;
using test::GuardedFlight;

constexpr Nanoseconds kSecond = 1'000'000'000;

class GuardedFlightTest : public ::testing::TestWithParam<const char*> {
 protected:
  void expectHolding(GuardedFlight& flight, double height) {
    EXPECT_EQ(flight.mode(), Mode::kHolding);
    EXPECT_NEAR(flight.height(), height, 0.3);
    EXPECT_LT(flight.speed(), 0.2);
    EXPECT_FALSE(flight.crashed());
    EXPECT_TRUE(flight.inRange());
  }
};

TEST_P(GuardedFlightTest, TakesOffHoldsFliesAndLands) {
  GuardedFlight flight(GetParam());
  flight.takeOff();
  flight.go(2.0, 1.0, 2.0);
  flight.fly(8.0);
  EXPECT_EQ(flight.mode(), Mode::kFlying);
  EXPECT_LT((flight.plant().state().position - Eigen::Vector3d(2.0, 1.0, 2.0)).norm(), 0.3);
  EXPECT_EQ(flight.pilot().guard()->land(), nullptr);
  flight.fly(9.0);
  expectLanded(flight);
  EXPECT_EQ(flight.rule(), Rule::kTouchDown);
}

// BUG 1
TEST_P(GuardedFlightTest, Bug1StampsAheadOrBackDoNotStopTheRotors) {
  for (const Nanoseconds step : {10 * kSecond, -2 * kSecond, -GuardedFlight::kStart}) {
    GuardedFlight flight(GetParam());
    flight.takeOff();
    const Nanoseconds once = flight.now() + kSecond;
    flight.odometry = [&](State&, Nanoseconds& stamp, Nanoseconds&) {
      if (stamp == once) stamp += step;
      return true;
    };
    flight.fly(4.0);
    expectHolding(flight, 1.1);
  }
}
TEST_P(GuardedFlightTest, Bug1AClockThatStepsBackForEverEndsPlansNotTheFlight) {
  GuardedFlight flight(GetParam());
  flight.takeOff();
  flight.go(3.0, 0.0, 1.5);
  flight.fly(1.0);
  const Nanoseconds step = flight.now();
  flight.odometry = [&](State&, Nanoseconds& stamp, Nanoseconds& now) {
    if (stamp >= step) stamp = now -= 3 * kSecond;
    return true;
  };
  flight.fly(7.0);
  EXPECT_EQ(flight.rule(), Rule::kClockStep);
  expectHolding(flight, 1.4);
}

// BUG 2
TEST_P(GuardedFlightTest, Bug2AnAbsurdNumberIsRefusedWholeAndLeavesNoTrace) {
  for (const double huge : {std::nan(""), HUGE_VAL, 1e308, 1e160, 1e30, 1e6, 100.0}) {
    for (int field = 0; field < 3; ++field) {
      GuardedFlight flight(GetParam());
      flight.takeOff();
      const Nanoseconds once = flight.now() + kSecond;
      flight.odometry = [&](State& state, Nanoseconds& stamp, Nanoseconds&) {
        if (stamp != once) return true;
        (field == 0 ? state.position : field == 1 ? state.velocity : state.body_rate).z() = huge;
        return true;
      };
      flight.fly(3.0);
      expectHolding(flight, 1.1);
      EXPECT_EQ(flight.pilot().droppedOdometry(), 1u) << huge << " in " << field;
    }
    GuardedFlight flight(GetParam());
    flight.takeOff();
    if (!(std::abs(huge) <= 1e3)) {
      EXPECT_THROW(flight.go(huge, 0.0, 1.5), std::invalid_argument) << huge;
    }
    flight.fly(1.0);
    expectHolding(flight, 1.1);
  }
}

TEST_P(GuardedFlightTest, Bug2AnAbsurdImuSampleIsRefusedAndLeavesNoTrace) {
  for (const double huge : {std::nan(""), HUGE_VAL, 1e308, 1e200, 1e6}) {
    for (const bool rate : {false, true}) {
      GuardedFlight flight(GetParam());
      flight.takeOff();
      const Eigen::Vector3d absurd(huge, 0.0, 0.0);
      const Eigen::Vector3d rest(0.0, 0.0, kGravity);
      const Answer answer = flight.pilot().hear(
          rate ? rest : absurd, rate ? absurd : Eigen::Vector3d::Zero(), flight.now());
      EXPECT_NE(answer.refusal, nullptr) << huge;
      flight.imu = false;  // it would be the last sample for long
      flight.fly(3.0);
      expectHolding(flight, 1.1);
    }
  }
}

// BUG 3
TEST_P(GuardedFlightTest, Bug3ATetherOnTheGroundEndsTheTakeOff) {
  GuardedFlight flight(GetParam());
  flight.fly(0.1);
  flight.plant().setDisturbance({{0.0, 0.0, -100.0}, Eigen::Vector3d::Zero()});
  EXPECT_EQ(flight.pilot().guard()->arm(), nullptr);
  EXPECT_EQ(flight.pilot().guard()->takeOff(), nullptr);
  flight.fly(10.0);
  EXPECT_EQ(flight.mode(), Mode::kDisarmed);
  EXPECT_EQ(flight.rule(), Rule::kNoLiftOff);
  flight.plant().setDisturbance({});
  flight.fly(2.0);
  expectLanded(flight);
}
TEST_P(GuardedFlightTest, Bug3ATetherThatGivesWayThrowsTheVehicleNoMetre) {
  GuardedFlight flight(GetParam());
  flight.fly(0.1);
  flight.plant().setDisturbance({{0.0, 0.0, -100.0}, Eigen::Vector3d::Zero()});
  flight.pilot().guard()->arm();
  flight.pilot().guard()->takeOff();
  flight.fly(3.0);
  flight.plant().setDisturbance({});
  flight.fly(8.0);
  EXPECT_LT(flight.highest(), 2.1);
  EXPECT_FALSE(flight.crashed());
}

// BUG 4
TEST_P(GuardedFlightTest, Bug4ASetPointFarAwayIsFlownSlowly) {
  GuardedFlight flight(GetParam());
  flight.takeOff();
  flight.go(100.0, 0.0, 1.5);
  flight.fly(40.0);
  EXPECT_NEAR(flight.plant().state().position.x(), 100.0, 0.5);
  EXPECT_NEAR(flight.height(), 1.5, 0.3);
  flight.go(100.0, 0.0, -5.0);
  flight.fly(5.0);
  EXPECT_FALSE(flight.crashed());
  EXPECT_LT(flight.impact(), 1.5);
}

// BUG 6
TEST_P(GuardedFlightTest, Bug6WithoutOdometryItDescendsByTheImu) {
  for (const bool moving : {false, true}) {
    GuardedFlight flight(GetParam());
    flight.takeOff();
    flight.go(moving ? 6.0 : 0.0, 0.0, 2.0);
    flight.fly(moving ? 1.5 : 5.0);
    flight.odometry = [](State&, Nanoseconds&, Nanoseconds&) { return false; };
    flight.fly(0.7);
    EXPECT_EQ(flight.mode(), Mode::kDescending);
    EXPECT_EQ(flight.rule(), Rule::kOdometryLost);
    flight.fly(12.0);
    expectLanded(flight);
  }
}
TEST_P(GuardedFlightTest, Bug6WithoutOdometryAndImuItDescendsByTheModel) {
  GuardedFlight flight(GetParam());
  flight.imu = false;
  flight.takeOff();
  flight.odometry = [](State&, Nanoseconds&, Nanoseconds&) { return false; };
  flight.fly(12.0);
  EXPECT_EQ(flight.mode(), Mode::kDisarmed);
  EXPECT_TRUE(flight.still());
  EXPECT_LT(flight.impact(), 1.5);
}
TEST_P(GuardedFlightTest, Bug6OdometryThatComesBackIsHeldWithoutAJump) {
  GuardedFlight flight(GetParam());
  flight.takeOff();
  flight.go(0.0, 0.0, 3.0);
  flight.fly(6.0);
  flight.odometry = [](State&, Nanoseconds&, Nanoseconds&) { return false; };
  flight.fly(1.5);
  flight.odometry = nullptr;
  const double height = flight.height();
  flight.fly(3.0);
  EXPECT_EQ(flight.rule(), Rule::kOdometryBack);
  expectHolding(flight, height);
}

// BUG 7
TEST_P(GuardedFlightTest, Bug7NothingTurnsUnasked) {
  GuardedFlight flight(GetParam());
  flight.go(0.0, 0.0, 1.5);
  flight.fly(2.0);
  EXPECT_EQ(flight.mode(), Mode::kDisarmed);
  EXPECT_TRUE(flight.still());
}
TEST_P(GuardedFlightTest, Bug7AfterATumbleTheRotorsStopAndStayStill) {
  GuardLimits limits;
  limits.auto_arm = true;
  GuardedFlight flight(GetParam(), limits);
  flight.go(0.0, 0.0, 1.5);
  flight.fly(8.0);
  EXPECT_NEAR(flight.height(), 1.5, 0.3);
  flight.plant().setDisturbance({Eigen::Vector3d::Zero(), {6.0, 0.0, 0.0}});
  flight.fly(0.4);
  flight.plant().setDisturbance({});
  flight.fly(2.0);
  flight.go(0.0, 0.0, 1.5);
  flight.fly(1.0);
  EXPECT_EQ(flight.mode(), Mode::kDisarmed);
  EXPECT_TRUE(flight.still());
}

// BUG 8
TEST_P(GuardedFlightTest, Bug8AControllerThatStartsInTheAirTakesOver) {
  GuardedFlight flight(GetParam(), GuardLimits(), 3.0);
  flight.pilot().guard()->wasArmed();
  flight.fly(5.0);
  EXPECT_EQ(flight.rule(), Rule::kAirborne);
  EXPECT_EQ(flight.mode(), Mode::kHolding);
  EXPECT_GT(flight.height(), 1.5);
  EXPECT_FALSE(flight.crashed());
}

// BUG 12
TEST_P(GuardedFlightTest, Bug12AHeadingThatFlipsIsNotBelieved) {
  GuardedFlight flight(GetParam());
  flight.takeOff();
  const Nanoseconds from = flight.now() + kSecond;
  flight.odometry = [&](State& state, Nanoseconds& stamp, Nanoseconds&) {
    if (stamp >= from) {
      state.attitude = Eigen::AngleAxisd(M_PI, Eigen::Vector3d::UnitZ()) * state.attitude;
    }
    return true;
  };
  flight.fly(12.0);
  expectLanded(flight);
}

// BUG 14
TEST_P(GuardedFlightTest, Bug14SetPointsHaveAnAge) {
  GuardLimits limits;
  limits.set_point_age = 1.0;
  GuardedFlight flight(GetParam(), limits);
  flight.takeOff();
  SetPoint place;
  place.position = {0.0, 0.0, 1.5};
  Pilot& pilot = flight.pilot();
  EXPECT_THROW(pilot.plan({{flight.now(), place}}, flight.now(), 1), std::invalid_argument);
  EXPECT_THROW(pilot.plan({{flight.now() + 3600 * kSecond, place}}, flight.now(), 0),
               std::invalid_argument);
  flight.go(4.0, 0.0, 1.5);
  flight.fly(0.5);
  EXPECT_EQ(flight.mode(), Mode::kFlying);
  flight.fly(7.0);
  EXPECT_EQ(flight.rule(), Rule::kSetPointOld);
  expectHolding(flight, 1.3);
}
TEST_P(GuardedFlightTest, Bug14ATrajectoryThatEndsInMotionBrakesToItsLastPoint) {
  GuardedFlight flight(GetParam());
  flight.takeOff();
  std::vector<TimedSetPoint> points;
  for (int i = 0; i <= 100; ++i) {
    TimedSetPoint timed;
    timed.time = flight.now() + i * 20'000'000;
    timed.set_point.position = {0.02 * i * 1.0, 0.0, 1.1};
    timed.set_point.velocity = {1.0, 0.0, 0.0};
    points.push_back(timed);
  }
  flight.pilot().plan(points, flight.now(), flight.now());
  flight.fly(8.0);
  EXPECT_NEAR(flight.plant().state().position.x(), 2.0, 0.1);
}

// Survived before, and still.
TEST_P(GuardedFlightTest, AnEstimateThatJumpsForEverMovesTheReference) {
  GuardedFlight flight(GetParam());
  flight.takeOff();
  const Nanoseconds from = flight.now() + kSecond;
  flight.odometry = [&](State& state, Nanoseconds& stamp, Nanoseconds&) {
    if (stamp >= from) state.position += Eigen::Vector3d(5.0, 0.0, 0.0);
    return true;
  };
  flight.fly(4.0);
  EXPECT_EQ(flight.rule(), Rule::kSourceReset);
  expectHolding(flight, 1.1);
  EXPECT_LT(std::abs(flight.plant().state().position.x()), 0.3) << "it does not fly there";
}
TEST_P(GuardedFlightTest, KillIsObeyedInTheAirAndLatched) {
  GuardedFlight flight(GetParam());
  flight.takeOff();
  flight.pilot().guard()->kill();
  flight.fly(0.1);
  EXPECT_TRUE(flight.still());
  EXPECT_NE(flight.pilot().guard()->arm(), nullptr);
  flight.fly(2.0);
  EXPECT_EQ(flight.mode(), Mode::kKilled);
}
TEST_P(GuardedFlightTest, AQuaternionNearlyOfNormOneIsNormalised) {
  GuardedFlight flight(GetParam());
  flight.takeOff();
  flight.odometry = [](State& state, Nanoseconds&, Nanoseconds&) {
    state.attitude.coeffs() *= 1.01;
    return true;
  };
  flight.fly(3.0);
  expectHolding(flight, 1.1);
  EXPECT_EQ(flight.pilot().droppedOdometry(), 0u);
}

INSTANTIATE_TEST_SUITE_P(Laws, GuardedFlightTest, ::testing::Values("asmc", "smc", "geometric"),
                         [](const auto& law) { return std::string(law.param); });

}  // namespace
}  // namespace aqc
