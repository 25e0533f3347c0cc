#include "adaptive_quadrotor_control/simulation/sensor_faults.h"

#include "adaptive_quadrotor_control/math/number_text.h"
#include "adaptive_quadrotor_control/parameters/parameter_reader.h"
#include "adaptive_quadrotor_control/simulation/world.h"
#include "simulation/ranges.h"

namespace aqc {
namespace {

const Range kDelay = Range::between(0.0, 100.0);  // [s]
const Range kOffset = Range::between(-1e9, 1e9);  // of a stamp [s]
const Range kShare = Range::between(0.0, 1.0);
const Range kNoise = Range::between(0.0, 1e3);
const Range kFar = Range::between(-1e6, 1e6);
const Range kTurn = Range::between(-360.0, 360.0);  // [deg]

Nanoseconds readTime(const ParameterReader& reader, const char* key, const Range& range) {
  return fromSeconds(reader.number(key, range, 0.0));
}

TimeWindow readWindow(const ParameterReader& reader) {
  TimeWindow window;
  window.from = fromSeconds(reader.number("from", kTime));
  if (!reader.has("until")) return window;
  window.until = fromSeconds(reader.number("until", kTime));
  if (window.until <= window.from) {
    reader.refuseValue("until", "after 'from' " + reader.valueText("from"));
  }
  return window;
}

// Calls read(entry) for each entry of a list that may be missing.
template <class Read>
void readEach(const ParameterReader& reader, const char* key, Read read) {
  if (!reader.has(key)) return;
  for (const ParameterReader& entry : reader.children(key)) read(entry);
}

std::vector<TimeWindow> readWindows(const ParameterReader& reader, const char* key) {
  std::vector<TimeWindow> windows;
  readEach(reader, key,
           [&](const ParameterReader& entry) { windows.push_back(readWindow(entry)); });
  return windows;
}

Nanoseconds readRate(const ParameterReader& reader, Nanoseconds control_period) {
  return reader.has("rate") ? readPeriod(reader, "rate") : control_period;
}

void readOdometry(const ParameterReader& reader, Nanoseconds control_period,
                  OdometryFaults& odometry) {
  odometry.period = readRate(reader, control_period);
  odometry.delay = readTime(reader, "delay", kDelay);
  odometry.jitter = readTime(reader, "jitter", kDelay);
  odometry.dropped = reader.number("dropped", kShare, 0.0);
  odometry.duplicated = reader.number("duplicated", kShare, 0.0);
  odometry.reordered = reader.number("reordered", kShare, 0.0);
  if (reader.has("noise")) {
    const ParameterReader noise = reader.child("noise");
    odometry.noise = {noise.number("position", kNoise, 0.0), noise.number("velocity", kNoise, 0.0),
                      noise.angle("attitude_deg", Range::between(0.0, 90.0), 0.0),
                      noise.number("body_rate", kNoise, 0.0)};
  }
  if (reader.has("wander")) {
    const ParameterReader wander = reader.child("wander");
    odometry.wander = {wander.number("position", kNoise, 0.0),
                       wander.angle("attitude_deg", Range::between(0.0, 90.0), 0.0),
                       wander.number("time", Range::positiveUpTo(1e6), odometry.wander.time)};
  }
  if (reader.has("drift")) {
    const ParameterReader drift = reader.child("drift");
    odometry.position_drift = drift.number("position", kNoise, 0.0);
    odometry.yaw_drift = drift.angle("yaw_deg", Range::between(0.0, 360.0), 0.0);
  }
  odometry.gaps = readWindows(reader, "gaps");
  odometry.freezes = readWindows(reader, "freezes");
  odometry.not_a_number = readWindows(reader, "not_a_number");
  readEach(reader, "jumps", [&](const ParameterReader& entry) {
    odometry.jumps.push_back({readWindow(entry),
                              entry.vector3("position", kFar, Eigen::Vector3d::Zero()),
                              entry.angle("yaw_deg", kTurn, 0.0)});
  });
  readEach(reader, "stamps", [&](const ParameterReader& entry) {
    odometry.stamps.push_back({readWindow(entry), fromSeconds(entry.number("offset", kOffset))});
  });
}

void readImu(const ParameterReader& reader, Nanoseconds control_period, ImuFaults& imu) {
  imu.period = readRate(reader, control_period);
  imu.delay = readTime(reader, "delay", kDelay);
  if (reader.has("noise")) {
    const ParameterReader noise = reader.child("noise");
    imu.force_noise = noise.number("specific_force", kNoise, 0.0);
    imu.rate_noise = noise.number("body_rate", kNoise, 0.0);
  }
  if (reader.has("bias")) {
    const ParameterReader bias = reader.child("bias");
    const Range range = Range::between(-1e3, 1e3);
    imu.force_bias = bias.vector3("specific_force", range, Eigen::Vector3d::Zero());
    imu.rate_bias = bias.vector3("body_rate", range, Eigen::Vector3d::Zero());
  }
  imu.gaps = readWindows(reader, "gaps");
}

}  // namespace

SensorFaults readSensorFaults(const ParameterReader& reader, Nanoseconds control_period) {
  SensorFaults faults;
  faults.seed =
      static_cast<std::uint64_t>(reader.integer("seed", 0, std::numeric_limits<int>::max()));
  faults.odometry.period = faults.imu.period = control_period;
  if (reader.has("odometry")) {
    readOdometry(reader.child("odometry"), control_period, faults.odometry);
  }
  if (reader.has("imu")) readImu(reader.child("imu"), control_period, faults.imu);
  readEach(reader, "clock_steps", [&](const ParameterReader& entry) {
    StampError step;
    step.window.from = fromSeconds(entry.number("at", kTime));
    step.offset = fromSeconds(entry.number("by", kOffset));
    faults.odometry.stamps.push_back(step);
    faults.imu.stamps.push_back(step);
  });
  return faults;
}

}  // namespace aqc
