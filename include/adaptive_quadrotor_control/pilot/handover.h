#pragma once

#include <string>

#include "adaptive_quadrotor_control/law/control_law.h"

namespace aqc {

/// Whether one law may take over from another in flight. A law that has never seen this flight has
/// no adaptive memory of it: it gets the vehicle where every law can hold it, or not at all.
struct HandoverLimits {
  double position_error = 0.5;  ///< ||e_p|| [m]
  double velocity_error = 0.5;  ///< ||de_p|| [m/s]
  double attitude_error = 0.3;  ///< ||e_q|| [rad]
};

/// Empty when another law may take over now, else why not, with the value and what is allowed.
/// `last` is what the present law saw and decided in its last step, `saturated` what became of it.
std::string handoverObstacle(const Telemetry& last, bool saturated,
                             const HandoverLimits& limits = {});

}  // namespace aqc
