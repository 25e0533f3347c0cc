#pragma once

#include <optional>
#include <string>

#include "adaptive_quadrotor_control/flight/flight_sample.h"

namespace aqc {

/// What only the plant knows about a time, and no controller.
struct Truth {
  Nanoseconds time = 0;
  double payload_mass = 0.0;                   ///< attached then [kg]
  bool touching = false;                       ///< the ground
  ForceMoment disturbance;                     ///< that acts on the vehicle
  std::optional<Nanoseconds> crash_time = {};  ///< of the first crash until then
  std::string crash_reason = {};
};

/// Puts it into the sample of a step; the sample keeps its time.
inline void addTruth(const Truth& truth, FlightSample& sample) {
  sample.payload_mass = truth.payload_mass;
  sample.touching = truth.touching;
  sample.disturbance = truth.disturbance;
}

}  // namespace aqc
