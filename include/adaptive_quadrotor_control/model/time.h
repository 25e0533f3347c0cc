#pragma once

#include <cmath>
#include <cstdint>

namespace aqc {

/// A time or a duration in whole nanoseconds, as ROS counts it: sums of periods stay exact.
using Nanoseconds = std::int64_t;

inline Nanoseconds fromSeconds(double seconds) {
  return static_cast<Nanoseconds>(std::llround(seconds * 1e9));
}

inline double toSeconds(Nanoseconds time) {
  return static_cast<double>(time) / 1e9;
}

}  // namespace aqc
