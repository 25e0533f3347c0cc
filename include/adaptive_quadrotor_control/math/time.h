#pragma once

#include <cmath>
#include <cstdint>

namespace aqc {

/// A time or a duration in whole nanoseconds, as ROS counts it: sums of periods stay exact.
using Nanoseconds = std::int64_t;

/// To the nearest nanosecond. `seconds` must be finite and within 292 years.
inline Nanoseconds fromSeconds(double seconds) {
  return static_cast<Nanoseconds>(std::llround(seconds * 1e9));
}

/// Exact to a nanosecond up to 104 days, to 0.2 us in a count since 1970.
inline double toSeconds(Nanoseconds time) {
  return static_cast<double>(time) / 1e9;
}

/// A clock that goes back further than this was started anew, as when a simulator is reset; less is
/// a message that comes late.
constexpr Nanoseconds kNewStart = 1'000'000'000;

/// Whether a clock that showed `before` and shows `now` was started anew in between.
inline bool startedAnew(Nanoseconds before, Nanoseconds now,
                        Nanoseconds new_start = kNewStart) noexcept {
  return before - now > new_start;
}

}  // namespace aqc
