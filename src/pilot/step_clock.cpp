#include "adaptive_quadrotor_control/pilot/step_clock.h"

#include <algorithm>
#include <stdexcept>
#include <string>

namespace aqc {

StepClock::StepClock(Nanoseconds period, Trigger trigger, const ClockLimits& limits)
    : period_(period), trigger_(trigger), limits_(limits) {
  if (period <= 0) {
    throw std::invalid_argument("the control period is " + std::to_string(period) +
                                " ns; it must be > 0");
  }
}

StepClock::Answer StepClock::hear(Nanoseconds stamp, bool imu_awaited) noexcept {
  if (odometry_time_ && startedAnew(*odometry_time_, stamp, limits_.new_start)) {
    confirmed_ = confirmed_ > 0 && stamp >= new_time_ ? confirmed_ + 1 : 1;
    new_time_ = stamp;
    if (confirmed_ < limits_.confirmations) return Answer::kDrop;
    *this = StepClock(period_, trigger_, limits_);
    return Answer::kRestart;
  }
  confirmed_ = 0;
  if (odometry_time_ && stamp < *odometry_time_) return Answer::kDrop;
  const bool again = odometry_time_ && stamp == *odometry_time_;
  odometry_time_ = stamp;
  if (trigger_ == Trigger::kTimer) return again && !flying_ ? Answer::kStep : Answer::kNone;

  const bool repeated = last_step_ && stamp == *last_step_ && flying_;
  const bool early = last_step_ && stamp > *last_step_ && stamp < *last_step_ + period_;
  if (repeated || early) return Answer::kRepeat;
  // Which of the two connections delivers first is chance. Whoever asks again gets an answer: the
  // IMU may have fallen silent.
  waiting_ = imu_awaited && !waiting_;
  return waiting_ ? Answer::kWait : Answer::kStep;
}

double StepClock::begin(Nanoseconds now, bool flying) noexcept {
  const Nanoseconds elapsed = last_step_ ? now - *last_step_ : period_;
  last_step_ = now;
  flying_ = flying;
  waiting_ = false;
  if (trigger_ == Trigger::kTimer) return toSeconds(period_);
  return toSeconds(std::clamp(elapsed, period_, 2 * period_));
}

}  // namespace aqc
