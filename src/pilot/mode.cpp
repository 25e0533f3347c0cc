#include "adaptive_quadrotor_control/pilot/mode.h"

namespace aqc {

const char* toString(Mode mode) noexcept {
  switch (mode) {
    case Mode::kDisarmed:
      return "disarmed";
    case Mode::kArmed:
      return "armed";
    case Mode::kTakingOff:
      return "taking off";
    case Mode::kFlying:
      return "flying";
    case Mode::kHolding:
      return "holding";
    case Mode::kLanding:
      return "landing";
    case Mode::kDescending:
      return "emergency descent";
    case Mode::kKilled:
      return "killed";
  }
  return "?";
}

}  // namespace aqc
