#pragma once

#include "adaptive_quadrotor_control/parameters/schema.h"
#include "adaptive_quadrotor_control/simulation/plant_action.h"

namespace aqc {

class ParameterReader;

/// What the angular frequency of a sine may be [rad/s].
inline const Range kAngularFrequency = Range::between(0.0, 1e3);
/// What the air may move at in each axis [m/s]; the fastest tornado reached 135.
inline const Range kWind = Range::between(-200.0, 200.0);
/// What a disturbance may be in each axis [N], [N m]: twenty times the weight of 500 kg.
inline const Range kDisturbance = Range::between(-1e5, 1e5);
/// How long one, or a loss of commands, may last [s]: up to 11 days.
inline const Range kDisturbed = Range::positiveUpTo(1e6);

// What a mission's entry and a service's request ask of the plant is judged here, whoever asks.
// That of a payload is readPayload(). Each throws ParameterError.

/// Reads `velocity`, within kWind.
SetWind readWind(const ParameterReader& reader);

/// Reads `mass`, within kVehicleMass, and `inertia` (readInertia()), as those of a vehicle file.
SetBody readBody(const ParameterReader& reader);

/// Reads `force` and `moment`, zero when not given, within kDisturbance, and `angular_frequency`,
/// without which they are constant. `duration` must be > 0.
ApplyDisturbance readDisturbance(const ParameterReader& reader, Nanoseconds duration);

/// Reads `number`, and `effectiveness`, `stuck_at` and `slower`, which are sound when not given.
SetRotor readRotor(const ParameterReader& reader);

/// Reads `voltage`, and `over` [s], which is 0 when not given.
SetBattery readBattery(const ParameterReader& reader);

/// Reads `intensity`, and `length`, `speed` and `seed`, which are those of SetGust when not given.
SetGust readGust(const ParameterReader& reader);

/// Reads `share`, and `seed`, which is 0 when not given. `duration` must be > 0.
LoseCommands readLostCommands(const ParameterReader& reader, Nanoseconds duration);

}  // namespace aqc
