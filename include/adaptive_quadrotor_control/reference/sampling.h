#pragma once

#include <vector>

#include "adaptive_quadrotor_control/reference/polynomial_trajectory.h"
#include "adaptive_quadrotor_control/reference/set_point_schedule.h"

namespace aqc {

/// The set point of one instant of a trajectory: position to jerk, yaw to its acceleration.
SetPoint toSetPoint(const FlatOutput& output);

/// The most set points that all legs of a mission may have together: nearly three hours at 100 Hz,
/// about 100 MB.
constexpr long kMostSetPoints = 1'000'000;

/// Throws std::invalid_argument unless the period is > 0 [ns] and set points for `duration`
/// seconds, one every `period`, are at most `most`.
void requireFewSetPoints(double duration, Nanoseconds period, long most = kMostSetPoints);

/// A trajectory that begins at `begin` as set points, one every `period` and one at its end. Throws
/// std::invalid_argument as requireFewSetPoints() does.
std::vector<TimedSetPoint> sample(const PolynomialTrajectory& trajectory, Nanoseconds begin,
                                  Nanoseconds period, long most = kMostSetPoints);

}  // namespace aqc
