#pragma once

#include <memory>
#include <string>
#include <vector>

#include "adaptive_quadrotor_control/law/control_law.h"
#include "adaptive_quadrotor_control/model/vehicle.h"

namespace aqc {

class ParameterReader;

/// Names of all control laws, in alphabetical order.
std::vector<std::string> lawNames();

/// Makes the law that the parameter `law` names and gives it the rest of `reader`. `vehicle` is
/// what the law may know of the airframe. Throws ParameterError; does not call reader.finish().
std::unique_ptr<ControlLaw> makeLaw(const ParameterReader& reader, const Vehicle& vehicle);

/// The law of a YAML file (config/controller/*.yaml). Throws ParameterError.
std::unique_ptr<ControlLaw> loadLaw(const std::string& path, const Vehicle& vehicle);

}  // namespace aqc
