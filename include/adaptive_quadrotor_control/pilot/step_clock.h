#pragma once

#include <optional>

#include "adaptive_quadrotor_control/math/time.h"

namespace aqc {

/// When a clock counts as started anew.
struct ClockLimits {
  Nanoseconds new_start = kNewStart;  ///< it goes back by more than this [ns]
  int confirmations = 10;             ///< and so many stamps in a row say so
};

/// Decides when a controller that is fed by messages makes a step, and how long a step it is.
///
/// There is no clock in it: time is what the stamps of the messages and the caller say. Nothing but
/// the constructor throws or allocates.
class StepClock {
 public:
  enum class Trigger {
    kTimer,     ///< the caller's timer makes the steps, on the latest odometry
    kOdometry,  ///< odometry that is due makes a step, and all odometry gets a command for an
                ///< answer
  };

  /// What odometry calls for.
  enum class Answer {
    kDrop,     ///< nothing, and it must not be used: its stamp goes back
    kRestart,  ///< forget all that was planned and learned, then let it be heard again: the clock
               ///< was started anew
    kNone,     ///< nothing yet: the timer will use it
    kRepeat,   ///< the last command again
    kWait,     ///< a step when the IMU sample of its time arrives: see waiting()
    kStep,     ///< a step now
  };

  /// `period` [ns] is that of the steps; throws std::invalid_argument unless it is > 0.
  StepClock(Nanoseconds period, Trigger trigger, const ClockLimits& limits = {});

  /// What to do about odometry stamped `stamp`. `imu_awaited` says whether an IMU sample of that
  /// time is expected and has not arrived.
  ///
  /// With kOdometry a step is due one period after the last one. Odometry that comes earlier, or
  /// once more with the stamp of the last step, gets the last command; while nothing flies, the
  /// same stamp makes a step again, since a set point may have come. Only one odometry waits for
  /// the IMU: the next one that is due makes the step without it.
  ///
  /// With kTimer only the same stamp again makes a step, while nothing flies: a paused simulation
  /// repeats its odometry with its clock, and so the timer, standing still.
  ///
  /// Stamps that go back so far that their clock was started anew are dropped until as many as
  /// the limits ask for came in a row, none behind the one before: a flight must not end because of
  /// one message with a wrong stamp, or a second source of another time. The last of them gets
  /// kRestart; nothing of the old time is left then, and any stamp is the first.
  Answer hear(Nanoseconds stamp, bool imu_awaited) noexcept;

  /// Begins a step at `now`, which ends the waiting; `flying` tells whether it has a set point.
  /// Returns the time [s] that the law may count since the step before: one period with kTimer;
  /// with kOdometry what has passed, but at least one period and at most two, lest odometry that
  /// pauses make one huge step of the adaptive laws.
  double begin(Nanoseconds now, bool flying) noexcept;

  /// Whether odometry waits for its IMU sample; whoever gets that one makes the step.
  bool waiting() const noexcept { return waiting_; }
  /// Stamp of the last odometry that was not dropped; 0 before the first.
  Nanoseconds odometryTime() const noexcept { return odometry_time_.value_or(0); }
  /// Of the last step; 0 before the first.
  Nanoseconds stepTime() const noexcept { return last_step_.value_or(0); }
  Nanoseconds period() const noexcept { return period_; }
  Trigger trigger() const noexcept { return trigger_; }

 private:
  Nanoseconds period_;
  Trigger trigger_;
  ClockLimits limits_;
  std::optional<Nanoseconds> odometry_time_;
  std::optional<Nanoseconds> last_step_;
  Nanoseconds new_time_ = 0;  // the last stamp of a clock that may have been started anew
  int confirmed_ = 0;         // how many such stamps came in a row
  bool flying_ = false;       // in the last step
  bool waiting_ = false;      // for the IMU sample that goes with the odometry
};

}  // namespace aqc
