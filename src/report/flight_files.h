#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "adaptive_quadrotor_control/flight/flight_log.h"
#include "adaptive_quadrotor_control/simulation/scenario.h"

namespace aqc {

/// Metrics of all flights [m, deg, s]:
///
///     {"scenario": s, "flights": [{"controller": s,
///      "rms": {"x", "y", "z", "roll", "pitch", "yaw"},
///      "peak_altitude_error", "settled_altitude_error", "final_lateral_error", "crashed": bool,
///      "crash_time": s|null, "grounded_from": s|null, "duration": s, "real_time_factor": n|null,
///      "refusals": [{"time": s, "reason": s}]}]}
///
/// Refusals are events of the scenario that had become impossible in this flight, and switches of
/// subsystems that were refused or against the dwell time. What is not
/// finite or was not measured is null. Throws std::invalid_argument as measure() does.
nlohmann::json flightJson(const std::vector<FlightLog>& logs, const Scenario& scenario);

/// The name of a flight's CSV file: `<controller>.csv`.
std::string csvName(const FlightLog& log);

/// Makes `folder` with all its parents. Throws std::runtime_error, also when it cannot be written.
void makeFolder(const std::string& folder);

/// Writes one file and makes sure that all of it has arrived. Throws std::runtime_error.
void writeFile(const std::string& path, const std::string& text);

/// Writes a CSV file a flight into `folder`, which is made if need be. Throws std::runtime_error.
void writeFlightFiles(const std::string& folder, const std::vector<FlightLog>& logs);

/// Writes flightJson() to `path`. Throws std::runtime_error and what flightJson() throws.
void writeJson(const std::string& path, const std::vector<FlightLog>& logs,
               const Scenario& scenario);

}  // namespace aqc
