#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "adaptive_quadrotor_control/math/time.h"
#include "adaptive_quadrotor_control/model/state.h"
#include "adaptive_quadrotor_control/model/vehicle.h"
#include "adaptive_quadrotor_control/simulation/box.h"
#include "adaptive_quadrotor_control/simulation/cargo.h"
#include "adaptive_quadrotor_control/simulation/plant.h"
#include "adaptive_quadrotor_control/simulation/sensor_faults.h"

namespace aqc {

class ParameterReader;

/// Where a flight takes place: all of a scenario that a plant needs before anything happens.
struct World {
  State start;
  std::map<std::string, Payload> payloads;  ///< by name; what a mission may attach
  std::vector<Cargo> cargo;                 ///< those payloads that lie about at the start
  std::vector<Box> walls;
  bool ground = true;  ///< at z = 0; false: free flight everywhere, and nothing lies about
  Nanoseconds plant_step = 0;
  Nanoseconds control_period = 0;  ///< a command is held so long: a whole number of plant steps
  /// After a silence of this length the rotors are commanded 0, as by motor drivers; 0: never. The
  /// key `rotors: {command_timeout}` [s]. Not given: never offline, where nobody falls silent; the
  /// plant node has a default of its own.
  std::optional<Nanoseconds> command_timeout;
  /// What is wrong with the sensors; without it the pilot hears the truth at once.
  std::optional<SensorFaults> sensors;
};

/// The period of a rate, which is 1 to 1e5 [Hz]. Throws ParameterError.
Nanoseconds readPeriod(const ParameterReader& reader, const std::string& rate);

/// Reads the key `command_timeout` [s] of who hears motor commands once in `control_period`: longer
/// than that, or 0 for none. Throws ParameterError.
Nanoseconds readCommandTimeout(const ParameterReader& reader, Nanoseconds control_period);

/// Reads and validates the world's part of a scenario; names of the other parts count as unread.
/// Does not call reader.finish(). Throws ParameterError.
World readWorld(const ParameterReader& scenario);

/// The plant that simulates `vehicle` in that world.
std::unique_ptr<Plant> makePlant(const Vehicle& vehicle, const World& world);

}  // namespace aqc
