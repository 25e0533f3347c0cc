#include "adaptive_quadrotor_control/pilot/odometry_gate.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace aqc {
namespace {

class OdometryGateTest : public ::testing::Test {
 protected:
  Doubt look(State state) const { return gate_.look(state, 0, 0); }
  Doubt compare(const State& state, double silence = 0.0) {
    return gate_.compare(state, innovationOf(state, State()), silence);
  }
  static State at(double x) {
    State state;
    state.position.x() = x;
    return state;
  }
  static State turned(double angle) {
    State state;
    state.attitude = Eigen::AngleAxisd(angle, Eigen::Vector3d(0.6, 0.0, 0.8));
    return state;
  }

  const GateLimits limits_;
  OdometryGate gate_{limits_};
};

TEST_F(OdometryGateTest, BelievesNumbersUpToTheLimitsInEveryComponent) {
  for (int i = 0; i < 3; ++i) {
    State state;
    state.position[i] = -limits_.position;
    state.velocity[i] = limits_.velocity;
    state.body_rate[i] = -limits_.body_rate;
    EXPECT_EQ(look(state), Doubt::kNone);
    for (Eigen::Vector3d State::*part : {&State::position, &State::velocity, &State::body_rate}) {
      State absurd = state;
      (absurd.*part)[i] *= 1.001;
      EXPECT_EQ(look(absurd), Doubt::kAbsurd);
      (absurd.*part)[i] = std::nan("");
      EXPECT_EQ(look(absurd), Doubt::kNotFinite);
      (absurd.*part)[i] = std::numeric_limits<double>::infinity();
      EXPECT_EQ(look(absurd), Doubt::kNotFinite);
    }
  }
}

TEST_F(OdometryGateTest, NormalisesAQuaternionThatIsNearlyOfNormOne) {
  for (const double norm : {0.951, 1.0, 1.049}) {
    State state = turned(0.3);
    state.attitude.coeffs() *= norm;
    EXPECT_EQ(gate_.look(state, 0, 0), Doubt::kNone);
    EXPECT_NEAR(state.attitude.norm(), 1.0, 1e-12);
    EXPECT_LT(state.attitude.angularDistance(turned(0.3).attitude), 1e-7);
  }
  for (const double norm : {0.0, 0.949, 1.051, 1e200}) {
    State state = turned(0.3);
    state.attitude.coeffs() *= norm;
    EXPECT_EQ(look(state), Doubt::kNoUnitQuaternion) << norm;
  }
  State state;
  state.attitude.x() = std::nan("");
  EXPECT_EQ(look(state), Doubt::kNotFinite);
}

TEST_F(OdometryGateTest, BelievesStampsALittleAheadOfNow) {
  State state;
  EXPECT_EQ(gate_.look(state, limits_.stamp_ahead, 0), Doubt::kNone);
  EXPECT_EQ(gate_.look(state, limits_.stamp_ahead + 1, 0), Doubt::kStampAhead);
}

TEST_F(OdometryGateTest, DoubtsJumpsBeyondTheLimits) {
  EXPECT_EQ(compare(at(0.99 * limits_.jump)), Doubt::kNone);
  EXPECT_EQ(compare(at(1.01 * limits_.jump)), Doubt::kPositionJump);
  State fast;
  fast.velocity.y() = 0.99 * limits_.speed_jump;
  EXPECT_EQ(compare(fast), Doubt::kNone);
  fast.velocity.y() = -1.01 * limits_.speed_jump;
  EXPECT_EQ(compare(fast), Doubt::kVelocityJump);
  for (const double sign : {-1.0, 1.0}) {
    State state = turned(sign * 0.99 * limits_.turn_jump);
    EXPECT_EQ(compare(state), Doubt::kNone);
    state = turned(sign * 1.01 * limits_.turn_jump);
    EXPECT_EQ(compare(state), Doubt::kTurnJump);
    state.attitude.coeffs() *= -1.0;
    EXPECT_EQ(compare(state), Doubt::kTurnJump);
  }
}

TEST_F(OdometryGateTest, ASilenceAllowsMore) {
  EXPECT_EQ(compare(at(2.0 * limits_.jump), 0.4), Doubt::kNone);
  EXPECT_EQ(compare(at(4.0 * limits_.jump), 0.4), Doubt::kPositionJump);
  EXPECT_EQ(compare(turned(1.4), 1.0), Doubt::kNone);
  EXPECT_EQ(compare(turned(1.6), 100.0), Doubt::kTurnJump) << "no vehicle is half a turn off";
}

TEST_F(OdometryGateTest, JumpsInARowThatAgreeAreAReset) {
  for (int i = 1; i < limits_.confirmations; ++i) {
    EXPECT_EQ(compare(at(5.0 + 0.01 * i)), Doubt::kPositionJump) << i;
  }
  EXPECT_EQ(compare(at(5.3)), Doubt::kNone);
  EXPECT_TRUE(gate_.sourceReset());
  EXPECT_EQ(compare(at(5.3)), Doubt::kPositionJump) << "it is told once";
  EXPECT_FALSE(gate_.sourceReset());
}

TEST_F(OdometryGateTest, WhatBreaksARowOfJumps) {
  for (const State& between : {at(0.0), turned(2.0), at(9.0)}) {
    gate_.forget();
    for (int i = 1; i < limits_.confirmations; ++i) compare(at(5.0));
    compare(between);
    for (int i = 1; i < limits_.confirmations; ++i) {
      EXPECT_EQ(compare(at(5.0)), Doubt::kPositionJump) << i;
    }
  }
}

TEST_F(OdometryGateTest, ATurnIsNeverAReset) {
  for (int i = 0; i < 3 * limits_.confirmations; ++i) {
    EXPECT_EQ(compare(turned(1.0)), Doubt::kTurnJump);
  }
}

TEST_F(OdometryGateTest, TheFirstAfterASilenceMayHaveFrozen) {
  EXPECT_TRUE(gate_.first(at(1.0)));
  EXPECT_TRUE(gate_.first(at(1.0)));
  EXPECT_FALSE(gate_.first(at(1.1)));
  gate_.believed();
  EXPECT_TRUE(gate_.first(at(1.2)));
}

TEST_F(OdometryGateTest, ARiseThatDeadReckoningCannotHaveMissedIsTheGrounds) {
  State higher;
  for (const double rise : {0.6, -0.6}) {
    higher.position.z() = rise;
    EXPECT_EQ(gate_.unfeltRise(innovationOf(higher, State()), 0.5), rise);
    EXPECT_EQ(gate_.unfeltRise(innovationOf(higher, State()), 1.0), 0.0);
  }
}

}  // namespace
}  // namespace aqc
