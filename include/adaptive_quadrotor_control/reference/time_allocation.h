#pragma once

#include <vector>

#include "adaptive_quadrotor_control/reference/minimum_snap.h"
#include "adaptive_quadrotor_control/reference/polynomial_trajectory.h"

namespace aqc {

/// What the vehicle may do along a trajectory. With acceleration a, gravity g = 9.81 m/s^2 and the
/// upward unit vector e3, the thrust per mass that the motion takes is a + g e3 (no drag).
struct MotionLimits {
  double speed;             ///< largest norm of the velocity [m/s], > 0
  double acceleration;      ///< largest norm of the acceleration, gravity not counted [m/s^2], > 0
  double tilt;              ///< largest angle between a + g e3 and e3 [rad], in (0, pi/2)
  double thrust_to_weight;  ///< largest |a + g e3| / g, > 1
};

/// A first guess at the duration of every segment (s): what a flight from rest to rest in a
/// straight line takes within the limits, but at least 0.1 s, which is also what coincident
/// waypoints get. Yaw and fixed derivatives are not considered.
///
/// Throws std::invalid_argument when there is no waypoint, when a number of a waypoint is not
/// finite, or when a limit is not finite or outside the range given in MotionLimits.
std::vector<double> estimateDurations(const std::vector<Waypoint>& waypoints,
                                      const MotionLimits& limits);

/// The smallest factor by which the trajectory must be stretched, PolynomialTrajectory::stretched,
/// for all limits to hold from start to end. They hold as it is if the factor is <= 1. Zero for a
/// trajectory without motion. Found by sampling each segment and refining every peak; accurate to
/// about 1e-6. Throws std::invalid_argument for limits as estimateDurations does.
double requiredStretch(const PolynomialTrajectory& trajectory, const MotionLimits& limits);

/// The minimum-snap trajectory whose durations are those of estimateDurations times the smallest
/// common factor (larger or smaller than one) with which all limits hold from start to end. The
/// factor is not made so small that the longest segment lasts less than 0.1 s. Yaw is not limited.
///
/// With all fixed derivatives zero the factor follows from scaling alone. Otherwise scaling would
/// change them, so the trajectory is computed anew for factors that grow by 10 % until one keeps
/// the limits, and that one is refined to 0.1 %. Here longer is not always better (a fixed
/// acceleration held for long makes for high speed), so that there may be no such factor.
///
/// Throws std::invalid_argument as minimumSnap and estimateDurations do, when a fixed velocity or
/// acceleration is itself beyond a limit, and when no factor up to 1000 is found.
PolynomialTrajectory minimumSnapWithin(const std::vector<Waypoint>& waypoints,
                                       const MotionLimits& limits,
                                       EndDerivatives ends = EndDerivatives::kRest);

}  // namespace aqc
