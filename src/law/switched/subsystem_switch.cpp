#include "adaptive_quadrotor_control/law/switched/subsystem_switch.h"

#include <sstream>
#include <stdexcept>

namespace aqc {

const char* toString(SwitchOutcome outcome) noexcept {
  switch (outcome) {
    case SwitchOutcome::kSwitched:
      return "switched";
    case SwitchOutcome::kSwitchedTooEarly:
      return "switched against the dwell time";
    case SwitchOutcome::kAlreadyActive:
      return "already active";
    case SwitchOutcome::kUnknownSubsystem:
      return "refused: no such subsystem";
    case SwitchOutcome::kTooEarly:
      return "refused: against the dwell time";
  }
  return "unknown";
}

SubsystemSwitch::SubsystemSwitch(int count, int initial, const DwellTime& bound,
                                 const DwellTimeMonitor& monitor, Policy policy)
    : count_(count),
      initial_(initial),
      active_(initial),
      bound_(bound),
      monitor_(monitor),
      policy_(policy) {
  if (count < 1 || initial < 1 || initial > count) {
    throw std::invalid_argument("the initial subsystem is " + std::to_string(initial) +
                                "; it must be >= 1 and <= " + std::to_string(count) +
                                ", the number of subsystems");
  }
}

SwitchVerdict SubsystemSwitch::request(int subsystem, Nanoseconds now) noexcept {
  if (subsystem < 1 || subsystem > count_) {
    ++counts_.unknown;
    return {SwitchOutcome::kUnknownSubsystem, now};
  }
  if (subsystem == active_) return {SwitchOutcome::kAlreadyActive, now};

  const Nanoseconds earliest = monitor_.earliest(now);
  const bool early = earliest > now;
  if (early) ++counts_.too_early;
  if (early && policy_ == Policy::kRefuse) return {SwitchOutcome::kTooEarly, earliest};

  monitor_.record(now);
  ++counts_.switched;
  active_ = subsystem;
  return {early ? SwitchOutcome::kSwitchedTooEarly : SwitchOutcome::kSwitched, earliest};
}

std::string SubsystemSwitch::text() const {
  std::ostringstream out;
  out << bound_.text() << "; enforced: " << toSeconds(monitor_.dwellTime())
      << " s, N_0 = " << monitor_.chatterBound() << ", policy "
      << (policy_ == Policy::kRefuse ? "refuse" : "warn");
  return out.str();
}

void SubsystemSwitch::adopt(const SubsystemSwitch& old) noexcept {
  active_ = old.active_;
  counts_ = old.counts_;
  monitor_.adopt(old.monitor_);
}

void SubsystemSwitch::restart() noexcept {
  active_ = initial_;
  monitor_.reset();
  counts_ = {};
}

}  // namespace aqc
