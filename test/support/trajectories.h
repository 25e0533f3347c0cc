#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include "adaptive_quadrotor_control/model/state.h"
#include "adaptive_quadrotor_control/reference/minimum_snap.h"
#include "adaptive_quadrotor_control/reference/time_allocation.h"

/// What the tests of trajectories share.
namespace aqc::test {

constexpr double kInf = std::numeric_limits<double>::infinity();
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

inline Waypoint at(double x, double y, double z, double yaw = 0.0) {
  Waypoint waypoint;
  waypoint.position = {x, y, z};
  waypoint.yaw = yaw;
  return waypoint;
}

inline Waypoint randomWaypoint(std::mt19937& random) {
  std::uniform_real_distribution<double> coordinate(-10.0, 10.0);
  std::uniform_real_distribution<double> angle(-1.5, 1.5);
  return at(coordinate(random), coordinate(random), coordinate(random), angle(random));
}

inline Eigen::Vector4d randomVector(std::mt19937& random, double size) {
  std::uniform_real_distribution<double> number(-size, size);
  return {number(random), number(random), number(random), number(random)};
}

inline PolynomialTrajectory exampleTrajectory() {
  return minimumSnap({at(0, 0, 1), at(3, 1, 2, 1), at(2, 4, 3, 2), at(-1, 2, 1, 3)},
                     {1.2, 0.8, 2.0});
}

/// The largest ratio of demand to limit on a grid of `steps` steps.
inline double worstUse(const PolynomialTrajectory& trajectory, const MotionLimits& limits,
                       int steps) {
  double worst = 0.0;
  for (int i = 0; i <= steps; ++i) {
    const FlatOutput output = trajectory.evaluate(trajectory.duration() * i / steps);
    const Eigen::Vector3d acceleration = output.derivative[2].head<3>();
    const Eigen::Vector3d thrust = acceleration + kGravity * Eigen::Vector3d::UnitZ();
    worst = std::max({worst, output.derivative[1].head<3>().norm() / limits.speed,
                      acceleration.norm() / limits.acceleration,
                      thrust.norm() / kGravity / limits.thrust_to_weight,
                      std::atan2(thrust.head<2>().norm(), thrust.z()) / limits.tilt});
  }
  return worst;
}

}  // namespace aqc::test
