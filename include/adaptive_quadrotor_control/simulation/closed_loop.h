#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "adaptive_quadrotor_control/flight/refusal.h"
#include "adaptive_quadrotor_control/flight/truth.h"
#include "adaptive_quadrotor_control/pilot/pilot.h"
#include "adaptive_quadrotor_control/simulation/scenario.h"
#include "adaptive_quadrotor_control/simulation/sensor_channel.h"
#include "adaptive_quadrotor_control/simulation/timed_plant.h"

namespace aqc {

/// A scenario flown without ROS: plant and pilot in one loop, the pilot fed at the control rate
/// with the state of this very instant, the rotor speeds held until its next step. In a world with
/// `sensors` it hears what comes through their channels, when it comes, and a timer makes its
/// steps.
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
  const std::vector<Refusal>& objections() const noexcept { return objections_; }
  const TimedPlant& plant() const noexcept { return plant_; }
  const Pilot& pilot() const noexcept { return pilot_; }

 private:
  // The channels of a world with `sensors`.
  struct Channels {
    OdometryChannel odometry;
    ImuChannel imu;
  };

  void listen();
  void advanceThroughChannels(Nanoseconds until);

  TimedPlant plant_;
  Pilot pilot_;
  std::optional<Channels> channels_;
  std::vector<Refusal> objections_;
  Nanoseconds period_;
  Nanoseconds plant_step_;
  Nanoseconds duration_;
  Truth truth_;  // at the time of the last control step
};

}  // namespace aqc
