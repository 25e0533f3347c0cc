#pragma once

#include <string>

#include "adaptive_quadrotor_control/law/control_law.h"
#include "adaptive_quadrotor_control/model/vehicle.h"
#include "adaptive_quadrotor_control/pilot/pilot_limits.h"

namespace aqc {

/// What a guarded law bears in a hover at 1 m and a step of 2 m aside, each by itself, with control
/// at 250 Hz: it is at rest within 0.5 m of where it should be afterwards.
struct Margins {
  double delay = 0.0;  ///< longest of odometry [s]
  double rate = 0.0;   ///< lowest of odometry [Hz]
  double gap = 0.0;    ///< longest without odometry and IMU [s]; it may have landed, unharmed
  double noise = 0.0;  ///< most of the position [m]; see kNoisePerMetre
};

/// The other standard deviations of the noise, for each metre of the position's: [m/s], [rad], and
/// [rad/s].
constexpr double kNoisePerMetre[] = {4.0, 1.0, 4.0};

/// By bisection, to 1 %. `limits` must have a guard.
Margins measureMargins(const Vehicle& vehicle, const ControlLaw& law, const PilotLimits& limits);

/// A row of a table with the heading of marginsHeading().
std::string marginsRow(const std::string& name, const Margins& margins);
std::string marginsHeading();

}  // namespace aqc
