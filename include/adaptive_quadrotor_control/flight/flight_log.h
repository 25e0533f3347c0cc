#pragma once

#include <optional>
#include <string>
#include <vector>

#include "adaptive_quadrotor_control/law/control_law.h"
#include "adaptive_quadrotor_control/math/time.h"
#include "adaptive_quadrotor_control/model/rotor_allocation.h"
#include "adaptive_quadrotor_control/simulation/scenario.h"
#include "adaptive_quadrotor_control/simulation/timed_plant.h"

namespace aqc {

/// One control step of a flight, offline or over ROS.
struct FlightSample {
  Nanoseconds time = 0;
  State state;
  bool flying = false;  ///< a set point was active
  SetPoint set_point;   ///< the active one
  Telemetry telemetry;
  Allocation allocation;
  double payload_mass = 0;  ///< attached then [kg]
  bool touching = false;    ///< the ground
  ForceMoment disturbance;  ///< that acts on the vehicle
};

/// Everything a flight leaves behind; tables, files and figures are made from it.
struct FlightLog {
  std::string controller;
  std::vector<std::string> adaptive_names;
  std::vector<FlightSample> samples;
  std::optional<Nanoseconds> crash_time;
  std::string crash_reason;
  /// Events that had become impossible; switches that were refused or against the dwell time.
  std::vector<TimedPlant::Refusal> refusals;
  std::string dwell_time;         ///< of a law with several subsystems: SubsystemSwitch::text()
  double real_time_factor = 0.0;  ///< simulated time / wall time; 0 when not measured
};

struct FlightMetrics {
  RmsErrors rms;                        ///< over the scenario's window
  double peak_altitude_error = 0.0;     ///< largest |e_z| after the last payload change [m]
  double settled_altitude_error = 0.0;  ///< mean |e_z| over the last 5 s [m]
  double final_lateral_error = 0.0;     ///< horizontal distance from the set point at the end [m]
  std::optional<double> crash_time;     ///< [s]
  /// On the ground from this time to the end, though told to fly [s].
  std::optional<double> grounded_from;
  double duration = 0.0;  ///< [s]
};

/// Metrics of a flight of `scenario`. Throws std::invalid_argument when no sample falls into the
/// scenario's window.
FlightMetrics measure(const FlightLog& log, const Scenario& scenario);

}  // namespace aqc
