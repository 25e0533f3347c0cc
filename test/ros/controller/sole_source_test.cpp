#include "ros/controller/sole_source.h"

#include <gtest/gtest.h>

namespace aqc {
namespace {

constexpr Nanoseconds kMillisecond = 1'000'000;

TEST(SoleSource, HearsTheFirstOneOnlyWhileItSpeaks) {
  SoleSource source(100 * kMillisecond);
  Nanoseconds now = 5'000 * kMillisecond;
  EXPECT_EQ(source.name(), "");
  EXPECT_TRUE(source.hears("/first", now));
  for (int i = 0; i < 50; ++i) {
    now += 10 * kMillisecond;
    EXPECT_FALSE(source.hears("/second", now));
    EXPECT_TRUE(source.hears("/first", now));
  }
  EXPECT_EQ(source.name(), "/first");
}

TEST(SoleSource, TurnsToAnotherOnceTheFirstIsSilent) {
  SoleSource source(100 * kMillisecond);
  EXPECT_TRUE(source.hears("/first", 0));
  EXPECT_FALSE(source.hears("/second", 100 * kMillisecond));
  EXPECT_TRUE(source.hears("/second", 101 * kMillisecond));
  EXPECT_FALSE(source.hears("/first", 102 * kMillisecond));
  EXPECT_EQ(source.name(), "/second");
}

}  // namespace
}  // namespace aqc
