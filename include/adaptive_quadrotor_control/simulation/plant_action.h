#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <string>
#include <variant>

#include "adaptive_quadrotor_control/math/time.h"
#include "adaptive_quadrotor_control/model/force_moment.h"
#include "adaptive_quadrotor_control/simulation/payload.h"
#include "adaptive_quadrotor_control/simulation/rotor_condition.h"

namespace aqc {

/// Picks up the cargo of that name, or, if there is none, lets the payload appear where it fits.
struct AttachPayload {
  std::string name;
  Payload payload;
};
struct DetachPayload {};
struct SetWind {
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero();  ///< of the air in W [m/s]
};
/// Mass and inertia of the vehicle itself become others.
struct SetBody {
  double mass = 0.0;                                  ///< [kg], > 0
  Eigen::Matrix3d inertia = Eigen::Matrix3d::Zero();  ///< about its centre of mass, in B [kg m^2]
};
/// A force and a moment that act for a while: constant, or a sine that begins with 0.
struct ApplyDisturbance {
  Nanoseconds duration = 0;
  ForceMoment amplitude;           ///< at the centre of mass, force in W, moment in B
  double angular_frequency = 0.0;  ///< of the sine [rad/s]; 0: constant
};

/// A rotor breaks, or is sound again.
struct SetRotor {
  int number = 1;  ///< in the order of the vehicle's file, whose first rotor is 1
  RotorCondition condition;
};

/// The battery's voltage sags, or is full again. The speed of a brushless motor is K_V (V - I R)
/// (M. Drela, First-Order DC Electric Motor Model, 2007), so that the speed that a rotor can reach
/// falls as the voltage does: omega <= voltage omega_max, where I R is small or falls with it.
struct SetBattery {
  double voltage = 1.0;  ///< share of the full one in the end, > 0 to 1
  Nanoseconds over = 0;  ///< from what it is, linearly, in this time; 0: at once
};

/// Turbulence on top of the wind, instead of any before: see Gust. The vehicle feels it by what its
/// rotors feel of the air, which acts across their axes and in proportion (drag_coefficient,
/// rolling_moment_coefficient): a level vehicle feels the horizontal gusts, one without drag none.
struct SetGust {
  Eigen::Vector3d intensity = Eigen::Vector3d::Zero();  ///< sigma on the axes of W [m/s]; 0: calm
  double length = 10.0;                                 ///< L [m], > 0
  double speed = 5.0;                                   ///< V at which it passes by [m/s], > 0
  std::uint64_t seed = 0;
};

/// Motor commands get lost on their way, in place of any loss before; the last one that was heard
/// stays: see CommandLink.
struct LoseCommands {
  double share = 0.0;        ///< of the commands, 0 to 1
  Nanoseconds duration = 0;  ///< from the event on
  std::uint64_t seed = 0;
};

/// Something that happens to the plant. What depends on the kind asks by std::visit with one
/// Overloaded branch for each, and no branch for "all others": a new kind does not compile until
/// every place has decided about it (test/house/plant_action_test.py).
using PlantAction = std::variant<AttachPayload, DetachPayload, SetWind, ApplyDisturbance, SetBody,
                                 SetRotor, SetBattery, SetGust, LoseCommands>;

struct PlantEvent {
  Nanoseconds time = 0;
  PlantAction action;
};

/// Several functions as one, for std::visit.
template <class... Branches>
struct Overloaded : Branches... {
  using Branches::operator()...;
};
template <class... Branches>
Overloaded(Branches...) -> Overloaded<Branches...>;

}  // namespace aqc
