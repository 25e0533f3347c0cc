#include "adaptive_quadrotor_control/flight/metrics.h"

#include "adaptive_quadrotor_control/flight/flight_log.h"
#include "adaptive_quadrotor_control/flight/flight_meter.h"

namespace aqc {

FlightMetrics measure(const FlightLog& log, const MetricsWindow& window) {
  FlightMeter meter(window, log.controller);
  for (const FlightSample& sample : log.samples) {
    const Telemetry& telemetry = sample.telemetry;
    meter.add({sample.time, sample.flying, sample.touching, telemetry.position_error,
               telemetry.attitude_error});
  }
  return meter.metrics(log.crash_time);
}

}  // namespace aqc
