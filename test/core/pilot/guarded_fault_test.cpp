// The ways to lose a guarded vehicle that random fault flights found.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "adaptive_quadrotor_control/math/rotations.h"
#include "adaptive_quadrotor_control/simulation/random.h"
#include "support/guarded_flight.h"

namespace aqc {
namespace {

using test::expectLanded;
using test::GuardedFlight;

bool nothing(State& /*state*/, Nanoseconds& /*stamp*/, Nanoseconds& /*now*/) {
  return false;
}

// Fast and low, when `something` makes it come down.
void expectToBrakeFirst(const std::function<void(GuardedFlight& flight)>& something) {
  GuardedFlight flight;
  flight.takeOff();
  flight.go(30.0, 0.0, 0.0);
  flight.fly(5.0);
  EXPECT_GT(flight.speed(), 2.0);
  something(flight);
  while (!flight.plant().touching()) flight.fly(0.02);
  EXPECT_LT(flight.plant().state().velocity.head<2>().norm(), 1.0);
  flight.fly(4.0);
  expectLanded(flight);
}

TEST(GuardedFault, AnOrderToLandBrakesFirst) {
  expectToBrakeFirst(
      [](GuardedFlight& flight) { EXPECT_EQ(flight.pilot().guard()->land(), nullptr); });
}

TEST(GuardedFault, ADescentWithoutOdometryBrakesFirst) {
  expectToBrakeFirst([](GuardedFlight& flight) { flight.odometry = nothing; });
}

TEST(GuardedFault, OdometryThatComesBackCloseToTheGroundFindsALanding) {
  GuardedFlight flight;
  flight.takeOff();
  flight.odometry = nothing;
  while (flight.height() > 0.2) flight.fly(0.1);
  flight.odometry = nullptr;
  flight.fly(4.0);
  expectLanded(flight);
}

TEST(GuardedFault, ALandingGoesOnAfterAGap) {
  GuardedFlight flight;
  flight.takeOff();
  flight.go(0.0, 0.0, 3.0);
  flight.fly(6.0);
  flight.pilot().guard()->land();
  flight.odometry = nothing;
  flight.fly(1.0);
  flight.odometry = nullptr;
  flight.fly(0.1);
  EXPECT_EQ(flight.mode(), Mode::kLanding);
  EXPECT_EQ(flight.rule(), Rule::kOdometryBack);
}

TEST(GuardedFault, OdometryThatFreezesIsNotBelieved) {
  for (const bool taking_off : {false, true}) {
    GuardedFlight flight;
    if (taking_off) {
      flight.fly(0.1);
      flight.pilot().guard()->arm();
      flight.pilot().guard()->takeOff();
      flight.fly(0.5);
    } else {
      flight.takeOff();
      flight.go(6.0, 0.0, 2.0);
      flight.fly(1.5);
    }
    const State frozen = flight.plant().state();
    flight.odometry = [&](State& state, Nanoseconds&, Nanoseconds&) {
      state = frozen;
      return true;
    };
    flight.fly(14.0);
    expectLanded(flight);
    EXPECT_LT(flight.highest(), 2.5);
  }
}

// The first message after a silence is news, whatever it says; the next one is not.
TEST(GuardedFault, OdometryThatFrozeInASilenceIsNotBelieved) {
  GuardedFlight flight;
  flight.takeOff();
  flight.go(0.0, 0.0, 4.0);
  flight.fly(1.2);
  const State frozen = flight.plant().state();
  EXPECT_GT(frozen.velocity.z(), 1.0);
  flight.odometry = nothing;
  flight.fly(1.0);
  flight.odometry = [&](State& state, Nanoseconds&, Nanoseconds&) {
    state = frozen;
    return true;
  };
  flight.fly(1.0);
  EXPECT_EQ(flight.mode(), Mode::kDescending);
  EXPECT_NEAR(flight.plant().state().velocity.z(), -0.5, 0.15);
}

// Pushed, with odometry that is up to 96 ms old.
TEST(GuardedFault, AnAttitudeThatIsOldGivesWayToTheImu) {
  GuardedFlight flight;
  flight.takeOff();
  flight.go(0.0, 0.0, 3.0);
  flight.fly(4.0);
  int count = 0;
  flight.odometry = [&](State&, Nanoseconds&, Nanoseconds&) { return ++count % 24 == 0; };
  double up = 1.0;
  for (int i = 0; i < 60; ++i) {
    const bool pushed = i % 20 < 2;
    flight.plant().setDisturbance({Eigen::Vector3d::Zero(), {pushed ? 0.3 : 0.0, 0.0, 0.0}});
    flight.fly(0.1);
    up = std::min(up, (flight.plant().state().attitude * Eigen::Vector3d::UnitZ()).z());
  }
  EXPECT_GT(up, 0.7);
  EXPECT_NE(flight.mode(), Mode::kDisarmed);
}

TEST(GuardedFault, NoiseHidesNoTouchDown) {
  GuardedFlight flight;
  flight.takeOff();
  Random random(1);
  flight.odometry = [&](State& state, Nanoseconds&, Nanoseconds&) {
    state.position += 0.02 * random.normal3();
    state.velocity += 0.1 * random.normal3();
    return true;
  };
  flight.pilot().guard()->land();
  flight.fly(8.0);
  expectLanded(flight);
}

TEST(GuardedFault, BrakingAClimbIsNoTouchDown) {
  GuardedFlight flight;
  flight.takeOff();
  flight.go(0.0, 0.0, 4.0);
  flight.fly(0.8);
  flight.odometry = nothing;
  flight.fly(1.5);
  EXPECT_EQ(flight.mode(), Mode::kDescending);
  flight.fly(14.0);
  expectLanded(flight);
}

bool fiveMetresHigher(State& state, Nanoseconds&, Nanoseconds&) {
  state.position.z() += 5.0;
  return true;
}

// On the way to a place that is below the ground by the heights of before.
void expectToStayAboveTheGround(GuardedFlight& flight) {
  flight.go(2.0, 0.0, 1.0);
  flight.fly(8.0);
  EXPECT_GT(flight.height(), 0.2);
  EXPECT_FALSE(flight.plant().touching());
}

TEST(GuardedFault, TheGroundMovesWithASourceThatWasReset) {
  GuardedFlight flight;
  flight.takeOff();
  flight.odometry = fiveMetresHigher;
  flight.fly(1.0);
  EXPECT_EQ(flight.rule(), Rule::kSourceReset);
  expectToStayAboveTheGround(flight);
}

TEST(GuardedFault, TheGroundMovesWithHeightsThatJumpInASilence) {
  GuardedFlight flight;
  flight.takeOff();
  flight.odometry = nothing;
  flight.fly(0.8);
  flight.odometry = fiveMetresHigher;
  flight.fly(0.1);
  EXPECT_EQ(flight.rule(), Rule::kOdometryBack);
  expectToStayAboveTheGround(flight);
}

TEST(GuardedFault, ASourceThatIsResetOnTheGroundMovesTheTakeOff) {
  GuardedFlight flight;
  flight.fly(0.1);
  flight.odometry = [&](State& state, Nanoseconds&, Nanoseconds&) {
    if (flight.mode() != Mode::kDisarmed) state.position += Eigen::Vector3d(3.0, 0.0, 2.0);
    return true;
  };
  flight.pilot().guard()->arm();
  flight.pilot().guard()->takeOff();
  flight.fly(6.0);
  EXPECT_NEAR(flight.height(), 1.1, 0.2);
  EXPECT_NEAR(flight.plant().state().position.x(), 0.0, 0.3);
}

TEST(GuardedFault, WhatPushesAsideKeepsNobodyFromLanding) {
  GuardedFlight flight;
  flight.takeOff();
  flight.plant().setDisturbance({{4.0, 0.0, 0.0}, Eigen::Vector3d::Zero()});
  flight.fly(4.0);
  flight.pilot().guard()->land();
  flight.fly(8.0);
  expectLanded(flight);
}

TEST(GuardedFault, ALoadThatIsLostWithoutOdometryIsUnlearned) {
  GuardedFlight flight;
  flight.takeOff();
  flight.plant().setDisturbance({{0.0, 0.0, -15.0}, Eigen::Vector3d::Zero()});
  flight.fly(5.0);
  flight.odometry = nothing;
  flight.fly(0.3);
  flight.plant().setDisturbance({});
  flight.fly(14.0);
  expectLanded(flight);
}

// Without an IMU the thrust that has held it up lately is all that tells what it carries.
TEST(GuardedFault, WithoutOdometryAndImuALoadIsCarriedDown) {
  GuardedFlight flight;
  flight.imu = false;
  flight.takeOff();
  flight.plant().setDisturbance({{0.0, 0.0, -8.0}, Eigen::Vector3d::Zero()});
  flight.fly(6.0);
  flight.odometry = nothing;
  flight.fly(0.6);
  EXPECT_EQ(flight.mode(), Mode::kDescending);
  flight.fly(10.0);
  expectLanded(flight);
}

TEST(GuardedFault, AStreamOfSetPointsMovesBetweenThem) {
  GuardedFlight flight;
  flight.takeOff();
  SetPoint point;
  point.velocity.x() = 1.0;
  for (int i = 0; i < 40; ++i) {
    point.position = {0.05 * i, 0.0, 1.1};
    flight.pilot().plan({{flight.now(), point}}, flight.now(), flight.now());
    flight.fly(0.05);
  }
  EXPECT_EQ(flight.pilot().goal().velocity.x(), 1.0);
  flight.fly(0.4);
  EXPECT_EQ(flight.pilot().goal().velocity.x(), 1.0) << "the next one may be late";
  flight.fly(0.2);
  EXPECT_EQ(flight.pilot().goal().velocity.x(), 0.0) << "it has ended";
}

TEST(GuardedFault, ABiasIsLearnedBeforeItIsNeeded) {
  GuardedFlight flight;
  flight.force_bias = {0.2, -0.1, 0.2};
  flight.rate_bias = {0.02, 0.01, -0.02};
  flight.takeOff();
  flight.go(0.0, 0.0, 4.0);
  flight.fly(12.0);
  flight.odometry = nothing;
  flight.fly(14.0);
  expectLanded(flight);
  EXPECT_LT(flight.plant().state().position.head<2>().norm(), 2.0);
}

TEST(GuardedFault, NobodyFliesAlongTheGround) {
  GuardedFlight flight;
  flight.takeOff();
  flight.go(30.0, 0.0, 0.0);
  flight.fly(3.0);
  for (int i = 0; i < 80; ++i) {
    flight.fly(0.1);
    EXPECT_FALSE(flight.plant().touching());
  }
  EXPECT_EQ(flight.mode(), Mode::kFlying);
}

TEST(GuardedFault, AnImuSampleRefusedForItsStampIsNotFelt) {
  GuardedFlight flight;
  flight.takeOff();
  int refused = 0;
  flight.odometry = [&](State&, Nanoseconds&, Nanoseconds& now) {
    const Answer answer = flight.pilot().hear(Eigen::Vector3d(0.0, 0.0, 150.0),
                                              Eigen::Vector3d(5.0, 0.0, 0.0), now - 500'000'000);
    if (answer.refusal != nullptr) ++refused;
    return true;
  };
  flight.fly(4.0);
  EXPECT_EQ(refused, 1000);
  EXPECT_EQ(flight.pilot().droppedOdometry(), 0u) << "nobody doubts it for what was refused";
  EXPECT_EQ(flight.mode(), Mode::kHolding);
  EXPECT_NEAR(flight.height(), 1.1, 0.1);
}

// Less than a new start of the clock: odometry is late until it has caught up, and all that tells
// the attitude of a turning vehicle is the IMU, whose stamps went back, too.
TEST(GuardedFault, AnImuWhoseClockIsSetBackIsFeltAllTheSame) {
  GuardedFlight flight;
  flight.takeOff();
  flight.go(6.0, 0.0, 3.0);
  flight.fly(0.6);
  flight.imu_offset = -925'000'000;
  flight.odometry = [](State&, Nanoseconds& stamp, Nanoseconds&) {
    stamp -= 925'000'000;
    return true;
  };
  flight.plant().setDisturbance({{}, {0.3, 0.0, 0.0}});
  flight.fly(0.2);
  flight.plant().setDisturbance({});
  double up = 1.0;
  for (int i = 0; i < 50; ++i) {
    flight.fly(0.1);
    up = std::min(up, uprightness(flight.plant().state().attitude));
  }
  EXPECT_GT(up, 0.8);
  EXPECT_EQ(flight.pilot().imu().dropped(), ImuMonitor::kConfirmations - 1);
  EXPECT_EQ(flight.mode(), Mode::kHolding);
  EXPECT_LT(flight.speed(), 0.2);
}

// It feels less than there is, believes to fall, and climbs in truth.
TEST(GuardedFault, ABiasThatIsNotKnownMakesNoDescentAClimb) {
  GuardedFlight flight;
  flight.takeOff();
  flight.odometry = nothing;
  flight.force_bias.z() = -0.12;
  flight.fly(14.0);
  expectLanded(flight);
}

}  // namespace
}  // namespace aqc
