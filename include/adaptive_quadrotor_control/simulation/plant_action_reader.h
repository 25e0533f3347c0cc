#pragma once

#include "adaptive_quadrotor_control/parameters/schema.h"
#include "adaptive_quadrotor_control/simulation/plant_action.h"

namespace aqc {

class ParameterReader;

/// What the angular frequency of a sine may be [rad/s].
inline const Range kAngularFrequency = Range::between(0.0, 1e3);

// What a mission's entry and a service's request ask of the plant is judged here, whoever asks.
// That of a payload is readPayload(). Each throws ParameterError.

/// Reads `velocity`.
SetWind readWind(const ParameterReader& reader);

/// Reads `mass` and `inertia`.
SetBody readBody(const ParameterReader& reader);

/// Reads `force` and `moment`, zero when not given, and `angular_frequency`, without which they are
/// constant. `duration` must be > 0.
ApplyDisturbance readDisturbance(const ParameterReader& reader, Nanoseconds duration);

/// Reads `number`, and `effectiveness`, `stuck_at` and `slower`, which are sound when not given.
SetRotor readRotor(const ParameterReader& reader);

/// Reads `voltage`, and `over` [s], which is 0 when not given.
SetBattery readBattery(const ParameterReader& reader);

/// Reads `intensity`, and `length`, `speed` and `seed`, which are those of SetGust when not given.
SetGust readGust(const ParameterReader& reader);

}  // namespace aqc
