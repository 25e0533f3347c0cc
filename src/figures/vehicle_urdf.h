#pragma once

#include <string>

#include "adaptive_quadrotor_control/model/vehicle.h"

namespace aqc {

/// The vehicle as URDF for rviz: one link `base_link` with visuals only, drawn from the vehicle's
/// own numbers (arms, rotor discs, landing gear). Rotors that spin counter-clockwise are blue,
/// clockwise orange; the nose (+x) is red.
std::string vehicleUrdf(const Vehicle& vehicle);

}  // namespace aqc
