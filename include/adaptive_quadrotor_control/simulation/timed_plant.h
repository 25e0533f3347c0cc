#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "adaptive_quadrotor_control/flight/refusal.h"
#include "adaptive_quadrotor_control/math/time.h"
#include "adaptive_quadrotor_control/simulation/cargo.h"
#include "adaptive_quadrotor_control/simulation/command_link.h"
#include "adaptive_quadrotor_control/simulation/gust.h"
#include "adaptive_quadrotor_control/simulation/plant.h"
#include "adaptive_quadrotor_control/simulation/plant_action.h"

namespace aqc {

/// A plant with a clock that counts whole steps, with payloads that lie about, and with events that
/// act exactly at the first step not before their time. The offline flight and the ROS plant node
/// both run this class.
class TimedPlant {
 public:
  /// `plant` must be there; `step` is the integration step, > 0 and at most the plant's
  /// longestStep(). Throws std::invalid_argument. The clock starts at `start`. After a silence of
  /// `command_timeout` [ns] the rotors are commanded 0: see CommandLink.
  TimedPlant(std::unique_ptr<Plant> plant, std::vector<Cargo> cargo, Nanoseconds step,
             Nanoseconds start = 0, Nanoseconds command_timeout = 0);

  /// Plans an event; one whose time has passed acts at the next step. Throws std::logic_error when
  /// the payload events would not alternate: attach, detach, attach, ...; std::invalid_argument for
  /// a rotor that the vehicle does not have.
  void schedule(const PlantEvent& event);

  /// Whether a payload of that name lies about or hangs under the vehicle.
  bool knows(const std::string& name) const;
  /// Empty when a payload may be picked up from where it is now, else why not. Cargo can be picked
  /// up within kReach of the place under the vehicle where it will hang, and on a cable as far from
  /// the hook as that is long.
  std::string obstacle(const AttachPayload& attach) const;
  static constexpr double kReach = 0.5;  ///< [m]

  /// Somebody commands rotor speeds [rad/s] now, which hold until the next command or a time-out.
  void command(const RotorArray& speeds);
  /// Steps until the clock reads `until`, a whole number of steps away. An event that has become
  /// impossible is left out and told by refusals().
  void advance(Nanoseconds until);
  /// Both, unless there is no step to make.
  void advance(const RotorArray& command, Nanoseconds until);

  Nanoseconds now() const noexcept { return now_; }
  const Plant& plant() const noexcept { return *plant_; }
  /// Payloads that are not attached.
  const std::vector<Cargo>& cargo() const noexcept { return cargo_; }
  /// Name of the attached payload; empty without one.
  const std::string& attachedName() const noexcept { return attached_name_; }
  /// Velocity of the air in W [m/s]: of the wind and of the gust, which is held over a step.
  Eigen::Vector3d wind() const noexcept;
  /// Sum of the disturbances that act at now(); each is held over a step.
  ForceMoment disturbance() const noexcept;
  /// Voltage of the battery at the start of the last step, as a share of the full one.
  double battery() const noexcept { return battery_; }
  /// What is wrong with each rotor, in the order of the vehicle's file.
  const std::vector<RotorCondition>& rotors() const noexcept { return rotors_; }
  /// Whether the rotors are commanded 0 because no command was heard for too long.
  bool silent() const noexcept { return link_.silent(now_); }
  /// Time of the first crash.
  std::optional<Nanoseconds> crashTime() const noexcept { return crash_time_; }

  const std::vector<Refusal>& refusals() const noexcept { return refusals_; }

 private:
  void requireRotor(int number) const;
  void happen();
  void apply(const PlantEvent& event);
  void attach(const AttachPayload& attach);
  void detach();
  void disturb();
  void setGust(const SetGust& shape);
  void drain();
  std::vector<Cargo>::const_iterator find(const std::string& name) const;

  std::unique_ptr<Plant> plant_;
  std::vector<Cargo> cargo_;
  std::string attached_name_;
  CommandLink link_;
  Eigen::Vector3d wind_ = Eigen::Vector3d::Zero();  // without gusts
  std::optional<Gust> gust_;
  Nanoseconds step_;
  Nanoseconds now_;
  std::vector<PlantEvent> events_;  // still to come, by time
  struct ActiveDisturbance {
    Nanoseconds begin;
    ApplyDisturbance shape;
  };
  std::vector<ActiveDisturbance> disturbances_;  // that have begun
  // How the battery's voltage gets to where it is to be.
  struct Drain {
    Nanoseconds begin;
    double from;
    SetBattery end;
  };
  std::optional<Drain> drain_;
  double battery_ = 1.0;
  std::vector<RotorCondition> rotors_;
  std::optional<Nanoseconds> crash_time_;
  std::vector<Refusal> refusals_;
};

}  // namespace aqc
