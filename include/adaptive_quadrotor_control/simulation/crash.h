#pragma once

namespace aqc {

/// Why a flight ended on the ground.
enum class Crash { kNone, kHardImpact, kTiltedContact, kRotorStrike, kWallStrike };

/// "hard impact", ...; never null.
const char* toString(Crash crash);

}  // namespace aqc
