#include "adaptive_quadrotor_control/reference/minimum_snap.h"

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "support/refusal.h"
#include "support/trajectories.h"

namespace aqc {
namespace {

using test::at;
using test::kInf;
using test::kNan;
using test::randomVector;
using test::randomWaypoint;
using test::refusal;

TEST(MinimumSnap, OneSegmentFromRestToRestIsTheClosedForm) {
  const double duration = 2.5;
  const PolynomialTrajectory trajectory =
      minimumSnap({at(1, -2, 3, 0.5), at(4, 5, -6, -0.5)}, {duration});
  const Eigen::Vector4d start(1, -2, 3, 0.5);
  const Eigen::Vector4d step(3, 7, -9, -1);
  for (int i = 0; i <= 20; ++i) {
    const double s = i / 20.0;
    const double profile =
        35 * std::pow(s, 4) - 84 * std::pow(s, 5) + 70 * std::pow(s, 6) - 20 * std::pow(s, 7);
    const double speed = 140 * std::pow(s * (1 - s), 3) / duration;
    const FlatOutput output = trajectory.evaluate(s * duration);
    EXPECT_LE((output.derivative[0] - start - profile * step).norm(), 1e-12);
    EXPECT_LE((output.derivative[1] - speed * step).norm(), 1e-12);
  }
  // The snap of the profile is 840 times the third Legendre polynomial, of squared norm 1/7.
  const double cost = step.squaredNorm() * 840.0 * 840.0 / 7.0 * std::pow(duration, -7);
  EXPECT_NEAR(trajectory.snapCost(), cost, 1e-12 * cost);
}

TEST(MinimumSnap, OneWaypointIsAHoldOfZeroDuration) {
  const PolynomialTrajectory trajectory = minimumSnap({at(1, 2, 3, 0.4)}, {});
  EXPECT_EQ(trajectory.duration(), 0.0);
  EXPECT_TRUE(trajectory.segmentDurations().empty());
  EXPECT_EQ(trajectory.snapCost(), 0.0);
  for (const double time : {-1.0, 0.0, 1.0, kInf, -kInf, kNan}) {
    const FlatOutput output = trajectory.evaluate(time);
    EXPECT_EQ(output.derivative[0], Eigen::Vector4d(1, 2, 3, 0.4));
    for (std::size_t order = 1; order < 5; ++order) {
      EXPECT_EQ(output.derivative[order], Eigen::Vector4d::Zero());
    }
  }
}

TEST(MinimumSnap, CoincidentWaypointsAtRestHold) {
  std::vector<Waypoint> waypoints{at(0, 0, 1), at(2, 1, 3, 1.0), at(2, 1, 3, 1.0), at(0, 0, 1)};
  waypoints[1].velocity = waypoints[1].acceleration = waypoints[1].jerk = Eigen::Vector4d::Zero();
  waypoints[2].velocity = waypoints[2].acceleration = waypoints[2].jerk = Eigen::Vector4d::Zero();
  const PolynomialTrajectory trajectory = minimumSnap(waypoints, {1.0, 2.0, 1.0});
  for (double time = 1.0; time < 3.0; time += 0.1) {
    const FlatOutput output = trajectory.evaluate(time);
    EXPECT_EQ(output.derivative[0], Eigen::Vector4d(2, 1, 3, 1));
    EXPECT_EQ(output.derivative[1], Eigen::Vector4d::Zero());
    EXPECT_EQ(output.derivative[4], Eigen::Vector4d::Zero());
  }
}

TEST(MinimumSnap, AllCoincidentWaypointsStayThere) {
  const PolynomialTrajectory trajectory =
      minimumSnap({at(3, 4, 5, 1), at(3, 4, 5, 1), at(3, 4, 5, 1)}, {1.0, 0.1});
  EXPECT_EQ(trajectory.snapCost(), 0.0);
  EXPECT_EQ(trajectory.evaluate(0.7).derivative[0], Eigen::Vector4d(3, 4, 5, 1));
}

TEST(MinimumSnap, FixedDerivativesAreMet) {
  std::mt19937 random(7);
  std::vector<Waypoint> waypoints;
  std::vector<double> durations;
  for (int i = 0; i < 8; ++i) {
    waypoints.push_back(randomWaypoint(random));
    if (i != 2) waypoints.back().velocity = randomVector(random, 5.0);
    if (i != 3) waypoints.back().acceleration = randomVector(random, 5.0);
    if (i != 4) waypoints.back().jerk = randomVector(random, 5.0);
    if (i > 0) durations.push_back(0.2 * i);
  }
  const PolynomialTrajectory trajectory = minimumSnap(waypoints, durations);
  double time = 0.0;
  for (std::size_t i = 0; i < waypoints.size(); ++i) {
    // Just before the knot as well: the left polynomial must arrive with the same derivatives.
    for (const double t : {time, i == 0 ? time : std::nextafter(time, 0.0)}) {
      const FlatOutput output = trajectory.evaluate(t);
      EXPECT_LE((output.derivative[0].head<3>() - waypoints[i].position).norm(), 1e-9);
      const std::optional<Eigen::Vector4d> fixed[] = {waypoints[i].velocity,
                                                      waypoints[i].acceleration, waypoints[i].jerk};
      for (std::size_t order = 1; order <= 3; ++order) {
        if (fixed[order - 1]) {
          EXPECT_LE((output.derivative[order] - *fixed[order - 1]).norm(), 1e-9);
        }
      }
    }
    time += i < durations.size() ? durations[i] : 0.0;
  }
}

TEST(MinimumSnap, RestAtTheEndsIsTheDefaultAndFreeEndsCostLess) {
  const std::vector<Waypoint> waypoints{at(0, 0, 0), at(1, 2, 0), at(3, 1, 1), at(4, 4, 4)};
  const std::vector<double> durations{1.0, 1.5, 1.0};
  const PolynomialTrajectory rest = minimumSnap(waypoints, durations);
  const PolynomialTrajectory free = minimumSnap(waypoints, durations, EndDerivatives::kFree);
  for (const double time : {0.0, rest.duration()}) {
    for (std::size_t order = 1; order <= 3; ++order) {
      EXPECT_LE(rest.evaluate(time).derivative[order].norm(), 1e-9);
    }
  }
  EXPECT_GT(free.evaluate(0.0).derivative[1].norm(), 0.1);
  // Through four points there is a cubic, which has no snap at all.
  EXPECT_LE(free.snapCost(), 1e-18 * rest.snapCost());
}

TEST(MinimumSnap, FreeEndsThatLeaveTheOptimumOpenAreRefused) {
  std::vector<Waypoint> two{at(0, 0, 0), at(1, 2, 0)};
  const auto solve = [](const std::vector<Waypoint>& waypoints) {
    return [&waypoints] {
      minimumSnap(waypoints, std::vector<double>(waypoints.size() - 1, 1.0), EndDerivatives::kFree);
    };
  };
  EXPECT_NE(refusal(solve(two)).find("undetermined"), std::string::npos);
  two[0].jerk = two[1].jerk = Eigen::Vector4d::Zero();  // a cubic has only one jerk
  EXPECT_NE(refusal(solve(two)).find("undetermined"), std::string::npos);
  two[0].velocity = Eigen::Vector4d::Ones();
  EXPECT_EQ(refusal(solve(two)), "");
  std::vector<Waypoint> three{at(0, 0, 0), at(1, 2, 0), at(3, 1, 1)};
  EXPECT_NE(refusal(solve(three)).find("undetermined"), std::string::npos);
  // Halfway between the ends the cubic t (t - 1) (t - 2) has no acceleration.
  three[1].acceleration = Eigen::Vector4d::Zero();
  EXPECT_NE(refusal(solve(three)).find("undetermined"), std::string::npos);
  three[1].velocity = Eigen::Vector4d::Zero();
  EXPECT_EQ(refusal(solve(three)), "");
}

TEST(MinimumSnap, YawGoesTheShortWayRound) {
  const PolynomialTrajectory across =
      minimumSnap({at(0, 0, 0, 3.0), at(1, 0, 0, -3.0), at(2, 0, 0, 3.0)}, {1.0, 1.0});
  EXPECT_NEAR(across.evaluate(0.0).derivative[0](3), 3.0, 1e-12);
  EXPECT_NEAR(across.evaluate(1.0).derivative[0](3), -3.0 + 2.0 * M_PI, 1e-12);
  EXPECT_NEAR(across.evaluate(2.0).derivative[0](3), 3.0, 1e-12);
  // Steps of less than half a turn add up: all the way round and on.
  std::vector<Waypoint> round;
  for (int i = 0; i <= 8; ++i) {
    round.push_back(at(i, 0, 0, std::remainder(i * 2.0, 2.0 * M_PI)));
  }
  const PolynomialTrajectory turning = minimumSnap(round, std::vector<double>(8, 1.0));
  for (int i = 0; i <= 8; ++i) {
    EXPECT_NEAR(turning.evaluate(i).derivative[0](3), i * 2.0, 1e-12);
  }
  // Whole turns in the input make no difference but at the start, whose yaw is kept.
  const PolynomialTrajectory wound =
      minimumSnap({at(0, 0, 0, 1.0 + 6.0 * M_PI), at(0, 0, 0, 1.5 - 20.0 * M_PI)}, {1.0});
  EXPECT_NEAR(wound.evaluate(0.0).derivative[0](3), 1.0 + 6.0 * M_PI, 1e-12);
  EXPECT_NEAR(wound.evaluate(1.0).derivative[0](3), 1.5 + 6.0 * M_PI, 1e-12);
}

TEST(MinimumSnap, NamesWhatIsWrong) {
  const std::vector<Waypoint> four{at(0, 0, 0), at(1, 1, 1), at(2, 0, 0), at(3, 0, 0)};
  EXPECT_EQ(refusal([&] { minimumSnap({}, {}); }),
            "there is no waypoint; there must be at least 1");
  EXPECT_EQ(refusal([&] {
              minimumSnap(four, {1.0, 1.0});
            }),
            "there are 2 segment durations for 4 waypoints; there must be 3");
  EXPECT_EQ(refusal([&] { minimumSnap({at(0, 0, 0)}, {1.0}); }),
            "there are 1 segment durations for 1 waypoints; there must be 0");
  EXPECT_EQ(refusal([&] {
              minimumSnap(four, {1.0, 1.0, -1.0});
            }),
            "segment duration 2 is -1 s; it must be finite and >= 1e-09 s");
  for (const double duration : {0.0, -0.0, kInf, -kInf, kNan}) {
    EXPECT_EQ(refusal([&] {
                minimumSnap(four, {1.0, duration, 1.0});
              }).find("segment duration 1"),
              0U);
  }
  EXPECT_NE(refusal([&] { minimumSnap(four, {1e-300, 1.0, 1.0}); }), "");
}

TEST(MinimumSnap, RefusesNumbersThatAreNotFinite) {
  const std::vector<Waypoint> good(3);
  for (const double bad : {kNan, kInf, -kInf}) {
    std::vector<Waypoint> waypoints = good;
    waypoints[1].position.y() = bad;
    EXPECT_EQ(refusal([&] {
                minimumSnap(waypoints, {1, 1});
              }).find("the position of waypoint 1"),
              0U);
    waypoints = good;
    waypoints[2].yaw = bad;
    EXPECT_EQ(refusal([&] { minimumSnap(waypoints, {1, 1}); }).find("the yaw of waypoint 2"), 0U);
    const auto with = [&](std::optional<Eigen::Vector4d> Waypoint::*derivative) {
      std::vector<Waypoint> changed = good;
      changed[0].*derivative = Eigen::Vector4d(0, 0, 0, bad);
      return refusal([&] { minimumSnap(changed, {1, 1}); });
    };
    EXPECT_EQ(with(&Waypoint::velocity).find("the velocity of waypoint 0"), 0U);
    EXPECT_EQ(with(&Waypoint::acceleration).find("the acceleration of waypoint 0"), 0U);
    EXPECT_EQ(with(&Waypoint::jerk).find("the jerk of waypoint 0"), 0U);
  }
}

TEST(MinimumSnap, ALoneWaypointCannotMove) {
  std::vector<Waypoint> waypoints{at(0, 0, 0)};
  waypoints[0].velocity = Eigen::Vector4d::Zero();
  EXPECT_EQ(refusal([&] { minimumSnap(waypoints, {}); }), "");
  waypoints[0].velocity = Eigen::Vector4d::UnitX();
  EXPECT_NE(refusal([&] { minimumSnap(waypoints, {}); }).find("waypoint 0"), std::string::npos);
}

}  // namespace
}  // namespace aqc
