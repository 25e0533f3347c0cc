#include "adaptive_quadrotor_control/pilot/pilot_limits.h"

#include "adaptive_quadrotor_control/parameters/parameter_reader.h"

namespace aqc {
namespace {

constexpr double kLongest = 1e6;  // [s]

void readTime(const ParameterReader& reader, const std::string& key, Nanoseconds& limit) {
  limit = fromSeconds(reader.number(key, Range::positiveUpTo(kLongest), toSeconds(limit)));
}

void readThreshold(const ParameterReader& reader, const std::string& key, Threshold& threshold) {
  if (!reader.has(key)) return;
  const std::vector<double> values = reader.numbers(key, 2, Range::nonNegative());
  if (values[1] < values[0]) reader.refuseValue(key, "[warn, error] with warn <= error");
  threshold = {values[0], values[1]};
}

void readHandover(const ParameterReader& reader, HandoverLimits& limits) {
  limits.position_error =
      reader.number("position_error", Range::nonNegative(), limits.position_error);
  limits.velocity_error =
      reader.number("velocity_error", Range::nonNegative(), limits.velocity_error);
  limits.attitude_error =
      reader.number("attitude_error", Range::nonNegative(), limits.attitude_error);
}

void readMonitor(const ParameterReader& reader, MonitorLimits& limits) {
  readThreshold(reader, "rate_deviation", limits.rate_deviation);
  readThreshold(reader, "jitter", limits.jitter);
  readThreshold(reader, "odometry_age", limits.odometry_age);
  readThreshold(reader, "silence", limits.silence);
  readThreshold(reader, "distance", limits.distance);
  readThreshold(reader, "saturation", limits.saturation);
  readThreshold(reader, "dropped_odometry", limits.dropped_odometry);
  readThreshold(reader, "lift", limits.lift);
}

}  // namespace

PilotLimits readPilotLimits(const ParameterReader& reader) {
  PilotLimits limits;
  readTime(reader, "new_start", limits.clock.new_start);
  readTime(reader, "specific_force_age", limits.specific_force_age);
  readTime(reader, "trajectory_age", limits.trajectory_age);
  if (reader.has("confirmations")) {
    limits.clock.confirmations = reader.integer("confirmations", 1, 1000);
  }
  if (reader.has("handover")) readHandover(reader.child("handover"), limits.handover);
  if (reader.has("monitor")) readMonitor(reader.child("monitor"), limits.monitor);
  return limits;
}

}  // namespace aqc
