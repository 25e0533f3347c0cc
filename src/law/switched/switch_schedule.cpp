#include "adaptive_quadrotor_control/law/switched/switch_schedule.h"

#include <algorithm>
#include <sstream>

namespace aqc {

bool SwitchReport::objected() const noexcept {
  return !verdict.accepted() || verdict.outcome == SwitchOutcome::kSwitchedTooEarly;
}

bool SwitchSchedule::plan(const SwitchOrder& order) {
  if (pending() >= kMost) return false;
  orders_.erase(orders_.begin(), orders_.begin() + static_cast<std::ptrdiff_t>(next_));
  next_ = 0;
  const auto later = [](const SwitchOrder& a, const SwitchOrder& b) { return a.time < b.time; };
  orders_.insert(std::upper_bound(orders_.begin(), orders_.end(), order, later), order);
  return true;
}

std::optional<SwitchReport> SwitchSchedule::next(SubsystemSwitch& subsystems,
                                                 Nanoseconds now) noexcept {
  if (next_ == orders_.size() || orders_[next_].time > now) return std::nullopt;
  const SwitchOrder order = orders_[next_++];
  const SwitchVerdict verdict = subsystems.request(order.subsystem, now);
  return SwitchReport{order, now, verdict, subsystems.earliest(now)};
}

void SwitchSchedule::clear() noexcept {
  orders_.clear();
  next_ = 0;
}

std::string switchObjection(const SwitchReport& report, Nanoseconds origin) {
  return switchObjection(report.order.subsystem, toString(report.verdict.outcome), report.allowed,
                         report.time, origin);
}

std::string switchObjection(int subsystem, const std::string& outcome, Nanoseconds allowed,
                            Nanoseconds now, Nanoseconds origin) {
  std::ostringstream out;
  out << "switch to subsystem " << subsystem << " " << outcome;
  if (allowed > now) {
    out.precision(12);
    out << "; the next switch is allowed at " << toSeconds(allowed - origin) << " s";
  }
  return out.str();
}

}  // namespace aqc
