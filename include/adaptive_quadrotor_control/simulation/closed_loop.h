#pragma once

#include <memory>
#include <vector>

#include "adaptive_quadrotor_control/flight/flight_sample.h"
#include "adaptive_quadrotor_control/flight/refusal.h"
#include "adaptive_quadrotor_control/pilot/flight_controller.h"
#include "adaptive_quadrotor_control/simulation/scenario.h"

namespace aqc {

/// A scenario flown without ROS: plant and controller in one loop, the controller at its rate with
/// the state of this very instant, the rotor speeds held until its next step.
class ClosedLoop {
 public:
  ClosedLoop(const Scenario& scenario, const Vehicle& vehicle, std::unique_ptr<ControlLaw> law);

  bool done() const noexcept { return plant_.now() >= duration_; }
  /// One control step, then the plant until the next one.
  void advance();

  /// What the last advance() started from and decided.
  FlightSample sample() const;
  /// Switches refused, or done against the dwell time, so far.
  const std::vector<Refusal>& objections() const noexcept { return objections_; }
  const TimedPlant& plant() const noexcept { return plant_; }
  const FlightController& controller() const noexcept { return controller_; }

 private:
  void switchSubsystem();

  TimedPlant plant_;
  FlightController controller_;
  SwitchSchedule switches_;
  std::vector<Refusal> objections_;
  SetPointSchedule schedule_;
  Nanoseconds period_;
  Nanoseconds duration_;
  FlightSample last_;
};

}  // namespace aqc
