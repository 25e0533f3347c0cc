// Every rule of the guard's table alone: what it looks at, when it acts, what it does then.

#include "adaptive_quadrotor_control/pilot/guard.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "adaptive_quadrotor_control/math/constants.h"

namespace aqc {
namespace {

constexpr double kStep = 0.01;
constexpr double kMass = 1.0;
constexpr double kMaxThrust = 2.0 * kMass * kGravity;

// A vehicle that is wherever the test puts it, and hovers unless told otherwise.
class GuardTest : public ::testing::Test {
 protected:
  GuardTest() {
    given_.requested.thrust = given_.achieved.thrust = kMass * kGravity;
    now_.dt = kStep;
    now_.state = &state_;
    now_.given = &given_;
    now_.load = {kMass, 2.0 * kMass};
    now_.feels = true;
    now_.support = 0.0;
  }

  Decision step() { return guard_.step(now_); }
  // Steps until it is in that mode; how long that took, or infinity after 30 s.
  double until(Mode mode) {
    for (int i = 0; i < 3000; ++i) {
      if (guard_.mode() == mode) return i * kStep;
      step();
    }
    return std::numeric_limits<double>::infinity();
  }
  void stepFor(double seconds) {
    for (int i = 0; i < std::lround(seconds / kStep); ++i) step();
  }
  // Holds at 1 m above where it was armed, going where the reference goes.
  void takeOff() {
    step();
    ASSERT_EQ(guard_.arm(), nullptr);
    ASSERT_EQ(guard_.takeOff(), nullptr);
    for (int i = 0; i < 1000 && guard_.mode() != Mode::kHolding; ++i) follow(step());
    ASSERT_EQ(guard_.mode(), Mode::kHolding);
    ASSERT_EQ(guard_.rule(), Rule::kTakenOff);
    followFor(5.0);
  }
  void follow(const Decision& decision) {
    ASSERT_NE(decision.set_point, nullptr);
    state_.position = decision.set_point->position;
    state_.velocity = decision.set_point->velocity;
  }
  void followFor(double seconds) {
    for (int i = 0; i < std::lround(seconds / kStep); ++i) follow(step());
  }
  void plan(const Eigen::Vector3d& position) {
    planned_.position = position;
    now_.planned = &planned_;
    now_.plan_age = 0.0;
    guard_.heardPlan();
  }
  void tilt(double angle) {
    state_.attitude = Eigen::AngleAxisd(angle, Eigen::Vector3d(0.6, 0.8, 0.0));
  }
  void expectDisarmed(Rule rule) {
    EXPECT_EQ(guard_.mode(), Mode::kDisarmed);
    EXPECT_EQ(guard_.rule(), rule) << textOf(guard_.rule()).name;
    EXPECT_EQ(step().set_point, nullptr);
  }

  GuardLimits limits_;
  State state_;
  Allocation given_;
  SetPoint planned_;
  Situation now_;
  Guard guard_{limits_, kMaxThrust};
};

TEST_F(GuardTest, OperatorStandsInTheOrderOfTheModes) {
  EXPECT_STREQ(guard_.arm(), "there is no odometry");
  step();
  EXPECT_NE(guard_.takeOff(), nullptr);
  EXPECT_NE(guard_.land(), nullptr);
  EXPECT_NE(guard_.hold(), nullptr);
  EXPECT_EQ(guard_.arm(), nullptr);
  EXPECT_NE(guard_.arm(), nullptr);
  EXPECT_EQ(guard_.disarm(), nullptr);
  takeOff();
  EXPECT_NE(guard_.disarm(), nullptr);
  EXPECT_EQ(guard_.land(), nullptr);
  EXPECT_EQ(guard_.mode(), Mode::kLanding);
  EXPECT_EQ(guard_.hold(), nullptr);
  EXPECT_EQ(guard_.mode(), Mode::kHolding);
}

TEST_F(GuardTest, OperatorMayNotArmWhatMovesOrIsTilted) {
  state_.velocity.x() = 0.6;
  step();
  EXPECT_STREQ(guard_.arm(), "the vehicle moves");
  state_.velocity.setZero();
  tilt(limits_.tip_tilt + 0.01);
  step();
  EXPECT_STREQ(guard_.arm(), "the vehicle is tilted");
  tilt(limits_.tip_tilt - 0.01);
  step();
  EXPECT_EQ(guard_.arm(), nullptr);
}

TEST_F(GuardTest, OperatorMayNotArmALawThatIsUnfit) {
  step();
  guard_.judgeLaw("it is unfit");
  EXPECT_STREQ(guard_.arm(), "it is unfit");
  EXPECT_EQ(guard_.mode(), Mode::kDisarmed);
  guard_.judgeLaw(nullptr);
  EXPECT_EQ(guard_.arm(), nullptr);
}

TEST_F(GuardTest, ArmedRotorsIdleAndDisarmedOnesStand) {
  limits_.idle_speed = 120.0;
  guard_ = Guard(limits_, kMaxThrust);
  EXPECT_EQ(step().idle, 0.0);
  ASSERT_EQ(guard_.arm(), nullptr);
  EXPECT_EQ(step().idle, 120.0);
  EXPECT_EQ(step().set_point, nullptr);
}

TEST_F(GuardTest, AutoArmNeedsASetPointAboveAndOdometry) {
  limits_.auto_arm = true;
  guard_ = Guard(limits_, kMaxThrust);
  plan({0.0, 0.0, 0.04});
  step();
  EXPECT_EQ(guard_.mode(), Mode::kDisarmed) << "nothing asks for height";
  plan({0.0, 0.0, 1.5});
  now_.silence = limits_.odometry_late + kStep;
  step();
  EXPECT_EQ(guard_.mode(), Mode::kDisarmed) << "nobody knows where it is";
  now_.silence = 0.0;
  step();
  EXPECT_EQ(guard_.mode(), Mode::kTakingOff);
  EXPECT_EQ(guard_.rule(), Rule::kAutoArm);
}

TEST_F(GuardTest, AirborneIsWhoStartsAboveGroundAndWasArmed) {
  state_.position.z() = 3.0;
  state_.velocity.x() = 1.0;
  step();
  EXPECT_EQ(guard_.mode(), Mode::kDisarmed) << "nobody says that it was armed";
  guard_.wasArmed();
  const Decision decision = step();
  EXPECT_EQ(guard_.mode(), Mode::kHolding);
  EXPECT_EQ(guard_.rule(), Rule::kAirborne);
  ASSERT_NE(decision.set_point, nullptr);
  EXPECT_LT((decision.set_point->position - state_.position).norm(), 0.05);
  EXPECT_GT(decision.set_point->velocity.x(), 0.9) << "it is braked, not stopped";
}

TEST_F(GuardTest, AirborneIsNotWhoWasCarriedToTheGround) {
  guard_.wasArmed();
  state_.position.z() = 0.1;
  step();
  EXPECT_EQ(guard_.mode(), Mode::kDisarmed);
  state_.position.z() = 3.0;
  step();
  EXPECT_EQ(guard_.mode(), Mode::kDisarmed) << "it is asked once";
}

TEST_F(GuardTest, SetPointWakesAHoldAndItsAgeEndsIt) {
  limits_.set_point_age = 0.5;
  guard_ = Guard(limits_, kMaxThrust);
  takeOff();
  plan({1.0, 0.0, 1.0});
  followFor(0.1);
  EXPECT_EQ(guard_.mode(), Mode::kFlying);
  EXPECT_EQ(guard_.rule(), Rule::kSetPoint);
  now_.plan_age = 0.49;
  step();
  EXPECT_EQ(guard_.mode(), Mode::kFlying);
  now_.plan_age = 0.51;
  step();
  EXPECT_EQ(guard_.mode(), Mode::kHolding);
  EXPECT_EQ(guard_.rule(), Rule::kSetPointOld);
}

TEST_F(GuardTest, OdometryLateStopsLearningOdometryLostDescends) {
  takeOff();
  EXPECT_TRUE(step().learn);
  now_.feels = false;
  now_.silence = limits_.odometry_late;
  EXPECT_FALSE(step().learn);
  EXPECT_EQ(guard_.mode(), Mode::kHolding);
  EXPECT_EQ(guard_.rule(), Rule::kOdometryLate);
  now_.silence = limits_.odometry_lost;
  const Decision decision = step();
  EXPECT_EQ(guard_.mode(), Mode::kDescending);
  EXPECT_EQ(guard_.rule(), Rule::kOdometryLost);
  ASSERT_NE(decision.set_point, nullptr);
  followFor(1.0);
  EXPECT_NEAR(-guard_.step(now_).set_point->velocity.z(), limits_.descent_speed, 0.05);
}

TEST_F(GuardTest, OdometryLostOnTheGroundDisarms) {
  step();
  ASSERT_EQ(guard_.arm(), nullptr);
  now_.silence = limits_.odometry_lost;
  step();
  expectDisarmed(Rule::kOdometryLost);
}

TEST_F(GuardTest, OdometryBackHoldsWhereTheVehicleIs) {
  takeOff();
  now_.silence = limits_.odometry_lost;
  followFor(0.5);
  ASSERT_EQ(guard_.mode(), Mode::kDescending);
  now_.silence = 0.0;
  state_.position += Eigen::Vector3d(1.0, -1.0, 0.3);
  guard_.heardOdometry(state_);
  EXPECT_EQ(guard_.mode(), Mode::kHolding);
  EXPECT_EQ(guard_.rule(), Rule::kOdometryBack);
  EXPECT_LT((step().set_point->position - state_.position).norm(), 0.05);
}

TEST_F(GuardTest, SourceResetMovesTheReferenceWithTheEstimate) {
  takeOff();
  State said = state_;
  said.position += Eigen::Vector3d(3.0, 0.0, -0.2);
  const Eigen::Vector3d before = step().set_point->position;
  guard_.sourceReset(state_, said);
  state_ = said;
  EXPECT_EQ(guard_.rule(), Rule::kSourceReset);
  EXPECT_LT((step().set_point->position - before - Eigen::Vector3d(3.0, 0.0, -0.2)).norm(), 0.02);
}

TEST_F(GuardTest, SourceResetInALandingGoesOnLanding) {
  takeOff();
  ASSERT_EQ(guard_.land(), nullptr);
  followFor(0.5);
  State said = state_;
  said.position.z() += 2.0;
  guard_.sourceReset(state_, said);
  EXPECT_EQ(guard_.mode(), Mode::kLanding);
  EXPECT_EQ(guard_.rule(), Rule::kSourceReset);
}

TEST_F(GuardTest, ClockStepChangesNoDescent) {
  takeOff();
  now_.silence = limits_.odometry_lost;
  step();
  guard_.clockStepped();
  EXPECT_EQ(guard_.mode(), Mode::kDescending);
  EXPECT_EQ(guard_.rule(), Rule::kOdometryLost);
}

TEST_F(GuardTest, AHoldDoesNotTurnBack) {
  takeOff();
  plan({30.0, 0.0, 1.0});
  followFor(2.5);
  ASSERT_GT(state_.velocity.x(), 2.0);
  guard_.hold();
  for (int i = 0; i < 500; ++i) {
    follow(step());
    ASSERT_GT(state_.velocity.x(), -0.01);
  }
  EXPECT_LT(state_.velocity.norm(), 0.01);
}

TEST_F(GuardTest, TakenOffIsWhoIsCloseToTheTop) {
  step();
  guard_.arm();
  guard_.takeOff();
  state_.position.z() = limits_.take_off_height - 0.11;
  step();
  EXPECT_EQ(guard_.mode(), Mode::kTakingOff);
  state_.position.z() = limits_.take_off_height - 0.09;
  step();
  EXPECT_EQ(guard_.mode(), Mode::kHolding);
}

TEST_F(GuardTest, ClockStepEndsPlansInTheAirAndDisarmsOnTheGround) {
  step();
  ASSERT_EQ(guard_.arm(), nullptr);
  guard_.clockStepped();
  EXPECT_EQ(guard_.mode(), Mode::kDisarmed);
  takeOff();
  plan({1.0, 0.0, 1.0});
  followFor(0.1);
  guard_.clockStepped();
  EXPECT_EQ(guard_.mode(), Mode::kHolding);
  EXPECT_EQ(guard_.rule(), Rule::kClockStep);
}

TEST_F(GuardTest, NotFollowingForTheLagHolds) {
  takeOff();
  plan({30.0, 0.0, 1.0});
  const Eigen::Vector3d held = state_.position;
  step();
  EXPECT_EQ(guard_.goal().position.x(), 30.0) << "whatever the governor makes of it";
  EXPECT_EQ(guard_.mode(), Mode::kFlying);
  double time = 0.0;
  for (; guard_.rule() != Rule::kNotFollowing && time < 30.0; time += kStep) step();
  EXPECT_EQ(guard_.mode(), Mode::kHolding);
  EXPECT_GE(time, limits_.lag);
  EXPECT_LT(time, limits_.lag + 4.0);
  EXPECT_LT((step().set_point->position - held).norm(), 0.05) << "it holds where the vehicle is";
}

TEST_F(GuardTest, OverloadLands) {
  takeOff();
  now_.load.carried = 0.94 * 2.0 * kMass;
  stepFor(2.0 * limits_.overload_time);
  EXPECT_EQ(guard_.mode(), Mode::kHolding);
  now_.load.carried = 0.96 * 2.0 * kMass;
  EXPECT_NEAR(until(Mode::kLanding), limits_.overload_time, 2.0 * kStep);
  EXPECT_EQ(guard_.rule(), Rule::kOverload);
}

TEST_F(GuardTest, WhatTheMomentsTakeIsNotThereToLift) {
  takeOff();
  now_.load = {1.5 * kMass, 1.55 * kMass};
  EXPECT_NEAR(until(Mode::kLanding), limits_.overload_time, 2.0 * kStep);
  EXPECT_EQ(guard_.rule(), Rule::kOverload);
}

TEST_F(GuardTest, SaturationBelowTheSetPointLandsAndRestsTheEstimates) {
  takeOff();
  given_.requested.thrust = 1.1 * kMaxThrust;
  given_.saturated = true;
  state_.position.z() += 0.1;
  EXPECT_TRUE(step().learn) << "above it, too much thrust is what is to be unlearned";
  stepFor(2.0 * limits_.saturation_time);
  EXPECT_EQ(guard_.mode(), Mode::kHolding) << "it is above its set point";
  state_.position.z() -= 0.2;
  EXPECT_FALSE(step().learn);
  EXPECT_NEAR(until(Mode::kLanding), limits_.saturation_time, 2.0 * kStep);
  EXPECT_EQ(guard_.rule(), Rule::kSaturation);
}

TEST_F(GuardTest, LawNotFiniteForgetsAndLands) {
  takeOff();
  now_.law_finite = false;
  EXPECT_TRUE(step().forget);
  EXPECT_EQ(guard_.mode(), Mode::kLanding);
  EXPECT_EQ(guard_.rule(), Rule::kLawNotFinite);
}

TEST_F(GuardTest, RotorLossLands) {
  takeOff();
  now_.missing_rotors = limits_.rotor_loss - 0.01;
  stepFor(2.0 * limits_.rotor_loss_time);
  EXPECT_EQ(guard_.mode(), Mode::kHolding);
  now_.missing_rotors = limits_.rotor_loss + 0.01;
  stepFor(0.5 * limits_.rotor_loss_time);
  EXPECT_EQ(guard_.mode(), Mode::kHolding);
  EXPECT_NEAR(until(Mode::kLanding), 0.5 * limits_.rotor_loss_time, 2.0 * kStep);
  EXPECT_EQ(guard_.rule(), Rule::kRotorLoss);
}

TEST_F(GuardTest, MomentsOfTheGroundAreNoRotorLoss) {
  takeOff();
  now_.missing_rotors = 2.0 * limits_.rotor_loss;
  state_.position.z() = 0.25;
  stepFor(2.0 * limits_.rotor_loss_time);
  EXPECT_EQ(guard_.mode(), Mode::kHolding);
}

TEST_F(GuardTest, NoLiftOffDisarmsAndDoesNotTryAgainByItself) {
  limits_.auto_arm = true;
  guard_ = Guard(limits_, kMaxThrust);
  plan({0.0, 0.0, 1.0});
  step();
  ASSERT_EQ(guard_.mode(), Mode::kTakingOff);
  EXPECT_NEAR(until(Mode::kDisarmed), limits_.lift_off_time, 3.0 * kStep);
  expectDisarmed(Rule::kNoLiftOff);
  plan({0.0, 0.0, 1.0});
  stepFor(1.0);
  expectDisarmed(Rule::kNoLiftOff);
}

TEST_F(GuardTest, EstimatesRestOnTheGround) {
  EXPECT_FALSE(step().learn);
  ASSERT_EQ(guard_.arm(), nullptr);
  EXPECT_FALSE(step().learn);
  ASSERT_EQ(guard_.takeOff(), nullptr);
  EXPECT_TRUE(step().learn);
}

TEST_F(GuardTest, TouchDownNeedsStandingBelowNoMoreSinking) {
  takeOff();
  ASSERT_EQ(guard_.land(), nullptr);
  while (state_.position.z() > 0.0) follow(step());
  state_.position.z() = 0.0;
  state_.velocity.setZero();
  const double time = until(Mode::kDisarmed);
  EXPECT_GE(time, limits_.touch_down_time);
  EXPECT_LT(time, limits_.touch_down_time + 1.0);
  expectDisarmed(Rule::kTouchDown);
}

TEST_F(GuardTest, TippedOverCountsOnlyCloseToTheGround) {
  takeOff();
  tilt(limits_.tip_tilt + 0.1);
  stepFor(2.0 * limits_.tip_time);
  EXPECT_EQ(guard_.mode(), Mode::kHolding) << "1 m up it is how one flies";
  state_.position.z() = 0.2;
  EXPECT_NEAR(until(Mode::kDisarmed), limits_.tip_time, 2.0 * kStep);
  expectDisarmed(Rule::kTipped);
}

TEST_F(GuardTest, TippedOverBeforeLiftOffNeedsLess) {
  const double slope = 0.2;
  tilt(slope);
  step();
  ASSERT_EQ(guard_.arm(), nullptr);
  tilt(slope + limits_.tip_tilt / 3.0 + 0.01);
  stepFor(limits_.tip_time);
  EXPECT_EQ(guard_.mode(), Mode::kArmed) << "whoever lifts an idle vehicle may tilt it";
  tilt(slope);
  step();
  ASSERT_EQ(guard_.takeOff(), nullptr);
  tilt(slope + limits_.tip_tilt / 3.0 - 0.01);
  stepFor(limits_.tip_time);
  EXPECT_EQ(guard_.mode(), Mode::kTakingOff);
  tilt(slope + limits_.tip_tilt / 3.0 + 0.01);
  EXPECT_NEAR(until(Mode::kDisarmed), limits_.tip_time / 6.0, 2.0 * kStep);
  expectDisarmed(Rule::kTipped);
}

TEST_F(GuardTest, TakesOffFromTheSlopeOnWhichItWasPutAfterItWasArmed) {
  step();
  ASSERT_EQ(guard_.arm(), nullptr);
  tilt(limits_.tip_tilt / 3.0 + 0.05);
  step();
  ASSERT_EQ(guard_.takeOff(), nullptr);
  stepFor(limits_.tip_time);
  EXPECT_EQ(guard_.mode(), Mode::kTakingOff);
}

TEST_F(GuardTest, OdometryLostAtSpeedBrakesBeforeItSinks) {
  takeOff();
  now_.silence = limits_.odometry_lost;
  state_.velocity.x() = 2.0;
  const double height = step().set_point->position.z();
  ASSERT_EQ(guard_.mode(), Mode::kDescending);
  stepFor(1.4);
  EXPECT_NEAR(step().set_point->position.z(), height, 0.01);
  stepFor(0.6);
  EXPECT_LT(step().set_point->velocity.z(), -0.1) << "whatever the speed";
}

TEST_F(GuardTest, OdometryLostForLongSinksFaster) {
  takeOff();
  now_.silence = limits_.odometry_lost;
  const double way_down = state_.position.z() / limits_.descent_speed;
  followFor(way_down - 0.5);
  ASSERT_EQ(guard_.mode(), Mode::kDescending);
  EXPECT_NEAR(-guard_.goal().velocity.z(), limits_.descent_speed, 1e-9);
  followFor(1.5);
  EXPECT_NEAR(-guard_.goal().velocity.z(), limits_.descent_speed + 0.2, 0.02);
  followFor(3.0);
  EXPECT_EQ(guard_.mode(), Mode::kDescending);
  EXPECT_NEAR(-guard_.goal().velocity.z(), 2.0 * limits_.descent_speed, 1e-9);
}

TEST_F(GuardTest, TumbleDisarmsAtAnyHeight) {
  takeOff();
  tilt(limits_.tumble_tilt + 0.1);
  stepFor(0.5 * limits_.tumble_time);
  EXPECT_EQ(guard_.mode(), Mode::kHolding);
  stepFor(0.6 * limits_.tumble_time);
  expectDisarmed(Rule::kTumble);
}

TEST_F(GuardTest, BlindEndComesWhenItMustBeDown) {
  takeOff();
  now_.silence = limits_.odometry_lost;
  now_.feels = false;
  step();
  ASSERT_EQ(guard_.mode(), Mode::kDescending);
  const double way_down = state_.position.z() / limits_.descent_speed;
  const double time = until(Mode::kDisarmed);
  EXPECT_GT(time, way_down);
  EXPECT_LT(time, way_down + 5.0);
  expectDisarmed(Rule::kBlindEnd);
}

TEST_F(GuardTest, BlindEndWaitsForAnImuToFeelTheGround) {
  takeOff();
  now_.silence = limits_.odometry_lost;
  step();
  const double patience = 1.5 * (3.0 + state_.position.z() / limits_.descent_speed);
  EXPECT_NEAR(until(Mode::kDisarmed), patience, 0.1);
  expectDisarmed(Rule::kBlindEnd);
}

TEST_F(GuardTest, GroundFeltEndsABlindDescent) {
  takeOff();
  now_.silence = limits_.odometry_lost;
  step();
  now_.support = 0.5;
  EXPECT_NEAR(until(Mode::kDisarmed), limits_.touch_down_time, 2.0 * kStep);
  expectDisarmed(Rule::kTouchDown);
}

TEST_F(GuardTest, KilledIsForEver) {
  takeOff();
  guard_.kill();
  EXPECT_EQ(step().set_point, nullptr);
  EXPECT_NE(guard_.arm(), nullptr);
  guard_.heardOdometry(state_);
  guard_.clockStepped();
  guard_.sourceReset(state_, state_);
  plan({0.0, 0.0, 2.0});
  stepFor(1.0);
  EXPECT_EQ(guard_.mode(), Mode::kKilled);
}

}  // namespace
}  // namespace aqc
