#pragma once

#include <optional>
#include <variant>
#include <vector>

#include "adaptive_quadrotor_control/model/time.h"
#include "adaptive_quadrotor_control/simulation/plant.h"

namespace aqc {

struct AttachPayload {
  Payload payload;
};
struct DetachPayload {};
struct SetWind {
  Eigen::Vector3d velocity;  ///< of the air in W [m/s]
};
/// Something that happens to the plant.
using PlantAction = std::variant<AttachPayload, DetachPayload, SetWind>;

struct PlantEvent {
  Nanoseconds time = 0;
  PlantAction action;
};

/// A plant with a clock that counts whole steps, and with events that act exactly at the first
/// step not before their time. The offline flight and the ROS plant node both run this class.
class TimedPlant {
 public:
  /// `step` > 0 is the integration step; the clock starts at `start`.
  TimedPlant(Plant plant, Nanoseconds step, Nanoseconds start = 0);

  /// Plans an event; one whose time has passed acts at the next step. Throws std::logic_error when
  /// the payload events would not alternate: attach, detach, attach, ...
  void schedule(const PlantEvent& event);

  /// Steps until the clock reads `until` (a whole number of steps away) under rotor speeds
  /// [rad/s].
  void advance(const RotorArray& command, Nanoseconds until);

  Nanoseconds now() const noexcept { return now_; }
  const Plant& plant() const noexcept { return plant_; }
  /// Time of the first crash.
  std::optional<Nanoseconds> crashTime() const noexcept { return crash_time_; }

 private:
  void apply(const PlantAction& action);

  Plant plant_;
  Nanoseconds step_;
  Nanoseconds now_;
  std::vector<PlantEvent> events_;  // still to come, by time
  std::optional<Nanoseconds> crash_time_;
};

}  // namespace aqc
