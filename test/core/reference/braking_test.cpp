#include "adaptive_quadrotor_control/reference/braking.h"

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <cmath>
#include <random>

#include "support/refusal.h"
#include "support/trajectories.h"

namespace aqc {
namespace {

using test::at;
using test::refusal;
using test::worstUse;

constexpr MotionLimits kLimits{5.0, 6.0, 0.5, 1.6};
constexpr int kSteps = 4000;

Waypoint moving(const Eigen::Vector4d& velocity, const Eigen::Vector4d& acceleration) {
  Waypoint present = at(1, 2, 3, 0.5);
  present.velocity = velocity;
  present.acceleration = acceleration;
  return present;
}

/// Begins with the present motion and ends at rest.
void expectBrakes(const PolynomialTrajectory& trajectory, const Waypoint& present) {
  const FlatOutput begin = trajectory.evaluate(0.0);
  EXPECT_LE((begin.derivative[0].head<3>() - present.position).norm(), 1e-12);
  EXPECT_EQ(begin.derivative[0][3], present.yaw);
  EXPECT_LE((begin.derivative[1] - *present.velocity).norm(), 1e-9);
  EXPECT_LE((begin.derivative[2] - *present.acceleration).norm(), 1e-9);
  const FlatOutput end = trajectory.evaluate(trajectory.duration());
  for (std::size_t order = 1; order < 4; ++order) {
    EXPECT_LE(end.derivative[order].norm(), 1e-9) << order;
  }
}

TEST(Braking, KeepsTheLimitsAndUsesOne) {
  const Waypoint present = moving({3.0, -2.0, 1.0, 0.4}, {0.5, 0.3, -0.2, 0.0});
  const PolynomialTrajectory trajectory = brakeWithin(present, kLimits);
  expectBrakes(trajectory, present);
  EXPECT_LE(worstUse(trajectory, kLimits, kSteps), 1.0);
  EXPECT_GT(worstUse(trajectory, kLimits, kSteps), 0.9);
}

TEST(Braking, TakesNoMoreThanThePresentMotionBeyondALimit) {
  const Waypoint present = moving({5.0, 0.0, 0.0, 0.0}, {-6.5, 0.0, 0.0, 0.0});
  const PolynomialTrajectory trajectory = brakeWithin(present, {50.0, 6.0, 1.4, 20.0});
  EXPECT_LE(worstUse(trajectory, {50.0, 6.5, 1.4, 20.0}, kSteps), 1.0 + 1e-5);
}

TEST(Braking, StopsWhereLeastSnapLeavesIt) {
  const Waypoint present = moving({3.0, -2.0, 1.0, 0.4}, {0.5, 0.3, -0.2, 0.0});
  const PolynomialTrajectory trajectory = brakeWithin(present, kLimits);
  const double duration = trajectory.duration();
  Waypoint stop;
  stop.position = trajectory.evaluate(duration).derivative[0].head<3>();
  stop.yaw = trajectory.evaluate(duration).derivative[0][3];
  stop.velocity = stop.acceleration = stop.jerk = Eigen::Vector4d::Zero();
  const auto cost = [&](const Waypoint& end) {
    return minimumSnap({present, end}, {duration}, EndDerivatives::kFree).snapCost();
  };
  EXPECT_NEAR(cost(stop), trajectory.snapCost(), 1e-9 * trajectory.snapCost());
  for (const double shift : {-0.01, 0.01}) {
    Waypoint other = stop;
    other.position += Eigen::Vector3d::Constant(shift);
    EXPECT_GT(cost(other), trajectory.snapCost());
  }
}

TEST(Braking, BrakesFromBeyondTheLimits) {
  const Waypoint fast = moving({12.0, 0.0, 0.0, 3.0}, Eigen::Vector4d::Zero());
  const PolynomialTrajectory trajectory = brakeWithin(fast, kLimits);
  expectBrakes(trajectory, fast);
  MotionLimits widened = kLimits;
  widened.speed = 12.0001;
  EXPECT_LE(worstUse(trajectory, widened, kSteps), 1.0) << "the other limits hold all the same";

  const Waypoint falling = moving({0.0, 0.0, -9.0, 0.0}, {1.0, 0.0, -12.0, 0.0});
  expectBrakes(brakeWithin(falling, kLimits), falling);
}

TEST(Braking, BrakesFromAnyMotion) {
  std::mt19937 random(1);
  for (int i = 0; i < 200; ++i) {
    const Waypoint present =
        moving(test::randomVector(random, 20.0), test::randomVector(random, 10.0));
    const PolynomialTrajectory trajectory = brakeWithin(present, kLimits);
    expectBrakes(trajectory, present);
    EXPECT_LT(trajectory.duration(), 60.0);
    const double speed = present.velocity->head<3>().norm();
    const double acceleration = present.acceleration->head<3>().norm();
    const MotionLimits twice{2.0 * std::max(speed, kLimits.speed),
                             2.0 * std::max(acceleration, kLimits.acceleration), 1.5, 20.0};
    EXPECT_LE(worstUse(trajectory, twice, kSteps), 1.3) << i;
  }
}

TEST(Braking, AtRestItStaysThere) {
  const PolynomialTrajectory trajectory = brakeWithin(at(1, 2, 3, 0.5), kLimits);
  EXPECT_EQ(trajectory.duration(), 0.1);
  EXPECT_EQ(trajectory.evaluate(0.1).derivative[0], Eigen::Vector4d(1, 2, 3, 0.5));
}

TEST(Braking, RefusesNumbersThatAreNone) {
  Waypoint present = moving({test::kNan, 0, 0, 0}, Eigen::Vector4d::Zero());
  EXPECT_NE(refusal([&] { brakeWithin(present, kLimits); }).find("the velocity of waypoint 0"),
            std::string::npos);
  EXPECT_EQ(refusal([&] {
              brakeWithin(at(0, 0, 0), {0.0, 6.0, 0.5, 1.6});
            }),
            "the speed limit is 0; it must be finite and > 0 m/s");
}

}  // namespace
}  // namespace aqc
