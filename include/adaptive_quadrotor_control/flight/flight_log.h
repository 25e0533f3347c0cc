#pragma once

#include <optional>
#include <string>
#include <vector>

#include "adaptive_quadrotor_control/flight/flight_sample.h"
#include "adaptive_quadrotor_control/flight/refusal.h"
#include "adaptive_quadrotor_control/law/control_law.h"

namespace aqc {

/// Everything a flight leaves behind; tables, files and figures are made from it.
struct FlightLog {
  std::string controller;
  std::vector<AdaptiveQuantity> adaptive_quantities;  ///< what Telemetry::adaptive holds
  std::vector<FlightSample> samples;
  std::optional<Nanoseconds> crash_time;
  std::string crash_reason;
  /// Events that had become impossible; switches that were refused or against the dwell time.
  std::vector<Refusal> refusals;
  std::string dwell_time;         ///< of a law with several subsystems: SubsystemSwitch::text()
  double real_time_factor = 0.0;  ///< simulated time / wall time; 0 when not measured
};

}  // namespace aqc
