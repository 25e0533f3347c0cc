#pragma once

#include <array>

namespace aqc {

/// Why the guard did what it did last. The order is that of the table.
enum class Rule {
  kNone,
  kOperator,
  kAutoArm,
  kAirborne,
  kTakenOff,
  kSetPoint,
  kSetPointOld,
  kOdometryLate,
  kOdometryLost,
  kOdometryBack,
  kSourceReset,
  kClockStep,
  kNotFollowing,
  kOverload,
  kSaturation,
  kLawNotFinite,
  kRotorLoss,
  kNoLiftOff,
  kTouchDown,
  kTipped,
  kTumble,
  kBlindEnd,
};

/// One line of the guard's table.
struct RuleText {
  Rule rule;
  const char* name;      ///< a word, for messages
  const char* check;     ///< what is looked at, with its limit by name (see GuardLimits)
  const char* reaction;  ///< what is done
};

/// All rules, in the order of Rule: the table of docs/guard.md.
const std::array<RuleText, 22>& guardRules() noexcept;

/// Never null.
inline const RuleText& textOf(Rule rule) noexcept {
  return guardRules()[static_cast<std::size_t>(rule)];
}

}  // namespace aqc
