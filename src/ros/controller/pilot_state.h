#pragma once

#include <string>
#include <vector>

#include "adaptive_quadrotor_control/ControllerState.h"
#include "adaptive_quadrotor_control/pilot/pilot.h"
#include "ros/border/conversions.h"

namespace aqc {

/// What the pilot saw and decided in its last step, all but `adaptive_names`: making those
/// allocates, so whoever changes the law keeps them.
void fill(const Pilot& pilot, msgs::ControllerState& message);

/// Names of what the law adapts.
std::vector<std::string> adaptiveNames(const ControlLaw& law);

}  // namespace aqc
