#pragma once

#include <string>
#include <vector>

#include "figures/figure_script.h"
#include "figures/plotted_flight.h"

namespace aqc {

/// Whether the law of this flight has subsystems, of which one is active.
bool hasSubsystems(const PlottedFlight& flight);

/// The figures of thesis chapter 3 for such a flight: `switching` (signal, disturbance, errors) and
/// for each subsystem `subsystem_1` .. (its gains, its active phases shaded). `frame` holds what
/// they share: title and duration.
std::vector<Figure> switchingFigures(const PlottedFlight& flight, const Figure& frame);

/// Names of all figures that switchingFigures() may make.
std::vector<std::string> switchingFigureNames();

}  // namespace aqc
