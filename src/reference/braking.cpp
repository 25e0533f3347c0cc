#include "adaptive_quadrotor_control/reference/braking.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "adaptive_quadrotor_control/math/constants.h"
#include "reference/argument_checks.h"

namespace aqc {
namespace {

// Room for rounding where a limit is exactly the present motion.
constexpr double kMargin = 1.0 + 1e-6;

// From the present motion to rest within `duration`. With the end and the first jerk free, least
// snap means that the snap begins with zero and that position is of degree six: both follow.
PolynomialTrajectory brakeFor(double duration, const KnotState& present) {
  const Eigen::Vector4d velocity = present.col(1);
  const Eigen::Vector4d acceleration = present.col(2);
  KnotState start = present;
  start.col(3) = -(20.0 / 3.0 * velocity / duration + 4.0 * acceleration) / duration;
  KnotState end = KnotState::Zero();
  end.col(0) = start.col(0) + duration * (4.0 / 9.0 * velocity + duration / 15.0 * acceleration);
  return PolynomialTrajectory({start, end}, {duration});
}

// The limits, each at least what the present motion takes already.
MotionLimits widened(MotionLimits limits, const KnotState& present) {
  // Thrust that points down has no tilt below a right angle.
  constexpr double kSteepest = 0.999 * M_PI / 2.0;
  const Eigen::Vector3d acceleration = present.col(2).head<3>();
  const Eigen::Vector3d thrust = acceleration + kGravity * Eigen::Vector3d::UnitZ();
  const double tilt = std::atan2(thrust.head<2>().norm(), thrust.z());
  limits.speed = std::max(limits.speed, kMargin * present.col(1).head<3>().norm());
  limits.acceleration = std::max(limits.acceleration, kMargin * acceleration.norm());
  limits.tilt = std::max(limits.tilt, std::min(kMargin * tilt, kSteepest));
  limits.thrust_to_weight = std::max(limits.thrust_to_weight, kMargin * thrust.norm() / kGravity);
  return limits;
}

}  // namespace

PolynomialTrajectory brakeWithin(const Waypoint& present, const MotionLimits& limits) {
  constexpr double kShortest = 0.1;  // [s]
  constexpr double kLongest = 1e4;   // [s]
  constexpr double kGrowth = 1.02;
  requireWaypoints({present});
  const Eigen::Vector4d none = Eigen::Vector4d::Zero();
  KnotState state = KnotState::Zero();
  state.col(0) << present.position, present.yaw;
  state.col(1) = present.velocity.value_or(none);
  state.col(2) = present.acceleration.value_or(none);

  PolynomialTrajectory best = brakeFor(kShortest, state);
  requiredStretch(best, limits);  // refuses limits that are none
  const MotionLimits allowed = widened(limits, state);
  double least = requiredStretch(best, allowed);
  for (double duration = kShortest * kGrowth; least > 1.0 && duration < kLongest;
       duration *= kGrowth) {
    PolynomialTrajectory longer = brakeFor(duration, state);
    const double required = requiredStretch(longer, allowed);
    if (required < least) {
      least = required;
      best = std::move(longer);
    }
  }
  return best;
}

}  // namespace aqc
