#include "reference/argument_checks.h"

#include <Eigen/Core>
#include <cmath>
#include <optional>

#include "reference/invalid_argument.h"

namespace aqc {
namespace {

void requireFinite(const std::optional<Eigen::Vector4d>& derivative, const char* name,
                   std::size_t index) {
  if (derivative && !derivative->allFinite()) {
    throwInvalidArgument("the ", name, " of waypoint ", index, " is (", derivative->transpose(),
                         "); all four numbers must be finite");
  }
}

}  // namespace

void requireWaypoints(const std::vector<Waypoint>& waypoints) {
  if (waypoints.empty()) throwInvalidArgument("there is no waypoint; there must be at least 1");
  for (std::size_t i = 0; i < waypoints.size(); ++i) {
    const Waypoint& waypoint = waypoints[i];
    if (!waypoint.position.allFinite()) {
      throwInvalidArgument("the position of waypoint ", i, " is (", waypoint.position.transpose(),
                           ") m; all three numbers must be finite");
    }
    if (!std::isfinite(waypoint.yaw)) {
      throwInvalidArgument("the yaw of waypoint ", i, " is ", waypoint.yaw,
                           " rad; it must be finite");
    }
    requireFinite(waypoint.velocity, "velocity", i);
    requireFinite(waypoint.acceleration, "acceleration", i);
    requireFinite(waypoint.jerk, "jerk", i);
  }
}

void requireDurations(const std::vector<double>& segment_durations, std::size_t point_count,
                      const char* points) {
  if (segment_durations.size() + 1 != point_count) {
    throwInvalidArgument("there are ", segment_durations.size(), " segment durations for ",
                         point_count, " ", points, "; there must be ", point_count - 1);
  }
  for (std::size_t i = 0; i < segment_durations.size(); ++i) {
    if (!std::isfinite(segment_durations[i]) || segment_durations[i] < kShortestSegment) {
      throwInvalidArgument("segment duration ", i, " is ", segment_durations[i],
                           " s; it must be finite and >= ", kShortestSegment, " s");
    }
  }
}

}  // namespace aqc
