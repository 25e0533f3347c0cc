#include <gtest/gtest.h>

#include "adaptive_quadrotor_control/reference/sampling.h"
#include "ros/border/conversions.h"
#include "support/trajectories.h"

namespace aqc {
namespace {

constexpr Nanoseconds kBegin = 5'000'000'000;
constexpr Nanoseconds kPeriod = 10'000'000;

std::vector<TimedSetPoint> path() {
  return sample(minimumSnap({test::at(0, 0, 1), test::at(3, 1, 2, 1)}, {4}), kBegin, kPeriod);
}

TEST(TrajectoryJerk, IsThatOfTheSampledPath) {
  const std::vector<TimedSetPoint> sent = path();
  const std::vector<TimedSetPoint> heard = toSetPoints(toTrajectory(sent, kBegin), kBegin);
  ASSERT_EQ(heard.size(), sent.size());
  // A forward difference is off by half an interval of snap, which is below 30 m/s^4 here.
  for (std::size_t i = 0; i + 1 < sent.size(); ++i) {
    EXPECT_LT((heard[i].set_point.jerk - sent[i].set_point.jerk).norm(), 0.15) << i;
    EXPECT_EQ(heard[i].set_point.yaw_acceleration, sent[i].set_point.yaw_acceleration) << i;
  }
  EXPECT_GT(sent[50].set_point.jerk.norm(), 1.0) << "the path has jerk to find";
  EXPECT_TRUE(heard.back().set_point.jerk.isZero(0.0));
}

TEST(TrajectoryJerk, IsZeroWhereNothingTellsIt) {
  const auto jerk = [](const trajectory_msgs::MultiDOFJointTrajectory& trajectory) {
    return toSetPoints(trajectory, kBegin)[1].set_point.jerk.norm();
  };
  const trajectory_msgs::MultiDOFJointTrajectory told = toTrajectory(path(), kBegin);
  EXPECT_GT(jerk(told), 0.0);
  trajectory_msgs::MultiDOFJointTrajectory changed = told;
  changed.points[2].accelerations.clear();
  EXPECT_EQ(jerk(changed), 0.0) << "the next point has no acceleration";
  changed = told;
  changed.points[1].accelerations.clear();
  EXPECT_EQ(jerk(changed), 0.0) << "the point has no acceleration";
  changed = told;
  changed.points[2].time_from_start = changed.points[1].time_from_start;
  EXPECT_EQ(jerk(changed), 0.0) << "no time between the points";
  changed = told;
  changed.points.erase(changed.points.begin() + 2, changed.points.begin() + 30);
  EXPECT_EQ(jerk(changed), 0.0) << "waypoints far apart are no sampled path";
}

}  // namespace
}  // namespace aqc
