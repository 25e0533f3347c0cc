#include "adaptive_quadrotor_control/simulation/pacer.h"

#include <gtest/gtest.h>

namespace aqc {
namespace {

constexpr Nanoseconds kPeriod = 4'000'000;
constexpr Nanoseconds kWall = 7'000'000'000;
constexpr Nanoseconds kPlant = 1'000'000'000;

TEST(Pacer, FollowsTheWallClockAtItsFactor) {
  for (const double factor : {0.5, 1.0, 4.0}) {
    Pacer pacer({kPeriod, factor, false, false}, kWall, kPlant);
    Nanoseconds plant = kPlant;
    for (Nanoseconds wall = kWall; wall <= kWall + 1'000'000'000; wall += 3'000'000) {
      plant += pacer.due(wall, plant) * kPeriod;
      const double wanted = static_cast<double>(wall - kWall) * factor;
      const double behind = wanted - static_cast<double>(plant - kPlant);
      ASSERT_GE(behind, 0.0);
      ASSERT_LT(behind, static_cast<double>(kPeriod));
    }
  }
}

TEST(Pacer, GivesUpATimeThatItCannotCatchUpWith) {
  Pacer pacer({kPeriod, 1.0, false, false}, kWall, kPlant);
  const Nanoseconds at_limit = kWall + Pacer::kLongestBacklog;
  EXPECT_EQ(pacer.due(at_limit, kPlant), Pacer::kLongestBacklog / kPeriod) << "still caught up";
  EXPECT_EQ(pacer.due(at_limit + 1, kPlant), 1) << "one period, and from there on real time";
  EXPECT_EQ(pacer.due(at_limit + 1, kPlant + kPeriod), 0);
  EXPECT_EQ(pacer.due(at_limit + 1 + kPeriod, kPlant + kPeriod), 1);
}

TEST(Pacer, InLockStepOnlyTheAnswerMovesTheClock) {
  Pacer pacer({kPeriod, 1.0, true, false}, kWall, kPlant);
  EXPECT_EQ(pacer.due(kWall + 1'000'000'000, kPlant), 0);
  EXPECT_TRUE(pacer.takes(kPlant, kPlant));
  EXPECT_FALSE(pacer.takes(kPlant - 1, kPlant));
  EXPECT_FALSE(pacer.takes(kPlant + 1, kPlant));
  EXPECT_EQ(pacer.interval(), Pacer::kRepeatAfter / 4);
}

TEST(Pacer, WithRealTimeEveryCommandIsTaken) {
  Pacer pacer({kPeriod, 2.0, false, false}, kWall, kPlant);
  EXPECT_TRUE(pacer.takes(0, kPlant));
  EXPECT_EQ(pacer.interval(), kPeriod / 2);
  EXPECT_FALSE(pacer.repeats(kWall + 10'000'000'000)) << "it publishes anyway";
}

TEST(Pacer, RepeatsWhatNobodyAnswered) {
  for (const bool lock_step : {false, true}) {
    Pacer pacer({kPeriod, 1.0, lock_step, !lock_step}, kWall, kPlant);
    EXPECT_FALSE(pacer.repeats(kWall + Pacer::kRepeatAfter));
    EXPECT_TRUE(pacer.repeats(kWall + Pacer::kRepeatAfter + 1));
    pacer.published(kWall + Pacer::kRepeatAfter + 1);
    EXPECT_FALSE(pacer.repeats(kWall + Pacer::kRepeatAfter + 2));
  }
}

TEST(Pacer, StandsStillUntilItIsResumed) {
  Pacer pacer({kPeriod, 1.0, false, true}, kWall, kPlant);
  const Nanoseconds later = kWall + 100'000'000;
  EXPECT_TRUE(pacer.paused());
  EXPECT_EQ(pacer.due(later, kPlant), 0);
  EXPECT_FALSE(pacer.takes(kPlant, kPlant));
  EXPECT_TRUE(pacer.resume(later, kPlant));
  EXPECT_FALSE(pacer.paused());
  EXPECT_FALSE(pacer.resume(later, kPlant)) << "once";
  EXPECT_EQ(pacer.due(later, kPlant), 0) << "the pause is not caught up with";
  EXPECT_EQ(pacer.due(later + kPeriod, kPlant), 1);
}

}  // namespace
}  // namespace aqc
