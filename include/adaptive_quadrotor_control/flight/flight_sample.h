#pragma once

#include "adaptive_quadrotor_control/law/control_law.h"
#include "adaptive_quadrotor_control/math/time.h"
#include "adaptive_quadrotor_control/model/force_moment.h"
#include "adaptive_quadrotor_control/model/rotor_allocation.h"
#include "adaptive_quadrotor_control/model/state.h"
#include "adaptive_quadrotor_control/reference/set_point.h"

namespace aqc {

/// One control step of a flight, offline, over ROS or of a real vehicle.
struct FlightSample {
  Nanoseconds time = 0;
  State state;
  bool flying = false;  ///< a set point was active
  SetPoint set_point;   ///< the active one
  Telemetry telemetry;
  Allocation allocation;
  double payload_mass = 0;  ///< attached then [kg]
  bool touching = false;    ///< the ground
  ForceMoment disturbance;  ///< that acts on the vehicle
};

}  // namespace aqc
