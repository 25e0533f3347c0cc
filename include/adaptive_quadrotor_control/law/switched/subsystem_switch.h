#pragma once

#include <string>

#include "adaptive_quadrotor_control/law/switched/dwell_time.h"
#include "adaptive_quadrotor_control/math/time.h"

namespace aqc {

/// What became of a wish to switch.
enum class SwitchOutcome {
  kSwitched,          ///< done, and the dwell time is kept
  kSwitchedTooEarly,  ///< done against the dwell time (policy warn): the theorem no longer holds
  kAlreadyActive,     ///< nothing to do, and nothing counted
  kUnknownSubsystem,  ///< refused: there is no such subsystem
  kTooEarly,          ///< refused: against the dwell time (policy refuse)
};

/// "switched", "refused: too early" and the like.
const char* toString(SwitchOutcome outcome) noexcept;

struct SwitchVerdict {
  SwitchOutcome outcome;
  /// The first time, not before the request, at which this request keeps or would have kept the
  /// dwell time; the time of the request for an unknown or the active subsystem.
  Nanoseconds earliest;

  /// True when the subsystem asked for is the active one now.
  bool accepted() const noexcept {
    return outcome == SwitchOutcome::kSwitched || outcome == SwitchOutcome::kSwitchedTooEarly ||
           outcome == SwitchOutcome::kAlreadyActive;
  }
};

struct SwitchCounts {
  long switched = 0;   ///< switches done, early ones included
  long too_early = 0;  ///< requests against the dwell time, refused or done with a warning
  long unknown = 0;    ///< requests for a subsystem that does not exist
};

/// The switching signal sigma(t) of a switched law: which subsystem is active, who may change it,
/// when. Subsystems count from 1, as in the thesis.
///
/// Nothing here allocates, blocks or throws in flight. A request counts from the next control step.
class SubsystemSwitch {
 public:
  enum class Policy {
    kRefuse,  ///< a switch against the dwell time is not done
    kWarn,    ///< it is done, counted, and the verdict says so
  };

  /// `count` >= 1 subsystems, `initial` in [1, count]. `bound` is what the subsystems' gains ask
  /// for, `monitor` what is enforced. Throws std::invalid_argument.
  SubsystemSwitch(int count, int initial, const DwellTime& bound, const DwellTimeMonitor& monitor,
                  Policy policy);

  int count() const noexcept { return count_; }
  int active() const noexcept { return active_; }

  /// Makes `subsystem` the active one at the time `now`, which must not run backwards.
  SwitchVerdict request(int subsystem, Nanoseconds now) noexcept;
  /// The first time >= `now` at which a switch keeps the dwell time.
  Nanoseconds earliest(Nanoseconds now) const noexcept { return monitor_.earliest(now); }
  /// Back to the initial subsystem; forgets every switch and count. For a clock that starts anew.
  void restart() noexcept;

  /// Goes on from another signal of as many subsystems: the active one, the counts, the memory of
  /// switches.
  void adopt(const SubsystemSwitch& old) noexcept;

  const SwitchCounts& counts() const noexcept { return counts_; }
  /// Requests that were refused, or done against the dwell time.
  long objections() const noexcept { return counts_.too_early + counts_.unknown; }
  Policy policy() const noexcept { return policy_; }
  /// mu, varrho, kappa and theta* of the gains.
  const DwellTime& bound() const noexcept { return bound_; }
  /// What is asked for and what is enforced, on one line.
  std::string text() const;
  /// Enforced dwell time and N_0.
  const DwellTimeMonitor& monitor() const noexcept { return monitor_; }

 private:
  int count_;
  int initial_;
  int active_;
  DwellTime bound_;
  DwellTimeMonitor monitor_;
  Policy policy_;
  SwitchCounts counts_;
};

}  // namespace aqc
