#pragma once

#include <string>

#include "adaptive_quadrotor_control/model/vehicle.h"
#include "adaptive_quadrotor_control/simulation/flight_log.h"

namespace aqc {

/// What a bag tells of a flight.
struct RecordedFlight {
  FlightLog log;      ///< its time begins at 0 with the first step that flies
  Vehicle vehicle;    ///< from the last `parameters` message
  Scenario scenario;  ///< only what figures need: title, duration, payload changes
};

/// Reads controller/state, plant/status and controller/parameters, in whatever namespace they are.
/// Throws std::runtime_error, naming the file and what is missing in it.
RecordedFlight readBag(const std::string& path);

}  // namespace aqc
