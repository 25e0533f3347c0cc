#include "adaptive_quadrotor_control/pilot/step_clock.h"

#include <gtest/gtest.h>

#include <stdexcept>

#include "support/heap_counter.h"

namespace aqc {
namespace {

using Answer = StepClock::Answer;

constexpr Nanoseconds kPeriod = 4'000'000;
constexpr Nanoseconds kStart = 1'000'000'000;  // clocks need not begin at 0
constexpr double kSeconds = 0.004;             // the period

StepClock triggeredByOdometry() {
  return StepClock(kPeriod, StepClock::Trigger::kOdometry);
}

StepClock triggeredByTimer() {
  return StepClock(kPeriod, StepClock::Trigger::kTimer);
}

/// Triggered by odometry, with the first step made at kStart.
StepClock afterOneStep(bool flying) {
  StepClock clock = triggeredByOdometry();
  clock.hear(kStart, false);
  clock.begin(kStart, flying);
  return clock;
}

TEST(StepClock, RefusesPeriodsThatAreNone) {
  EXPECT_THROW(StepClock(0, StepClock::Trigger::kTimer), std::invalid_argument);
  EXPECT_THROW(StepClock(-1, StepClock::Trigger::kOdometry), std::invalid_argument);
  EXPECT_EQ(triggeredByTimer().period(), kPeriod);
  EXPECT_EQ(triggeredByTimer().trigger(), StepClock::Trigger::kTimer);
}

TEST(StepClock, TheFirstOdometryMakesAStepOfOnePeriod) {
  StepClock clock = triggeredByOdometry();
  EXPECT_EQ(clock.odometryTime(), 0);
  EXPECT_EQ(clock.hear(kStart, false), Answer::kStep);
  EXPECT_EQ(clock.odometryTime(), kStart);
  EXPECT_EQ(clock.begin(kStart, true), kSeconds);
}

TEST(StepClock, OdometryThatIsDueMakesAStep) {
  StepClock clock = afterOneStep(true);
  for (int i = 1; i <= 3; ++i) {
    const Nanoseconds now = kStart + i * kPeriod;
    EXPECT_EQ(clock.hear(now, false), Answer::kStep) << i;
    EXPECT_EQ(clock.begin(now, true), kSeconds) << i;
  }
}

TEST(StepClock, TheSameStampAgainIsAnsweredWithTheSameCommand) {
  StepClock clock = afterOneStep(true);
  EXPECT_EQ(clock.hear(kStart, false), Answer::kRepeat);
  EXPECT_EQ(clock.hear(kStart, true), Answer::kRepeat) << "the IMU has nothing to add";
  EXPECT_EQ(clock.hear(kStart + kPeriod, false), Answer::kStep);
}

TEST(StepClock, TheSameStampAgainMakesAStepWhileNothingFlies) {
  StepClock clock = afterOneStep(false);
  EXPECT_EQ(clock.hear(kStart, false), Answer::kStep);
  EXPECT_EQ(clock.begin(kStart, true), kSeconds) << "no step is shorter than a period";
  EXPECT_EQ(clock.hear(kStart, false), Answer::kRepeat) << "it flies now";
}

TEST(StepClock, EarlyOdometryIsAnsweredWithTheLastCommand) {
  for (const bool flying : {false, true}) {
    StepClock clock = afterOneStep(flying);
    EXPECT_EQ(clock.hear(kStart + 1, false), Answer::kRepeat);
    EXPECT_EQ(clock.hear(kStart + kPeriod - 1, true), Answer::kRepeat);
    EXPECT_EQ(clock.odometryTime(), kStart + kPeriod - 1) << "it is the latest all the same";
    EXPECT_EQ(clock.hear(kStart + kPeriod, false), Answer::kStep);
  }
}

TEST(StepClock, OdometryThatIsLateMakesAStepOfAtMostTwoPeriods) {
  StepClock clock = afterOneStep(true);
  Nanoseconds now = kStart + kPeriod + kPeriod / 2;
  EXPECT_EQ(clock.hear(now, false), Answer::kStep);
  EXPECT_EQ(clock.begin(now, true), 1.5 * kSeconds);
  now += 1000 * kPeriod;
  EXPECT_EQ(clock.hear(now, false), Answer::kStep);
  EXPECT_EQ(clock.begin(now, true), 2.0 * kSeconds);
}

TEST(StepClock, StampsThatGoBackAreDropped) {
  for (StepClock clock : {triggeredByOdometry(), triggeredByTimer()}) {
    EXPECT_NE(clock.hear(kStart, false), Answer::kDrop);
    clock.begin(kStart, true);
    EXPECT_EQ(clock.hear(kStart - 1, false), Answer::kDrop);
    EXPECT_EQ(clock.hear(kStart - kNewStart, true), Answer::kDrop);
    EXPECT_EQ(clock.odometryTime(), kStart);
    EXPECT_FALSE(clock.waiting());
    EXPECT_NE(clock.hear(kStart + kPeriod, false), Answer::kDrop);
  }
}

// The last answer to as many odometry of a new time as confirm it.
Answer hearOfANewStart(StepClock& clock, Nanoseconds stamp) {
  for (int i = 1; i < ClockLimits().confirmations; ++i) {
    EXPECT_EQ(clock.hear(stamp, true), Answer::kDrop) << i;
  }
  return clock.hear(stamp, true);
}

TEST(StepClock, AFewStampsOfAnotherTimeDoNotEndAFlight) {
  for (StepClock clock : {triggeredByOdometry(), triggeredByTimer()}) {
    Nanoseconds now = 17 * kStart;
    clock.hear(now, false);
    clock.begin(now, true);
    for (int i = 0; i < 3 * ClockLimits().confirmations; ++i) {  // a second source
      EXPECT_EQ(clock.hear(i * kPeriod, false), Answer::kDrop);
      now += kPeriod;
      EXPECT_NE(clock.hear(now, false), Answer::kDrop);
    }
    for (int i = 3 * ClockLimits().confirmations; i > 0; --i) {  // no clock at all
      EXPECT_EQ(clock.hear(i, false), Answer::kDrop);
    }
    EXPECT_EQ(clock.odometryTime(), now);
  }
}

TEST(StepClock, StampsThatGoBackFarAreANewStart) {
  const Nanoseconds again = 17 * kStart - kNewStart - 1;
  for (StepClock clock : {triggeredByOdometry(), triggeredByTimer()}) {
    const bool by_timer = clock.trigger() == StepClock::Trigger::kTimer;
    clock.hear(17 * kStart, false);
    clock.begin(17 * kStart, true);
    EXPECT_EQ(hearOfANewStart(clock, again), Answer::kRestart);
    EXPECT_FALSE(clock.waiting());
    EXPECT_EQ(clock.odometryTime(), 0) << "nothing has been heard yet";
    EXPECT_EQ(clock.hear(again, false), by_timer ? Answer::kNone : Answer::kStep);
    EXPECT_EQ(clock.odometryTime(), again);
    EXPECT_EQ(clock.begin(again, false), kSeconds) << "one period, as after the first odometry";
    EXPECT_EQ(clock.hear(again - 1, false), Answer::kDrop);
    EXPECT_EQ(clock.hear(again + kPeriod, false), by_timer ? Answer::kNone : Answer::kStep);
    EXPECT_EQ(clock.period(), kPeriod);
  }
}

TEST(StepClock, ANewStartEndsTheWaitingForTheImu) {
  StepClock clock = triggeredByOdometry();
  EXPECT_EQ(clock.hear(17 * kStart, true), Answer::kWait);
  EXPECT_EQ(hearOfANewStart(clock, kStart), Answer::kRestart);
  EXPECT_FALSE(clock.waiting());
  EXPECT_EQ(clock.hear(kStart, true), Answer::kWait);
}

TEST(StepClock, StampsMayBeZeroOrNegative) {
  StepClock clock = triggeredByOdometry();
  EXPECT_EQ(clock.hear(-kPeriod, false), Answer::kStep);
  EXPECT_EQ(clock.begin(-kPeriod, true), kSeconds);
  EXPECT_EQ(clock.hear(0, false), Answer::kStep);
  EXPECT_EQ(clock.begin(0, true), kSeconds);
  EXPECT_EQ(clock.hear(0, false), Answer::kRepeat);
  EXPECT_EQ(clock.hear(-1, false), Answer::kDrop);
}

TEST(StepClock, WaitsForTheImuSampleOfTheSameTime) {
  StepClock clock = afterOneStep(true);
  const Nanoseconds now = kStart + kPeriod;
  EXPECT_FALSE(clock.waiting());
  EXPECT_EQ(clock.hear(now, true), Answer::kWait);
  EXPECT_TRUE(clock.waiting());
  EXPECT_EQ(clock.odometryTime(), now) << "which sample it waits for";
  EXPECT_EQ(clock.begin(now, true), kSeconds) << "the sample has come";
  EXPECT_FALSE(clock.waiting());
  EXPECT_EQ(clock.hear(now, true), Answer::kRepeat);
  EXPECT_EQ(clock.hear(now + kPeriod, true), Answer::kWait);
}

TEST(StepClock, OdometryThatComesAgainWaitsNoLonger) {
  StepClock same = afterOneStep(true);
  EXPECT_EQ(same.hear(kStart + kPeriod, true), Answer::kWait);
  EXPECT_EQ(same.hear(kStart + kPeriod, true), Answer::kStep);
  EXPECT_FALSE(same.waiting());

  StepClock next = afterOneStep(true);
  EXPECT_EQ(next.hear(kStart + kPeriod, true), Answer::kWait);
  EXPECT_EQ(next.hear(kStart + 2 * kPeriod, true), Answer::kStep);
  EXPECT_EQ(next.begin(kStart + 2 * kPeriod, true), 2.0 * kSeconds);

  StepClock arrived = afterOneStep(true);
  EXPECT_EQ(arrived.hear(kStart + kPeriod, true), Answer::kWait);
  EXPECT_EQ(arrived.hear(kStart + kPeriod + 1, false), Answer::kStep) << "its sample is there";
  EXPECT_FALSE(arrived.waiting());
}

TEST(StepClock, TheTimerMakesStepsOfOnePeriodWheneverItFires) {
  StepClock clock = triggeredByTimer();
  EXPECT_EQ(clock.hear(kStart, true), Answer::kNone);
  EXPECT_FALSE(clock.waiting()) << "the timer waits for nobody";
  for (const Nanoseconds now : {kStart, kStart + 1, kStart + 10 * kPeriod}) {
    EXPECT_EQ(clock.begin(now, true), kSeconds);
  }
  EXPECT_EQ(clock.hear(kStart + 11 * kPeriod, false), Answer::kNone);
}

TEST(StepClock, WithATimerRepeatedOdometryMakesAStepOnlyWhileNothingFlies) {
  StepClock clock = triggeredByTimer();
  EXPECT_EQ(clock.hear(kStart, false), Answer::kNone);
  EXPECT_EQ(clock.hear(kStart, false), Answer::kStep) << "the simulated clock stands still";
  EXPECT_EQ(clock.begin(kStart, true), kSeconds);
  EXPECT_EQ(clock.hear(kStart, false), Answer::kNone);
  clock.begin(kStart, false);
  EXPECT_EQ(clock.hear(kStart, false), Answer::kStep);
}

TEST(StepClock, AllocatesNothing) {
  if (!test::canCountHeap()) GTEST_SKIP() << "the allocator cannot be watched here";
  const test::HeapCounter counter;
  StepClock clock = triggeredByOdometry();
  for (Nanoseconds now = kStart; now < kStart + 100 * kPeriod; now += kPeriod / 2) {
    if (clock.hear(now, now % 3 == 0) == Answer::kStep) clock.begin(now, true);
  }
  EXPECT_EQ(counter.count(), 0u);
}

}  // namespace
}  // namespace aqc
