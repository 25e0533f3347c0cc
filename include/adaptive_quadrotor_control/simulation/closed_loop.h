#pragma once

#include <Eigen/Core>
#include <memory>
#include <optional>
#include <vector>

#include "adaptive_quadrotor_control/flight/refusal.h"
#include "adaptive_quadrotor_control/flight/truth.h"
#include "adaptive_quadrotor_control/pilot/pilot.h"
#include "adaptive_quadrotor_control/simulation/scenario.h"
#include "adaptive_quadrotor_control/simulation/sensor_channels.h"
#include "adaptive_quadrotor_control/simulation/timed_plant.h"

namespace aqc {

/// A scenario flown without ROS: plant and pilot in one loop, the pilot fed at the control rate
/// with the state of this very instant, the rotor speeds held until its next step. In a world with
/// `sensors` it hears what comes through their channels, when it comes, and a timer makes its
/// steps.
///
/// With a guard (PilotLimits::guard) a timer makes the steps and the gyroscope is heard, too. The
/// guard is asked to arm and to take off as soon as it obeys, a vehicle that starts in the air is
/// taken over, and the mission's set points are planned when it flies.
class ClosedLoop {
 public:
  /// Throws std::invalid_argument for a plant step that TimedPlant refuses.
  ClosedLoop(const Scenario& scenario, const Vehicle& vehicle, std::unique_ptr<ControlLaw> law,
             const PilotLimits& limits = {});
  /// The vehicle that is flown is not the one that the pilot believes in (and `law` was made for).
  ClosedLoop(const Scenario& scenario, const Vehicle& flown, const Vehicle& believed,
             std::unique_ptr<ControlLaw> law, const PilotLimits& limits = {});

  bool done() const noexcept { return plant_.now() >= duration_; }
  /// One control step, then the plant until the next one. Throws std::invalid_argument for set
  /// points of the mission that the guard refuses (see Pilot::plan()).
  void advance();

  /// What the last advance() started from and decided.
  FlightSample sample() const;
  /// Switches refused, or done against the dwell time, so far.
  const std::vector<Refusal>& objections() const noexcept { return objections_; }
  const TimedPlant& plant() const noexcept { return plant_; }
  const Pilot& pilot() const noexcept { return pilot_; }
  /// For orders between two steps.
  Pilot& pilot() noexcept { return pilot_; }

 private:
  void takeOff();
  void feelImu(const Eigen::Vector3d& specific_force, const Eigen::Vector3d& body_rate,
               Nanoseconds stamp);
  void listen();

  TimedPlant plant_;
  Pilot pilot_;
  std::optional<SensorChannels> channels_;  // of a world with `sensors`
  std::vector<Refusal> objections_;
  Nanoseconds period_;
  Nanoseconds plant_step_;
  Nanoseconds duration_;
  Truth truth_;                            // at the time of the last control step
  std::vector<TimedSetPoint> set_points_;  // to be planned once a guard flies
  bool taken_off_ = false;
};

}  // namespace aqc
