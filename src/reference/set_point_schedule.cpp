#include "adaptive_quadrotor_control/reference/set_point_schedule.h"

#include <algorithm>
#include <stdexcept>
#include <string>
#include <utility>

namespace aqc {

SetPointSchedule::SetPointSchedule(std::vector<TimedSetPoint> set_points)
    : set_points_(std::move(set_points)) {
  for (std::size_t i = 1; i < set_points_.size(); ++i) {
    if (set_points_[i].time < set_points_[i - 1].time) {
      throw std::invalid_argument(
          "set point " + std::to_string(i) + " is at " +
          std::to_string(toSeconds(set_points_[i].time)) + " s, before the one in front of it (" +
          std::to_string(toSeconds(set_points_[i - 1].time)) + " s); times must not decrease");
    }
  }
}

const SetPoint* SetPointSchedule::at(Nanoseconds now) noexcept {
  while (next_ < set_points_.size() && set_points_[next_].time <= now) ++next_;
  return next_ == 0 ? nullptr : &set_points_[next_ - 1].set_point;
}

void SetPointSchedule::replace(Nanoseconds now, std::vector<TimedSetPoint> set_points) {
  if (const SetPoint* holding = at(now)) {
    // The new plan may begin in the past; what is overdue there takes over at once.
    if (set_points.empty() || set_points.front().time > now) {
      set_points.insert(set_points.begin(), TimedSetPoint{now, *holding});
    }
  }
  *this = SetPointSchedule(std::move(set_points));
}

std::size_t SetPointSchedule::pending() const noexcept {
  return set_points_.size() - next_;
}

}  // namespace aqc
