#include "adaptive_quadrotor_control/law/switched/switch_schedule.h"

#include <gtest/gtest.h>

namespace aqc {
namespace {

constexpr Nanoseconds kSecond = 1'000'000'000;

/// Three subsystems, the first one active, 5 s between two switches.
SubsystemSwitch subsystems(SubsystemSwitch::Policy policy = SubsystemSwitch::Policy::kRefuse) {
  return SubsystemSwitch(3, 1, {298.0, 0.9, 0.8, 5.0}, DwellTimeMonitor(5 * kSecond, 1.0), policy);
}

TEST(SwitchSchedule, ActsAtTheFirstStepNotBeforeTheOrder) {
  SubsystemSwitch subject = subsystems();
  SwitchSchedule schedule;
  EXPECT_TRUE(schedule.plan({8 * kSecond, 3}));
  EXPECT_TRUE(schedule.plan({2 * kSecond, 2}));  // orders may come in any order
  EXPECT_EQ(schedule.pending(), 2u);
  EXPECT_FALSE(schedule.next(subject, 2 * kSecond - 1));
  const auto report = schedule.next(subject, 2 * kSecond + 7);
  ASSERT_TRUE(report);
  EXPECT_EQ(report->time, 2 * kSecond + 7);
  EXPECT_EQ(report->verdict.outcome, SwitchOutcome::kSwitched);
  EXPECT_FALSE(report->objected());
  EXPECT_EQ(subject.active(), 2);
  EXPECT_FALSE(schedule.next(subject, 2 * kSecond + 7)) << "one at a time";
  EXPECT_TRUE(schedule.next(subject, 9 * kSecond));
  EXPECT_EQ(subject.active(), 3);
  EXPECT_EQ(schedule.pending(), 0u);
}

TEST(SwitchSchedule, SaysWhenARefusedSwitchIsAllowed) {
  SubsystemSwitch subject = subsystems();
  SwitchSchedule schedule;
  schedule.plan({kSecond, 2});
  schedule.plan({3 * kSecond, 1});
  schedule.plan({3 * kSecond, 7});
  ASSERT_TRUE(schedule.next(subject, kSecond));
  const auto early = schedule.next(subject, 3 * kSecond);
  ASSERT_TRUE(early);
  EXPECT_EQ(early->verdict.outcome, SwitchOutcome::kTooEarly);
  EXPECT_EQ(early->allowed, 6 * kSecond);
  EXPECT_TRUE(early->objected());
  const auto unknown = schedule.next(subject, 3 * kSecond);
  ASSERT_TRUE(unknown);
  EXPECT_EQ(unknown->order.subsystem, 7);
  EXPECT_EQ(unknown->verdict.outcome, SwitchOutcome::kUnknownSubsystem);
  EXPECT_TRUE(unknown->objected());
  EXPECT_EQ(subject.active(), 2);
  EXPECT_EQ(subject.objections(), 2);
  EXPECT_EQ(switchObjection(1, toString(early->verdict.outcome), early->allowed, early->time,
                            kSecond / 2),
            "switch to subsystem 1 refused: against the dwell time; the next switch is allowed at "
            "5.5 s");
  EXPECT_EQ(switchObjection(7, toString(unknown->verdict.outcome), 3 * kSecond, 3 * kSecond, 0),
            "switch to subsystem 7 refused: no such subsystem");
}

TEST(SwitchSchedule, PolicyWarnSwitchesAndObjects) {
  SubsystemSwitch subject = subsystems(SubsystemSwitch::Policy::kWarn);
  SwitchSchedule schedule;
  schedule.plan({0, 2});
  schedule.plan({1, 3});
  EXPECT_FALSE(schedule.next(subject, 1)->objected());
  EXPECT_TRUE(schedule.next(subject, 1)->objected());
  EXPECT_EQ(subject.active(), 3);
  EXPECT_NE(subject.text().find("policy warn"), std::string::npos);
}

TEST(SwitchSchedule, BeginsAnewWithItsClock) {
  SubsystemSwitch subject = subsystems();
  SwitchSchedule schedule;
  schedule.plan({100 * kSecond, 2});
  schedule.plan({102 * kSecond, 3});
  ASSERT_TRUE(schedule.next(subject, 100 * kSecond));
  schedule.clear();
  subject.restart();
  EXPECT_EQ(schedule.pending(), 0u);
  EXPECT_FALSE(schedule.next(subject, 200 * kSecond));
  schedule.plan({kSecond, 3});
  const auto report = schedule.next(subject, kSecond);
  ASSERT_TRUE(report);
  EXPECT_EQ(report->verdict.outcome, SwitchOutcome::kSwitched) << "no dwell time of the old clock";
  EXPECT_EQ(subject.active(), 3);
}

TEST(SwitchSchedule, HasABound) {
  SwitchSchedule schedule;
  for (std::size_t i = 0; i < SwitchSchedule::kMost; ++i) ASSERT_TRUE(schedule.plan({1, 2}));
  EXPECT_FALSE(schedule.plan({1, 2}));
}

}  // namespace
}  // namespace aqc
