#pragma once

#include "campaign/dice.h"
#include "campaign/fault_flight.h"

namespace aqc {

/// Adds one to three faults of different kinds to a flight whose mission ends `end` seconds after
/// its start.
void drawFaults(Dice& dice, const Vehicle& vehicle, double end, FaultFlight& flight);

}  // namespace aqc
