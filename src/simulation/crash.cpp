#include "adaptive_quadrotor_control/simulation/crash.h"

namespace aqc {

const char* toString(Crash crash) {
  switch (crash) {
    case Crash::kNone:
      return "none";
    case Crash::kHardImpact:
      return "hard impact";
    case Crash::kTiltedContact:
      return "tilted contact";
    case Crash::kRotorStrike:
      return "rotor strike";
    case Crash::kWallStrike:
      return "wall strike";
    case Crash::kDiverged:
      return "diverged: beyond 1e4 m/s or 1e4 rad/s or 1e6 m";
  }
  return "unknown";
}

}  // namespace aqc
