#pragma once

#include <vector>

#include "adaptive_quadrotor_control/model/vehicle.h"
#include "adaptive_quadrotor_control/simulation/rotor_condition.h"

namespace aqc {

/// Whether the rotors can hold up `load` [N] without turning the vehicle: each gives its share (the
/// least-squares one, on a quadrotor the only one) with what is wrong with it and with the battery
/// at `voltage` (share of the full one). A rotor that is stuck cannot. Where it is false physics
/// leaves no choice but to come down.
bool canHover(const Vehicle& vehicle, const std::vector<RotorCondition>& rotors, double voltage,
              double load);

}  // namespace aqc
