#include "adaptive_quadrotor_control/pilot/imu_monitor.h"

#include <gtest/gtest.h>

#include <limits>

namespace aqc {
namespace {

constexpr Nanoseconds kMillisecond = 1'000'000;

TEST(ImuMonitor, GivesTheLatestSampleUntilItIsTooOld) {
  ImuMonitor imu;
  EXPECT_EQ(imu.at(0), nullptr) << "nothing has come";
  ASSERT_TRUE(imu.take({1, 2, 3}, 5 * kMillisecond));
  ASSERT_NE(imu.at(5 * kMillisecond), nullptr);
  EXPECT_EQ(*imu.at(5 * kMillisecond + ImuMonitor::kOldest), Eigen::Vector3d(1, 2, 3));
  EXPECT_EQ(imu.losses(), 0);
  EXPECT_EQ(imu.at(5 * kMillisecond + ImuMonitor::kOldest + 1), nullptr);
  EXPECT_FALSE(imu.usable());
  EXPECT_EQ(imu.losses(), 1);
}

TEST(ImuMonitor, CountsALossOnceAndRecovers) {
  ImuMonitor imu;
  for (int loss = 1; loss <= 2; ++loss) {
    const Nanoseconds now = loss * 1000 * kMillisecond;
    ASSERT_TRUE(imu.take(Eigen::Vector3d::Constant(loss), now));
    EXPECT_EQ(imu.at(now)->z(), loss);
    for (int i = 1; i < 4; ++i) EXPECT_EQ(imu.at(now + i * 200 * kMillisecond), nullptr);
    EXPECT_EQ(imu.losses(), loss);
  }
}

TEST(ImuMonitor, DropsAndCountsBadSamples) {
  ImuMonitor imu;
  EXPECT_FALSE(imu.take({0, std::numeric_limits<double>::quiet_NaN(), 0}, 1));
  EXPECT_FALSE(imu.take({std::numeric_limits<double>::infinity(), 0, 0}, 2));
  EXPECT_TRUE(imu.take({1, 0, 0}, 10));
  EXPECT_FALSE(imu.take({2, 0, 0}, 9)) << "its stamp goes back";
  EXPECT_TRUE(imu.take({3, 0, 0}, 10)) << "the same again is fine";
  EXPECT_EQ(imu.dropped(), 3);
  EXPECT_EQ(imu.at(10)->x(), 3.0);
}

TEST(ImuMonitor, FollowsAClockThatStartsAnew) {
  constexpr Nanoseconds kOld = 100 * kNewStart;
  ImuMonitor imu;
  imu.take({1, 0, 0}, kOld);
  ASSERT_NE(imu.at(kOld), nullptr);
  EXPECT_FALSE(imu.take({2, 0, 0}, kOld - kNewStart)) << "late";
  EXPECT_FALSE(imu.covers(kNewStart)) << "of the old time";
  EXPECT_TRUE(imu.take({3, 0, 0}, kNewStart));
  EXPECT_TRUE(imu.covers(kNewStart));
  ASSERT_NE(imu.at(kNewStart), nullptr);
  EXPECT_EQ(imu.at(kNewStart)->x(), 3.0);
  EXPECT_EQ(imu.losses(), 0);
  EXPECT_EQ(imu.dropped(), 1);
}

TEST(ImuMonitor, FollowsAClockThatIsSetBackByLess) {
  constexpr Nanoseconds kOld = 100 * kNewStart, kNew = kOld - kNewStart / 2;
  ImuMonitor imu;
  imu.take({1, 0, 0}, kOld);
  for (int i = 1; i < ImuMonitor::kConfirmations; ++i) {
    EXPECT_FALSE(imu.take({2, 0, 0}, kNew + i)) << i;
  }
  EXPECT_TRUE(imu.take({3, 0, 0}, kNew + 100));
  EXPECT_EQ(imu.time(), kNew + 100);
  EXPECT_TRUE(imu.take({4, 0, 0}, kNew + 101));
  EXPECT_FALSE(imu.take({5, 0, 0}, kNew)) << "of one step only";
}

TEST(ImuMonitor, FollowsNoStragglersAndNoSecondSource) {
  constexpr Nanoseconds kOld = 100 * kNewStart, kBehind = kOld - kNewStart / 2;
  ImuMonitor imu;
  imu.take({1, 0, 0}, kOld);
  for (int i = 1; i < 10; ++i) EXPECT_FALSE(imu.take({2, 0, 0}, kBehind - i)) << "back and back";
  for (int i = 1; i < 10; ++i) {
    EXPECT_FALSE(imu.take({2, 0, 0}, kBehind + i)) << "in turns with the first one";
    EXPECT_TRUE(imu.take({1, 0, 0}, kOld + i));
  }
  EXPECT_EQ(imu.dropped(), 18);
}

TEST(ImuMonitor, GivesNoSampleOfTheOldTime) {
  ImuMonitor imu;
  imu.take({1, 0, 0}, 100 * kNewStart);
  ASSERT_NE(imu.at(100 * kNewStart), nullptr);
  EXPECT_EQ(imu.at(kNewStart), nullptr);
  EXPECT_EQ(imu.losses(), 1);
}

TEST(ImuMonitor, CoversOdometryThatIsNotNewer) {
  ImuMonitor imu;
  EXPECT_FALSE(imu.covers(0));
  imu.take(Eigen::Vector3d::Zero(), 10);
  EXPECT_TRUE(imu.covers(9));
  EXPECT_TRUE(imu.covers(10));
  EXPECT_FALSE(imu.covers(11));
}

}  // namespace
}  // namespace aqc
