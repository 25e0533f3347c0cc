#pragma once

#include <string>

#include "adaptive_quadrotor_control/math/number_text.h"
#include "adaptive_quadrotor_control/model/vehicle.h"

namespace aqc::fuzz {

/// Empty when rotor speeds are finite and within the vehicle's range; else what is not.
inline std::string outOfRange(const RotorArray& speeds, const Vehicle& vehicle) {
  for (const double speed : speeds) {
    if (speed >= 0.0 && speed <= vehicle.max_rotor_speed) continue;
    return "a rotor is told " + numberText(speed) + " rad/s; 0 to " +
           numberText(vehicle.max_rotor_speed) + " are possible";
  }
  return "";
}

}  // namespace aqc::fuzz
