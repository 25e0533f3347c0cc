#pragma once

#include "adaptive_quadrotor_control/parameters/schema.h"

namespace aqc {

/// Where something may be or go to, in each axis of W [m]: within 100 km. Whoever flies farther
/// away leaves the flat world of this simulation.
inline const Range kPlace = Range::between(-1e5, 1e5);

/// Of a flight, and of what happens in it [s]: up to 11 days.
inline const Range kTime = Range::between(0.0, 1e6);

}  // namespace aqc
