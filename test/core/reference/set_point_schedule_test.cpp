#include "adaptive_quadrotor_control/reference/set_point_schedule.h"

#include <gtest/gtest.h>

#include <limits>
#include <stdexcept>
#include <string>

#include "support/refusal.h"

namespace aqc {
namespace {

TimedSetPoint at(Nanoseconds time, double x) {
  TimedSetPoint timed;
  timed.time = time;
  timed.set_point.position.x() = x;
  return timed;
}

double xAt(SetPointSchedule& schedule, Nanoseconds now) {
  const SetPoint* set_point = schedule.at(now);
  return set_point == nullptr ? -1.0 : set_point->position.x();
}

TEST(SetPointSchedule, HoldsEachFromItsTimeUntilTheNext) {
  SetPointSchedule schedule({at(10, 1.0), at(20, 2.0)});
  EXPECT_EQ(schedule.at(9), nullptr);
  EXPECT_EQ(schedule.pending(), 2u);
  EXPECT_EQ(xAt(schedule, 10), 1.0);
  EXPECT_EQ(xAt(schedule, 19), 1.0);
  EXPECT_EQ(schedule.pending(), 1u);
  EXPECT_EQ(xAt(schedule, 20), 2.0);
  EXPECT_EQ(xAt(schedule, std::numeric_limits<Nanoseconds>::max()), 2.0);
  EXPECT_EQ(schedule.pending(), 0u);
}

TEST(SetPointSchedule, OfSeveralAtOneTimeTheLastHolds) {
  SetPointSchedule schedule({at(10, 1.0), at(10, 2.0), at(10, 3.0)});
  EXPECT_EQ(xAt(schedule, 10), 3.0);
}

TEST(SetPointSchedule, SkipsThoseThatNobodyAskedForInTime) {
  SetPointSchedule schedule({at(10, 1.0), at(20, 2.0), at(30, 3.0)});
  EXPECT_EQ(xAt(schedule, 35), 3.0);
}

TEST(SetPointSchedule, IsNullWhenEmpty) {
  SetPointSchedule schedule;
  EXPECT_EQ(schedule.at(100), nullptr);
  EXPECT_EQ(schedule.pending(), 0u);
}

TEST(SetPointSchedule, RefusesTimesThatGoBack) {
  const std::string message = test::refusal([] {
    SetPointSchedule({at(1'000'000'000, 1.0), at(500'000'000, 2.0)});
  });
  EXPECT_NE(message.find("set point 1"), std::string::npos) << message;
  EXPECT_NE(message.find("0.5"), std::string::npos) << message;
  EXPECT_NE(message.find("must not decrease"), std::string::npos) << message;
}

TEST(SetPointSchedule, KeepsWhatHoldsUntilTheNewPlanBegins) {
  SetPointSchedule schedule({at(10, 1.0), at(20, 2.0), at(30, 3.0)});
  EXPECT_EQ(xAt(schedule, 15), 1.0);
  schedule.replace(15, {at(40, 7.0)});
  EXPECT_EQ(xAt(schedule, 16), 1.0);
  EXPECT_EQ(xAt(schedule, 39), 1.0) << "the old plan is gone";
  EXPECT_EQ(xAt(schedule, 40), 7.0);
}

TEST(SetPointSchedule, ANewPlanThatIsOverdueTakesOverAtOnce) {
  SetPointSchedule schedule({at(10, 1.0)});
  EXPECT_EQ(xAt(schedule, 15), 1.0);
  schedule.replace(15, {at(12, 7.0), at(14, 8.0), at(20, 9.0)});
  EXPECT_EQ(xAt(schedule, 15), 8.0);
  EXPECT_EQ(xAt(schedule, 20), 9.0);
}

TEST(SetPointSchedule, ReplacingByNothingHoldsForEver) {
  SetPointSchedule schedule({at(10, 1.0), at(20, 2.0)});
  EXPECT_EQ(xAt(schedule, 15), 1.0);
  schedule.replace(15, {});
  EXPECT_EQ(xAt(schedule, 100), 1.0);
  EXPECT_EQ(schedule.pending(), 0u);
}

TEST(SetPointSchedule, ReplacingBeforeTheFirstSetPointLeavesNone) {
  SetPointSchedule schedule({at(10, 1.0)});
  schedule.replace(5, {at(30, 3.0)});
  EXPECT_EQ(schedule.at(29), nullptr);
  EXPECT_EQ(xAt(schedule, 30), 3.0);
}

TEST(SetPointSchedule, ARefusedPlanChangesNothing) {
  SetPointSchedule schedule({at(10, 1.0), at(20, 2.0)});
  EXPECT_EQ(xAt(schedule, 15), 1.0);
  EXPECT_THROW(schedule.replace(15, {at(40, 7.0), at(30, 8.0)}), std::invalid_argument);
  EXPECT_EQ(xAt(schedule, 20), 2.0);
}

}  // namespace
}  // namespace aqc
