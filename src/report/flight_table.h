#pragma once

#include <string>
#include <vector>

#include "adaptive_quadrotor_control/flight/flight_log.h"
#include "adaptive_quadrotor_control/model/vehicle.h"
#include "adaptive_quadrotor_control/simulation/scenario.h"

namespace aqc {

/// How a table may look. Only a terminal should be given colours.
enum class TableStyle { kPlain, kColoured };

/// kColoured when stdout is a terminal that understands colours and NO_COLOR is not set.
TableStyle styleOfStdout();

/// Metrics of flights of `scenario`, one below the other, ready to print: RMS errors over the
/// scenario's window, altitude errors, speed of the simulation and how each flight ended. Beneath a
/// controller with published errors stand those, and by how much ours differ. Throws
/// std::invalid_argument as measure() does.
std::string flightTable(const std::vector<FlightLog>& logs, const Scenario& scenario,
                        const Vehicle& vehicle, TableStyle style);

}  // namespace aqc
