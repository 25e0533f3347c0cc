#pragma once

#include <Eigen/Core>
#include <optional>

#include "adaptive_quadrotor_control/math/time.h"

namespace aqc {

struct FlightLog;

/// Root-mean-square errors of a flight.
struct RmsErrors {
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  ///< [m]
  Eigen::Vector3d attitude = Eigen::Vector3d::Zero();  ///< of e_q: roll, pitch, yaw [deg]
};

/// Which part of a flight its metrics are about.
struct MetricsWindow {
  Nanoseconds from = 0;                 ///< RMS errors count from here on
  Nanoseconds last_payload_change = 0;  ///< the peak altitude error counts from here on
  Nanoseconds end = 0;                  ///< of the flight; settled are the 5 s before it
};

/// How well a flight followed its set points. Steps without one count nowhere.
struct FlightMetrics {
  RmsErrors rms;                        ///< over the window
  double peak_altitude_error = 0.0;     ///< largest |e_z| after the last payload change [m]
  double settled_altitude_error = 0.0;  ///< mean |e_z| over the last 5 s [m]
  double final_lateral_error = 0.0;     ///< horizontal distance from the set point at the end [m]
  std::optional<double> crash_time;     ///< [s]
  /// On the ground from this time to the end, though told to fly [s].
  std::optional<double> grounded_from;
  double duration = 0.0;  ///< [s]
};

/// Throws std::invalid_argument when no sample with a set point falls into the window or into its
/// last 5 s.
FlightMetrics measure(const FlightLog& log, const MetricsWindow& window);

}  // namespace aqc
