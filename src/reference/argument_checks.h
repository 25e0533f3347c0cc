#pragma once

#include <cstddef>
#include <vector>

#include "adaptive_quadrotor_control/reference/minimum_snap.h"

namespace aqc {

/// Throws std::invalid_argument unless there is a waypoint and all numbers of all are finite.
void requireWaypoints(const std::vector<Waypoint>& waypoints);

/// Throws std::invalid_argument unless there is one duration less than points (named `points` in
/// the message) and all are finite and >= kShortestSegment.
void requireDurations(const std::vector<double>& segment_durations, std::size_t point_count,
                      const char* points);

}  // namespace aqc
