#pragma once

#include <string>
#include <vector>

#include "figures/plotted_flight.h"
#include "report/backdrop.h"

namespace aqc {

/// The gnuplot script that draws the flown paths from above and from the side, with the walls, as
/// path.png in the current folder.
std::string pathScript(const std::vector<PlottedFlight>& flights, const Backdrop& backdrop);

}  // namespace aqc
