#include "adaptive_quadrotor_control/pilot/imu_monitor.h"

namespace aqc {

// Whether a sample that is older than the one before is of a clock that was set back.
bool ImuMonitor::wasSetBack(Nanoseconds time) noexcept {
  late_ = late_ > 0 && time >= late_time_ ? late_ + 1 : 1;
  late_time_ = time;
  return late_ >= kConfirmations;
}

bool ImuMonitor::take(const Eigen::Vector3d& specific_force, Nanoseconds time,
                      const std::optional<Eigen::Vector3d>& body_rate) noexcept {
  const bool late = started_ && time < time_ && !startedAnew(time_, time, new_start_);
  if (!specific_force.allFinite() || (late && !wasSetBack(time))) {
    ++dropped_;
    return false;
  }
  late_ = 0;
  specific_force_ = specific_force;
  body_rate_ = body_rate;
  if (body_rate_ && !body_rate_->allFinite()) body_rate_.reset();
  time_ = time;
  started_ = true;
  return true;
}

const Eigen::Vector3d* ImuMonitor::at(Nanoseconds now) noexcept {
  const bool usable = started_ && now - time_ <= oldest_ && !startedAnew(time_, now, new_start_);
  if (usable_ && !usable) ++losses_;
  usable_ = usable;
  return usable ? &specific_force_ : nullptr;
}

}  // namespace aqc
