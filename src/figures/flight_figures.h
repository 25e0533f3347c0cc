#pragma once

#include <functional>
#include <string>
#include <vector>

#include "adaptive_quadrotor_control/flight/flight_log.h"
#include "adaptive_quadrotor_control/model/vehicle.h"
#include "report/backdrop.h"

namespace aqc {

/// Draws flights with gnuplot into `folder`: position, position_error,
/// attitude_error, rotors and, when a law adapts anything, adaptation; instead of that for a law
/// with subsystems switching and subsystem_1, .. Each figure is a PNG and the gnuplot script that
/// made it, numbers included, for users to change and run again. Figures of these names from an
/// earlier flight are removed first. An axis whose name ends in
/// "(cut)" leaves out where a flight went that diverged or crashed. The true mass and the rotors'
/// limit are left out for a vehicle whose mass and max_rotor_speed are 0: unknown.
///
/// Returns the paths of the PNGs. `progress` (may be empty) is told the share done, 0 to 1. Throws
/// std::runtime_error when gnuplot is missing (the scripts are there then) or fails, or when
/// something cannot be written.
std::vector<std::string> drawFigures(const std::string& folder, const std::vector<FlightLog>& logs,
                                     const Backdrop& backdrop, const Vehicle& vehicle,
                                     const std::function<void(double)>& progress);

}  // namespace aqc
