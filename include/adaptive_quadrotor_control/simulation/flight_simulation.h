#pragma once

#include <functional>
#include <memory>
#include <string>

#include "adaptive_quadrotor_control/flight/flight_log.h"
#include "adaptive_quadrotor_control/flight/metrics.h"
#include "adaptive_quadrotor_control/law/control_law.h"
#include "adaptive_quadrotor_control/model/vehicle.h"
#include "adaptive_quadrotor_control/simulation/scenario.h"

namespace aqc {

/// Flies the scenario to its end and keeps all of it. `progress` (may be empty) is told the share
/// flown, 0 to 1. Throws what TimedPlant throws for a scenario that its plant cannot fly.
FlightLog fly(const Scenario& scenario, const Vehicle& vehicle, const std::string& controller_name,
              std::unique_ptr<ControlLaw> law, const std::function<void(double)>& progress);

/// The same flight, of which only the metrics are left: those of fly()'s log to the last bit, in a
/// fraction of the time and without its memory. Throws as fly() and measure() do.
FlightMetrics flyMeasured(const Scenario& scenario, const Vehicle& vehicle,
                          std::unique_ptr<ControlLaw> law);

}  // namespace aqc
