#include "adaptive_quadrotor_control/reference/sampling.h"

#include <gtest/gtest.h>

#include <vector>

#include "support/refusal.h"
#include "support/trajectories.h"

namespace aqc {
namespace {

constexpr Nanoseconds kBegin = 5'000'000'000;
constexpr Nanoseconds kPeriod = 300'000'000;

TEST(Sampling, OneSetPointEveryPeriodAndOneAtTheEnd) {
  const PolynomialTrajectory trajectory =
      minimumSnap({test::at(0, 0, 1), test::at(3, 1, 2, 1)}, {1});
  const std::vector<TimedSetPoint> samples = sample(trajectory, kBegin, kPeriod);
  ASSERT_EQ(samples.size(), 5u);
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_EQ(samples[i].time, kBegin + static_cast<Nanoseconds>(i) * kPeriod);
  }
  EXPECT_EQ(samples[4].time, kBegin + 1'000'000'000);
  const FlatOutput middle = trajectory.evaluate(0.6);
  EXPECT_EQ(samples[2].set_point.position, middle.derivative[0].head<3>());
  EXPECT_EQ(samples[2].set_point.velocity, middle.derivative[1].head<3>());
  EXPECT_EQ(samples[2].set_point.acceleration, middle.derivative[2].head<3>());
  EXPECT_EQ(samples[2].set_point.jerk, middle.derivative[3].head<3>());
  EXPECT_EQ(samples[2].set_point.yaw, middle.derivative[0][3]);
  EXPECT_EQ(samples[2].set_point.yaw_rate, middle.derivative[1][3]);
  EXPECT_EQ(samples[2].set_point.yaw_acceleration, middle.derivative[2][3]);
  EXPECT_EQ(samples[4].set_point.position, Eigen::Vector3d(3, 1, 2));
}

TEST(Sampling, AHoldIsOneSetPoint) {
  const std::vector<TimedSetPoint> samples = sample(minimumSnap({test::at(1, 2, 3)}, {}), 7, 1);
  ASSERT_EQ(samples.size(), 1u);
  EXPECT_EQ(samples[0].time, 7);
  EXPECT_EQ(samples[0].set_point.position, Eigen::Vector3d(1, 2, 3));
}

TEST(Sampling, RefusesPeriodsThatNeverEnd) {
  const PolynomialTrajectory trajectory = test::exampleTrajectory();
  EXPECT_EQ(test::refusal([&] { sample(trajectory, 0, 0); }),
            "the period of the set points is 0 ns; it must be > 0");
  EXPECT_NE(test::refusal([&] { sample(trajectory, 0, -1); }), "");
}

TEST(Sampling, RefusesMoreSetPointsThanAnyFlightNeeds) {
  const auto lasting = [](double duration) {
    return minimumSnap({test::at(0, 0, 1), test::at(3, 1, 2, 1)}, {duration});
  };
  constexpr Nanoseconds kCentisecond = 10'000'000;
  EXPECT_EQ(
      test::refusal([&] { sample(lasting(2e7), 0, kCentisecond); }),
      "the duration is 20000000 s; it must be <= 10000 s, which makes 1000000 set points, one "
      "every 0.01 s");
  EXPECT_NE(test::refusal([&] { sample(lasting(1e30), 0, kCentisecond); }), "");
  EXPECT_NE(test::refusal([&] { sample(lasting(1.0), 0, 1); }), "");
  EXPECT_NO_THROW(requireFewSetPoints(1e4, kCentisecond));
}

}  // namespace
}  // namespace aqc
