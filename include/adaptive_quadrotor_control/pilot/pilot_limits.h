#pragma once

#include <optional>

#include "adaptive_quadrotor_control/pilot/flight_monitor.h"
#include "adaptive_quadrotor_control/pilot/guard_limits.h"
#include "adaptive_quadrotor_control/pilot/handover.h"
#include "adaptive_quadrotor_control/pilot/imu_monitor.h"
#include "adaptive_quadrotor_control/pilot/step_clock.h"

namespace aqc {

class ParameterReader;

/// Everything that decides how old, how late or how far off is too much.
struct PilotLimits {
  ClockLimits clock;  ///< of the odometry's stamps
  /// The specific force is not used when it is further behind the odometry [ns].
  Nanoseconds specific_force_age = ImuMonitor::kOldest;
  /// A trajectory stamped further back was not meant for now by its clock: it begins now, as one
  /// without a stamp does [ns].
  Nanoseconds trajectory_age = 1'000'000'000;
  HandoverLimits handover;
  MonitorLimits monitor;
  std::optional<GuardLimits> guard;  ///< nothing: unguarded, as the published flights were
};

/// Reads limits by their names, all optional: `new_start`, `specific_force_age`, `trajectory_age`
/// [s], `confirmations`, `handover: {position_error, velocity_error, attitude_error}` and
/// `monitor: {rate_deviation, jitter, odometry_age, silence, distance, saturation,
/// dropped_odometry, lift}`, each of these [warn, error]. Throws ParameterError.
PilotLimits readPilotLimits(const ParameterReader& reader);

}  // namespace aqc
