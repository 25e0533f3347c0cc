#include "ros/display/flight_paths.h"

#include <algorithm>
#include <utility>

#include "ros/display/flight_markers.h"
#include "ros/display/marker_parts.h"

namespace aqc {
namespace {

using visualization_msgs::Marker;

// A line of rviz's LINE_LIST, unless its ends are so far apart that something jumped.
void addLine(Marker& marker, const Eigen::Vector3d& from, const Eigen::Vector3d& to,
             const std_msgs::ColorRGBA& begin, const std_msgs::ColorRGBA& end) {
  marker.points.insert(marker.points.end(), {toPoint(from), toPoint(to)});
  marker.colors.insert(marker.colors.end(), {begin, end});
}

}  // namespace

void FlightTrail::add(const Eigen::Vector3d& position, double error) {
  if (!position.allFinite()) return;
  if (!points_.empty() && (position - points_.back().position).norm() < kSpacing) return;
  points_.push_back({position, error});
  if (points_.size() > kMaxPoints) points_.pop_front();
}

Marker FlightTrail::marker() const {
  Marker line = lineMarker(kWorldFrame, "flown", 0, Marker::LINE_LIST, 0.022, colour(1, 1, 1));
  for (std::size_t i = 1; i < points_.size(); ++i) {
    const Point& from = points_[i - 1];
    const Point& to = points_[i];
    if ((to.position - from.position).norm() > kTeleport) continue;
    addLine(line, from.position, to.position, errorColour(from.error), errorColour(to.error));
  }
  return line;
}

void ReferenceTrail::plan(std::vector<TimedSetPoint> set_points) {
  planned_.clear();
  for (TimedSetPoint& timed : set_points) {
    if (planned_.empty() || &timed == &set_points.back() ||
        (timed.set_point.position - planned_.back().set_point.position).norm() >= kSpacing) {
      planned_.push_back(std::move(timed));
    }
  }
}

void ReferenceTrail::add(const Eigen::Vector3d& position, Nanoseconds now) {
  now_ = now;
  if (!past_.empty() && (position - past_.back()).norm() < kSpacing) return;
  past_.push_back(position);
  if (past_.size() > FlightTrail::kMaxPoints) past_.pop_front();
}

void ReferenceTrail::clear() {
  past_.clear();
  planned_.clear();
}

Marker ReferenceTrail::marker() const {
  const std_msgs::ColorRGBA past = colour(0.55, 0.75, 1.0, 0.75);
  const std_msgs::ColorRGBA future = colour(0.55, 0.75, 1.0, 0.32);
  Marker line = lineMarker(kWorldFrame, "reference", 0, Marker::LINE_LIST, 0.014, past);
  for (std::size_t i = 1; i < past_.size(); ++i) addLine(line, past_[i - 1], past_[i], past, past);
  const Eigen::Vector3d* last = past_.empty() ? nullptr : &past_.back();
  for (const TimedSetPoint& timed : planned_) {
    if (timed.time <= now_) continue;
    if (last != nullptr) addLine(line, *last, timed.set_point.position, future, future);
    last = &timed.set_point.position;
  }
  return line;
}

}  // namespace aqc
