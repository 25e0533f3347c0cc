#pragma once

#include <optional>
#include <string>
#include <vector>

#include "adaptive_quadrotor_control/flight/flight_log.h"
#include "adaptive_quadrotor_control/simulation/scenario.h"

namespace aqc {

/// What flights are drawn against.
struct Backdrop {
  /// Something hangs under the vehicle.
  struct PayloadPhase {
    Nanoseconds from = 0;
    std::optional<Nanoseconds> to;  ///< none: to the end
    double mass = 0.0;              ///< [kg]
  };

  std::string title;
  Nanoseconds duration = 0;  ///< of the time axes
  std::vector<PayloadPhase> payloads;
  std::vector<Box> walls;
  /// Around the start and all set points; only looked at where there are walls.
  Box mission;
};

/// That of flights of a scenario.
Backdrop backdropOf(const Scenario& scenario);

/// What the samples of a flight (at least one) tell: its duration, and when the payload changed.
Backdrop backdropOf(const FlightLog& log, const std::string& title);

}  // namespace aqc
