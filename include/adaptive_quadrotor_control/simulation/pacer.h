#pragma once

#include "adaptive_quadrotor_control/math/time.h"

namespace aqc {

/// When a simulated plant that talks to others moves on: with real time, or in lock step with the
/// commands that answer it. Paused, it does neither.
///
/// There is no clock in it: `wall` is what a steady clock shows, `plant` what the plant's does.
class Pacer {
 public:
  /// Without an answer for this long odometry is sent again: a controller that (re)starts needs it.
  static constexpr Nanoseconds kRepeatAfter = 200'000'000;  // wall
  /// A real-time run that fell behind further gives the time up rather than racing after it.
  static constexpr Nanoseconds kLongestBacklog = 200'000'000;  // wall

  struct Pace {
    Nanoseconds period = 0;         ///< of the control, > 0
    double real_time_factor = 1.0;  ///< simulated time / wall time, > 0; not in lock step
    bool lock_step = false;         ///< a period passes for every command that answers
    bool paused = false;            ///< until resume()
  };

  Pacer(const Pace& pace, Nanoseconds wall, Nanoseconds plant);

  /// How many periods the plant shall advance now; 0 in lock step, or paused.
  int due(Nanoseconds wall, Nanoseconds plant) noexcept;
  /// Whether a command stamped `stamp` is to be used: in lock step only the one that answers the
  /// plant's present time, which then advances by a period.
  bool takes(Nanoseconds stamp, Nanoseconds plant) const noexcept;
  /// Whether what was published last shall be published once more.
  bool repeats(Nanoseconds wall) const noexcept;
  /// How often due() and repeats() want to be asked [ns], wall.
  Nanoseconds interval() const noexcept;

  void published(Nanoseconds wall) noexcept { last_published_ = wall; }
  /// The plant begins anew, or goes on, from here.
  void restart(Nanoseconds wall, Nanoseconds plant) noexcept;
  /// Ends the pause; false when there was none.
  bool resume(Nanoseconds wall, Nanoseconds plant) noexcept;

  bool paused() const noexcept { return pace_.paused; }
  bool lockStep() const noexcept { return pace_.lock_step; }

 private:
  Pace pace_;
  Nanoseconds last_published_;
  Nanoseconds wall_start_;   // of the real-time run, and
  Nanoseconds plant_start_;  // what the plant's clock read then
};

}  // namespace aqc
