#pragma once

#include "adaptive_quadrotor_control/reference/polynomial_trajectory.h"
#include "adaptive_quadrotor_control/reference/time_allocation.h"

namespace aqc {

/// The trajectory that brings `present`, with its velocity and acceleration (absent ones are zero),
/// to rest in the shortest time that keeps the limits (found to 2 %), at least 0.1 s. Where it ends
/// is free; for its duration it has the least integral of squared snap. Yaw comes to rest as well
/// and is not limited.
///
/// It brakes whatever the motion: a limit that the present motion is beyond already is widened to
/// it, and when the limits cannot be kept on the way to rest (an acceleration along a velocity at
/// the limit makes for more speed), they are exceeded by as little as any duration allows.
///
/// Throws std::invalid_argument when a number of the waypoint is not finite, when a limit is not
/// finite or outside the range given in MotionLimits, or when the motion is so extreme that the
/// trajectory overflows.
PolynomialTrajectory brakeWithin(const Waypoint& present, const MotionLimits& limits);

}  // namespace aqc
