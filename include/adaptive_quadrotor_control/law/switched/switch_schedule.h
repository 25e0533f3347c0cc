#pragma once

#include <optional>
#include <string>
#include <vector>

#include "adaptive_quadrotor_control/law/switched/subsystem_switch.h"
#include "adaptive_quadrotor_control/math/time.h"

namespace aqc {

/// A wish to make `subsystem` (from 1) the active one at the first control step not before `time`.
struct SwitchOrder {
  Nanoseconds time = 0;
  int subsystem = 1;
};

/// What became of an order.
struct SwitchReport {
  SwitchOrder order;
  Nanoseconds time;  ///< of the control step that took it up
  SwitchVerdict verdict;
  Nanoseconds allowed;  ///< the first time, not before `time`, at which a switch is legal now

  /// Whether somebody should hear of it: it was refused, or done against the dwell time.
  bool objected() const noexcept;
};

/// Orders that wait for their time. The offline flight and the nodelet both run this class.
class SwitchSchedule {
 public:
  static constexpr std::uint32_t kMost = 10000;  ///< that may wait

  /// Keeps the order of equal times. False, and nothing is kept, when kMost wait already.
  bool plan(const SwitchOrder& order);

  /// Passes the next order that is due at `now` to `subsystems`, and says what became of it;
  /// nothing when none is due. Allocates nothing.
  std::optional<SwitchReport> next(SubsystemSwitch& subsystems, Nanoseconds now) noexcept;

  std::size_t pending() const noexcept { return orders_.size() - next_; }
  /// Drops what waits, for a clock that starts anew: its times mean nothing there.
  void clear() noexcept;

 private:
  std::vector<SwitchOrder> orders_;  // by time
  std::size_t next_ = 0;             // first one that waits
};

/// "switch to subsystem 3 refused: against the dwell time; the next switch is allowed at 9.37 s".
/// Times are counted from `origin`.
std::string switchObjection(const SwitchReport& report, Nanoseconds origin);
std::string switchObjection(int subsystem, const std::string& outcome, Nanoseconds allowed,
                            Nanoseconds now, Nanoseconds origin);

}  // namespace aqc
