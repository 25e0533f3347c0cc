#include "adaptive_quadrotor_control/reference/time_allocation.h"

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <cmath>
#include <string>
#include <vector>

#include "support/refusal.h"
#include "support/trajectories.h"

namespace aqc {
namespace {

using test::at;
using test::exampleTrajectory;
using test::kInf;
using test::kNan;
using test::refusal;

constexpr MotionLimits kLimits{5.0, 6.0, 0.5, 1.6};

/// The largest ratio of demand to limit on a fine grid.
double worstUse(const PolynomialTrajectory& trajectory, const MotionLimits& limits) {
  const int segments = static_cast<int>(trajectory.segmentDurations().size());
  return test::worstUse(trajectory, limits, 4000 * segments);
}

TEST(TimeAllocation, EachLimitHoldsAndIsReached) {
  const std::vector<Waypoint> waypoints{at(0, 0, 1), at(8, 1, 2), at(6, 9, -3), at(-1, 2, 10)};
  const MotionLimits limits[] = {{3.0, 100.0, 1.5, 20.0},
                                 {100.0, 2.0, 1.5, 20.0},
                                 {100.0, 100.0, 0.3, 20.0},
                                 {100.0, 100.0, 1.5, 1.2}};
  for (const MotionLimits& limit : limits) {
    const PolynomialTrajectory trajectory = minimumSnapWithin(waypoints, limit);
    EXPECT_LE(worstUse(trajectory, limit), 1.0);
    EXPECT_GT(worstUse(trajectory.stretched(0.99), limit), 1.0);
    EXPECT_NEAR(requiredStretch(trajectory, limit), 1.0, 1e-5);
    EXPECT_NEAR(requiredStretch(trajectory.stretched(0.5), limit), 2.0, 1e-5);
  }
}

TEST(TimeAllocation, EstimateIsExactForOneStraightSegment) {
  const MotionLimits by_speed{2.0, 50.0, 1.5, 20.0};
  EXPECT_NEAR(estimateDurations({at(0, 0, 0), at(10, 0, 0)}, by_speed)[0], 35.0 / 16.0 * 5.0,
              1e-12);
  EXPECT_NEAR(
      requiredStretch(minimumSnap({at(0, 0, 0), at(10, 0, 0)}, {35.0 / 16.0 * 5.0}), by_speed), 1.0,
      1e-9);
  const MotionLimits by_acceleration{100.0, 2.0, 1.5, 20.0};
  const std::vector<Waypoint> waypoints{at(0, 0, 0), at(0, 6, 8)};
  const std::vector<double> durations = estimateDurations(waypoints, by_acceleration);
  EXPECT_NEAR(requiredStretch(minimumSnap(waypoints, durations), by_acceleration), 1.0, 1e-6);
}

TEST(TimeAllocation, EstimateLeavesThrustForTheWeight) {
  const MotionLimits by_thrust{100.0, 100.0, 1.5, 1.2};
  const double acceleration = 0.2 * kGravity;
  EXPECT_NEAR(estimateDurations({at(0, 0, 0), at(0, 0, 10)}, by_thrust)[0],
              std::sqrt(84.0 / (5.0 * std::sqrt(5.0)) * 10.0 / acceleration), 1e-9);
}

TEST(TimeAllocation, EstimateTiltsNoFurtherThanAllowed) {
  const MotionLimits by_tilt{100.0, 100.0, 0.3, 20.0};
  EXPECT_NEAR(estimateDurations({at(0, 0, 0), at(10, 0, 0)}, by_tilt)[0],
              std::sqrt(84.0 / (5.0 * std::sqrt(5.0)) * 10.0 / (kGravity * std::sin(0.3))), 1e-9);
}

TEST(TimeAllocation, FallingFasterThanGravityIsTiltBeyondTheLimit) {
  // Straight down the tilt is zero up to free fall and half a turn beyond it.
  const MotionLimits limits{100.0, 100.0, 0.5, 20.0};
  const PolynomialTrajectory trajectory = minimumSnapWithin({at(0, 0, 100), at(0, 0, 0)}, limits);
  EXPECT_LE(worstUse(trajectory, limits), 1.0);
  EXPECT_GT(worstUse(trajectory.stretched(0.99), limits), 1.0);
}

TEST(TimeAllocation, HoldsTakeAPositiveTime) {
  const std::vector<Waypoint> waypoints{at(1, 1, 1), at(1, 1, 1), at(1, 1, 1, 2.0)};
  for (const double duration : estimateDurations(waypoints, kLimits)) {
    EXPECT_GE(duration, 0.1);
  }
  const PolynomialTrajectory trajectory = minimumSnapWithin(waypoints, kLimits);
  EXPECT_GE(trajectory.duration(), 0.2 - 1e-12);
  EXPECT_EQ(requiredStretch(trajectory, kLimits), 0.0);
  EXPECT_EQ(minimumSnapWithin({at(1, 1, 1)}, kLimits).duration(), 0.0);
  EXPECT_EQ(requiredStretch(minimumSnapWithin({at(1, 1, 1)}, kLimits), kLimits), 0.0);
  // A hold between two flights, and waypoints next to each other.
  const PolynomialTrajectory held =
      minimumSnapWithin({at(0, 0, 0), at(4, 0, 0), at(4, 0, 0), at(4, 1e-6, 0)}, kLimits);
  EXPECT_LE(worstUse(held, kLimits), 1.0);
}

TEST(TimeAllocation, FixedDerivativesAreKeptWhileStretching) {
  std::vector<Waypoint> waypoints{at(0, 0, 1), at(8, 1, 2), at(16, 0, 2), at(20, 2, 4)};
  waypoints[1].velocity = Eigen::Vector4d(3, 0, 0, 0.1);
  waypoints[2].acceleration = Eigen::Vector4d(0, 0, 0.2, 0);
  waypoints[3].velocity = Eigen::Vector4d(1, 0, 0, 0);
  const PolynomialTrajectory trajectory = minimumSnapWithin(waypoints, kLimits);
  EXPECT_LE(worstUse(trajectory, kLimits), 1.0);
  const auto& durations = trajectory.segmentDurations();
  const double second = durations[0] + durations[1];
  EXPECT_LE((trajectory.evaluate(durations[0]).derivative[1] - *waypoints[1].velocity).norm(),
            1e-9);
  EXPECT_LE((trajectory.evaluate(second).derivative[2] - *waypoints[2].acceleration).norm(), 1e-9);
  EXPECT_LE(
      (trajectory.evaluate(trajectory.duration()).derivative[1] - *waypoints[3].velocity).norm(),
      1e-9);
  // Two percent less time with the same fixed derivatives is too little.
  std::vector<double> shorter = durations;
  for (double& duration : shorter) duration *= 0.98;
  EXPECT_GT(worstUse(minimumSnap(waypoints, shorter), kLimits), 1.0);
}

TEST(TimeAllocation, RefusesFixedDerivativesThatCannotBeHeld) {
  std::vector<Waypoint> waypoints{at(0, 0, 1), at(8, 1, 2), at(16, 0, 2)};
  const auto solve = [&] { minimumSnapWithin(waypoints, kLimits); };
  waypoints[1].velocity = Eigen::Vector4d(7, 0, 0, 0);
  EXPECT_NE(refusal(solve).find("waypoint 1 has the fixed velocity (7 0 0 0)"), std::string::npos);
  EXPECT_NE(refusal(solve).find("beyond the speed limit"), std::string::npos);
  waypoints[1].velocity.reset();
  waypoints[1].acceleration = Eigen::Vector4d(0, 0, 6.0, 0);
  EXPECT_NE(refusal(solve).find("beyond the thrust-to-weight limit"), std::string::npos);
  waypoints[1].acceleration = Eigen::Vector4d(5.9, 0, 0, 0);
  EXPECT_NE(refusal(solve).find("beyond the tilt limit"), std::string::npos);
  // Within the limits at the waypoint, but not to be left from rest so close by.
  waypoints = {at(0, 0, 1), at(0.01, 0, 1)};
  waypoints[1].velocity = Eigen::Vector4d(-4.999, 0, 0, 0);
  waypoints[1].acceleration = Eigen::Vector4d(4, 0, 0, 0);
  EXPECT_NE(refusal(solve).find("with these fixed derivatives"), std::string::npos);
}

TEST(TimeAllocation, RefusesImpossibleLimits) {
  const std::vector<Waypoint> waypoints{at(0, 0, 1), at(8, 1, 2)};
  const auto message = [&](const MotionLimits& limits) {
    const std::string by_estimate = refusal([&] { estimateDurations(waypoints, limits); });
    EXPECT_EQ(by_estimate, refusal([&] { minimumSnapWithin(waypoints, limits); }));
    EXPECT_EQ(by_estimate, refusal([&] { requiredStretch(exampleTrajectory(), limits); }));
    return by_estimate;
  };
  EXPECT_EQ(message(kLimits), "");
  for (const double bad : {0.0, -1.0, kInf, kNan}) {
    EXPECT_EQ(message({bad, 6.0, 0.5, 1.6}).find("the speed limit is"), 0U);
    EXPECT_EQ(message({5.0, bad, 0.5, 1.6}).find("the acceleration limit is"), 0U);
    EXPECT_EQ(message({5.0, 6.0, bad, 1.6}).find("the tilt limit is"), 0U);
    EXPECT_EQ(message({5.0, 6.0, 0.5, bad}).find("the thrust-to-weight limit is"), 0U);
  }
  EXPECT_EQ(message({5.0, 6.0, M_PI / 2.0, 1.6}).find("the tilt limit is"), 0U);
  EXPECT_EQ(message({5.0, 6.0, 0.5, 1.0}),
            "the thrust-to-weight limit is 1; it must be finite and > 1");
  EXPECT_NE(refusal([&] { estimateDurations({}, kLimits); }), "");
}

TEST(TimeAllocation, EstimateIsTheSameEverywhere) {
  const MotionLimits by_speed{2.0, 50.0, 1.5, 20.0};
  const std::vector<double> durations =
      estimateDurations({at(-2, 5, 7), at(8, 5, 7), at(8, 5, 17)}, by_speed);
  for (const double duration : durations) EXPECT_NEAR(duration, 35.0 / 16.0 * 5.0, 1e-12);
}

}  // namespace
}  // namespace aqc
