#include "adaptive_quadrotor_control/flight/metrics.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "adaptive_quadrotor_control/flight/flight_log.h"

namespace aqc {
namespace {

constexpr Nanoseconds kSettledWindow = 5'000'000'000;

std::optional<double> groundedFrom(const FlightLog& log) {
  std::optional<double> since;
  for (auto sample = log.samples.rbegin(); sample != log.samples.rend(); ++sample) {
    if (!sample->touching || !sample->flying) break;
    since = toSeconds(sample->time);
  }
  return since;
}

}  // namespace

FlightMetrics measure(const FlightLog& log, const MetricsWindow& window) {
  FlightMetrics metrics;
  Eigen::Array3d position = Eigen::Array3d::Zero();
  Eigen::Array3d attitude = Eigen::Array3d::Zero();
  double settled = 0.0;
  int count = 0;
  int settled_count = 0;
  for (const FlightSample& sample : log.samples) {
    if (!sample.flying) continue;
    const double altitude_error = std::abs(sample.telemetry.position_error.z());
    metrics.final_lateral_error = sample.telemetry.position_error.head<2>().norm();
    if (sample.time >= window.from) {
      position += sample.telemetry.position_error.array().square();
      attitude += sample.telemetry.attitude_error.array().square();
      ++count;
    }
    if (sample.time >= window.last_payload_change) {
      metrics.peak_altitude_error = std::max(metrics.peak_altitude_error, altitude_error);
    }
    if (sample.time >= window.end - kSettledWindow) {
      settled += altitude_error;
      ++settled_count;
    }
  }
  if (count == 0 || settled_count == 0) {
    throw std::invalid_argument("the flight of '" + log.controller +
                                "' has no samples in the scenario's window");
  }
  metrics.rms.position = (position / count).sqrt();
  metrics.rms.attitude = (attitude / count).sqrt() * 180.0 / M_PI;
  metrics.settled_altitude_error = settled / settled_count;
  if (log.crash_time) metrics.crash_time = toSeconds(*log.crash_time);
  metrics.grounded_from = groundedFrom(log);
  metrics.duration = toSeconds(window.end);
  return metrics;
}

}  // namespace aqc
