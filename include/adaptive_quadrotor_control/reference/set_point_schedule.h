#pragma once

#include <vector>

#include "adaptive_quadrotor_control/math/time.h"
#include "adaptive_quadrotor_control/reference/set_point.h"

namespace aqc {

/// A set point and the time at which it begins to hold.
struct TimedSetPoint {
  Nanoseconds time = 0;
  SetPoint set_point;
};

/// Set points that take turns: each holds from its own time until the next one's, the last for
/// ever (the meaning RotorS gives to MultiDOFJointTrajectory).
class SetPointSchedule {
 public:
  SetPointSchedule() = default;
  /// Times must not decrease; throws std::invalid_argument otherwise. Of several at one time the
  /// last one holds.
  explicit SetPointSchedule(std::vector<TimedSetPoint> set_points);

  /// The set point that holds at `now`, or null before the first one's time; it is there until the
  /// next replace(). `now` must not go back between calls; amortised constant time, no allocation.
  const SetPoint* at(Nanoseconds now) noexcept;

  /// Replaces everything planned after `now` by `set_points`. What holds at `now` goes on holding
  /// until the first of them begins. Throws std::invalid_argument, and changes nothing, when their
  /// times decrease.
  void replace(Nanoseconds now, std::vector<TimedSetPoint> set_points);

  /// Set points that have not begun yet.
  std::size_t pending() const noexcept;

 private:
  std::vector<TimedSetPoint> set_points_;
  std::size_t next_ = 0;  // first one that has not begun
};

}  // namespace aqc
