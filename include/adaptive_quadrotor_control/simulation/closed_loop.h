#pragma once

#include <functional>
#include <memory>

#include "adaptive_quadrotor_control/flight/flight_log.h"
#include "adaptive_quadrotor_control/pilot/pilot.h"
#include "adaptive_quadrotor_control/simulation/scenario.h"

namespace aqc {

/// A scenario flown without ROS: plant and pilot in one loop, the pilot fed at the control rate
/// with the state of this very instant, the rotor speeds held until its next step.
class ClosedLoop {
 public:
  /// Throws std::invalid_argument for a plant step that TimedPlant refuses.
  ClosedLoop(const Scenario& scenario, const Vehicle& vehicle, std::unique_ptr<ControlLaw> law);

  bool done() const noexcept { return plant_.now() >= duration_; }
  /// One control step, then the plant until the next one.
  void advance();

  /// What the last advance() started from and decided.
  FlightSample sample() const;
  /// Switches refused, or done against the dwell time, so far.
  const std::vector<TimedPlant::Refusal>& objections() const noexcept { return objections_; }
  const TimedPlant& plant() const noexcept { return plant_; }
  const Pilot& pilot() const noexcept { return pilot_; }

 private:
  // What only the plant knows about the time of a control step.
  struct Truth {
    Nanoseconds time = 0;
    double payload_mass = 0.0;
    bool touching = false;
    ForceMoment disturbance;
  };

  TimedPlant plant_;
  Pilot pilot_;
  std::vector<TimedPlant::Refusal> objections_;
  Nanoseconds period_;
  Nanoseconds duration_;
  Truth truth_;
};

/// Flies the scenario to its end. `progress` (may be empty) is told the share flown, 0 to 1.
FlightLog fly(const Scenario& scenario, const Vehicle& vehicle, const std::string& controller_name,
              std::unique_ptr<ControlLaw> law, const std::function<void(double)>& progress);

}  // namespace aqc
