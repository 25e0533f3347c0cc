#pragma once

#include <memory>
#include <string>

#include "adaptive_quadrotor_control/law/control_law.h"
#include "adaptive_quadrotor_control/model/vehicle.h"

namespace aqc::fuzz {

/// Of config/, read once. An unknown name throws ParameterError.
const Vehicle& shippedVehicle(const std::string& name);
/// Made for that vehicle.
std::unique_ptr<ControlLaw> shippedLaw(const std::string& name, const std::string& vehicle);

}  // namespace aqc::fuzz
