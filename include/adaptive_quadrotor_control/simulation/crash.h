#pragma once

namespace aqc {

/// Why a flight ended on the ground.
enum class Crash {
  kNone,
  kHardImpact,
  kTiltedContact,
  kRotorStrike,
  kWallStrike,
  kDiverged,  ///< no flight can go on from such numbers: not finite, or absurdly large
};

/// "hard impact", ...; never null and without a comma.
const char* toString(Crash crash);

}  // namespace aqc
