#pragma once

namespace aqc {

/// What a guarded pilot is doing.
enum class Mode {
  kDisarmed,    ///< the rotors stand still
  kArmed,       ///< they idle
  kTakingOff,   ///< straight up from where it stood
  kFlying,      ///< what was planned
  kHolding,     ///< at a place of the guard's
  kLanding,     ///< straight down
  kDescending,  ///< without odometry
  kKilled,      ///< disarmed for ever
};

/// "disarmed", ...; never null.
const char* toString(Mode mode) noexcept;

}  // namespace aqc
