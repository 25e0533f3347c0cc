#pragma once

#include <yaml-cpp/yaml.h>

#include <string>
#include <vector>

#include "adaptive_quadrotor_control/flight/flight_log.h"
#include "adaptive_quadrotor_control/model/vehicle.h"
#include "report/backdrop.h"

namespace aqc {

/// A flight that was read from a file, and what figures need to know about it.
struct Recording {
  std::string path;
  FlightLog log;
  Vehicle vehicle;  ///< mass and max_rotor_speed are 0 where the file does not tell them
  Backdrop backdrop;
};

/// Writes `folder`/flight.yaml: the parameter trees of the scenario and of the vehicle that were
/// flown and, for each of the flights, the units of what its law adapts, by name. It tells
/// readCsvRecording() what the CSV files beside it do not. Throws std::runtime_error.
void writeFlightSetting(const std::string& folder, const YAML::Node& scenario,
                        const YAML::Node& vehicle, const std::vector<FlightLog>& logs);

/// A CSV file of fly. Backdrop, vehicle and units come from the file flight.yaml beside it; without
/// that, the backdrop is what the samples tell, the vehicle has nothing but its rotors, and no
/// adaptive quantity has a unit. A renamed CSV file has no units either: flight.yaml does not know
/// it. Throws as readFlightCsv() does, and ParameterError for a flight.yaml that is wrong.
Recording readCsvRecording(const std::string& path);

/// Names each flight (`log.controller`) so that its legend tells it from the others: by its
/// controller, or where two have the same by its file, or where that is the same too by file and
/// folder. Throws std::runtime_error for one file given twice.
void nameApart(std::vector<Recording>& recordings);

/// That of a figure that shows all of them: the first one's, as long as the longest.
Backdrop jointBackdrop(const std::vector<Recording>& recordings);

/// The vehicle of such a figure: the first one whose mass is known, otherwise the first one.
Vehicle jointVehicle(const std::vector<Recording>& recordings);

}  // namespace aqc
