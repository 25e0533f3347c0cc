#pragma once

#include <vector>

#include "adaptive_quadrotor_control/reference/polynomial_trajectory.h"
#include "adaptive_quadrotor_control/reference/set_point_schedule.h"

namespace aqc {

/// The set point of one instant of a trajectory: position to acceleration, yaw and its rate.
SetPoint toSetPoint(const FlatOutput& output);

/// A trajectory that begins at `begin` as set points, one every `period` (> 0) and one at its end.
std::vector<TimedSetPoint> sample(const PolynomialTrajectory& trajectory, Nanoseconds begin,
                                  Nanoseconds period);

}  // namespace aqc
