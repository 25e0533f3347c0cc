#include "adaptive_quadrotor_control/simulation/command_link.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "support/fixtures.h"
#include "support/refusal.h"

namespace aqc {
namespace {

constexpr Nanoseconds kMillisecond = 1'000'000;

RotorArray speed(double value) {
  return RotorArray::Constant(4, value);
}

TEST(CommandLink, HoldsTheLastCommandForEverWithoutATimeOut) {
  CommandLink link(4, 0);
  EXPECT_EQ(link.told(0), speed(0.0)) << "nothing has come yet";
  link.send(speed(300.0), 5 * kMillisecond);
  EXPECT_EQ(link.told(fromSeconds(1e5)), speed(300.0));
  EXPECT_FALSE(link.silent(fromSeconds(1e5)));
}

TEST(CommandLink, SwitchesTheRotorsOffAfterASilenceUntilACommandComes) {
  CommandLink link(4, 250 * kMillisecond);
  EXPECT_FALSE(link.silent(fromSeconds(10.0))) << "nobody has spoken yet";
  const Nanoseconds begin = fromSeconds(20.0);
  link.send(speed(300.0), begin);
  EXPECT_EQ(link.told(begin + 250 * kMillisecond - 1), speed(300.0));
  EXPECT_FALSE(link.silent(begin + 250 * kMillisecond - 1));
  EXPECT_EQ(link.told(begin + 250 * kMillisecond), speed(0.0));
  EXPECT_TRUE(link.silent(begin + 250 * kMillisecond));
  link.send(speed(200.0), begin + fromSeconds(1.0));
  EXPECT_EQ(link.told(begin + fromSeconds(1.0)), speed(200.0));
  EXPECT_FALSE(link.silent(begin + fromSeconds(1.0)));
}

TEST(CommandLink, LosesItsShareOfCommandsForItsTimeAndTheLastOneStays) {
  CommandLink link(4, 0);
  link.lose(0.3, 10'000, 7);
  int lost = 0;
  for (int now = 0; now < 20'000; ++now) {
    const RotorArray before = link.told(now);
    link.send(speed(now + 1.0), now);
    if (link.told(now) == speed(now + 1.0)) continue;
    ++lost;
    EXPECT_EQ(link.told(now), before);
    EXPECT_LT(now, 10'000);
  }
  EXPECT_NEAR(lost, 3000, 150) << "within three standard deviations";
}

TEST(CommandLink, LosesTheSameOfTheSameSeedAndNoneOrAllOfAnExtremeShare) {
  const auto heard = [](double share, std::uint64_t seed) {
    CommandLink link(4, 0);
    link.lose(share, 1000, seed);
    std::vector<bool> came;
    for (int now = 0; now < 1000; ++now) {
      link.send(speed(now + 1.0), now);
      came.push_back(link.told(now) == speed(now + 1.0));
    }
    return came;
  };
  EXPECT_EQ(heard(0.5, 1), heard(0.5, 1));
  EXPECT_NE(heard(0.5, 1), heard(0.5, 2));
  EXPECT_EQ(heard(0.0, 1), std::vector<bool>(1000, true));
  EXPECT_EQ(heard(1.0, 1), std::vector<bool>(1000, false));
}

TEST(CommandLink, TimesOutWhenAllIsLost) {
  CommandLink link(4, 20);
  link.send(speed(100.0), 0);
  link.lose(1.0, 1000, 1);
  for (int now = 1; now < 30; ++now) link.send(speed(200.0), now);
  EXPECT_TRUE(link.silent(20));
  EXPECT_EQ(link.told(20), speed(0.0));
  link.lose(0.0, 0, 1);
  link.send(speed(200.0), 40);
  EXPECT_EQ(link.told(40), speed(200.0));
}

TEST(CommandLink, RefusesATimeOutBelowZero) {
  EXPECT_EQ(test::refusal([] { CommandLink(4, -1); }),
            "the time-out of commands is -1 ns; it must be > 0, or 0 for none");
}

}  // namespace
}  // namespace aqc
