#pragma once

#include <vector>

#include "adaptive_quadrotor_control/pilot/guard_limits.h"
#include "adaptive_quadrotor_control/reference/set_point_schedule.h"

namespace aqc {

/// Throws std::invalid_argument, with its place in the list, for a set point that is not valid().
void requireValid(const std::vector<TimedSetPoint>& set_points);

/// Throws std::invalid_argument, with the value and what is allowed, for valid set points that
/// a guard does not even plan at `now`: their message's `stamp` (0: none) is older than `oldest`
/// [ns], they begin too far ahead, or one of them is out of bounds (GuardLimits::set_point_bound).
void requireSafe(const std::vector<TimedSetPoint>& set_points, Nanoseconds now, Nanoseconds stamp,
                 Nanoseconds oldest, const GuardLimits& limits);

}  // namespace aqc
