#pragma once

#include "adaptive_quadrotor_control/ControllerState.h"
#include "adaptive_quadrotor_control/pilot/pilot.h"
#include "ros/border/conversions.h"

namespace aqc {

/// What the pilot saw and decided in its last step, all but names and units of what its law
/// adapts: the law makes these anew at every call, so whoever changes the law keeps them.
void fill(const Pilot& pilot, msgs::ControllerState& message);

}  // namespace aqc
