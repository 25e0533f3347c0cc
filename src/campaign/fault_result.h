#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "adaptive_quadrotor_control/law/control_law.h"
#include "adaptive_quadrotor_control/pilot/guard_rules.h"
#include "adaptive_quadrotor_control/pilot/pilot_limits.h"
#include "campaign/fault_flight.h"

namespace aqc {

class ClosedLoop;

enum class Verdict {
  kLanded,  ///< disarmed and upright on the ground
  kHeld,    ///< in the air, at rest
  kHard,    ///< landed, but touched down faster than kHardTouchDown
  kLost,    ///< all else
  kForced,  ///< hard or lost where physics left no choice: see kAftermath
};

constexpr double kHardTouchDown = 1.5;  ///< [m/s]
/// Physics left no choice where no hover was possible (see Hover) within so long before the
/// vehicle was lost or touched down hard, in the air, and the rotors stand still in the end [s].
constexpr double kAftermath = 3.0;

/// "landed", ...; never null.
const char* toString(Verdict verdict) noexcept;

/// How a fault flight ended.
struct FaultResult {
  std::uint64_t seed = 0;
  std::vector<FaultKind> faults;
  Verdict verdict = Verdict::kLost;
  std::string reason;       ///< why it is lost, or would be if it were not forced; else empty
  double impact = 0.0;      ///< fastest touch-down [m/s], >= 0
  double astray = 0.0;      ///< furthest outside the box of start and goals [m], >= 0
  double duration = 0.0;    ///< [s]
  std::vector<Rule> rules;  ///< of the guard, in the order in which each acted first
};

/// Told after every step; for who wants to watch.
using FlightWatcher = std::function<void(const ClosedLoop&)>;

/// Flies it to its end, or until it is down and disarmed. `limits` must have a guard.
FaultResult flyFaults(const FaultFlight& flight, const Vehicle& vehicle,
                      std::unique_ptr<ControlLaw> law, const PilotLimits& limits,
                      const FlightWatcher& watch = {});

}  // namespace aqc
