#include "adaptive_quadrotor_control/simulation/plant_action_reader.h"

#include <limits>

#include "adaptive_quadrotor_control/model/inertia.h"
#include "adaptive_quadrotor_control/model/vehicle.h"
#include "adaptive_quadrotor_control/parameters/parameter_reader.h"
#include "simulation/ranges.h"

namespace aqc {
namespace {

std::uint64_t readSeed(const ParameterReader& reader) {
  if (!reader.has("seed")) return 0;
  return static_cast<std::uint64_t>(reader.integer("seed", 0, std::numeric_limits<int>::max()));
}

}  // namespace

SetWind readWind(const ParameterReader& reader) {
  return {reader.vector3("velocity", kWind)};
}

SetBody readBody(const ParameterReader& reader) {
  const double mass = reader.number("mass", kVehicleMass);
  return {mass, readInertia(reader, kLeastVehicleMoment)};
}

ApplyDisturbance readDisturbance(const ParameterReader& reader, Nanoseconds duration) {
  const Eigen::Vector3d none = Eigen::Vector3d::Zero();
  ApplyDisturbance disturbance;
  disturbance.duration = duration;
  disturbance.amplitude.force = reader.vector3("force", kDisturbance, none);
  disturbance.amplitude.moment = reader.vector3("moment", kDisturbance, none);
  disturbance.angular_frequency = reader.number("angular_frequency", kAngularFrequency, 0.0);
  return disturbance;
}

SetRotor readRotor(const ParameterReader& reader) {
  SetRotor rotor;
  rotor.number = reader.integer("number", 1, kMaxRotors);
  RotorCondition& condition = rotor.condition;
  condition.effectiveness = reader.number("effectiveness", Range::between(0.0, 1.0), 1.0);
  if (reader.has("stuck_at"))
    condition.stuck_at = reader.number("stuck_at", Range::between(0.0, 1e5));
  condition.slower = reader.number("slower", Range::between(1.0, 1e3), 1.0);
  return rotor;
}

SetGust readGust(const ParameterReader& reader) {
  SetGust gust;
  gust.intensity = reader.vector3("intensity", Range::between(0.0, 100.0));
  gust.length = reader.number("length", Range::between(0.1, 1e4), gust.length);
  gust.speed = reader.number("speed", Range::between(0.1, 100.0), gust.speed);
  gust.seed = readSeed(reader);
  return gust;
}

LoseCommands readLostCommands(const ParameterReader& reader, Nanoseconds duration) {
  return {reader.number("share", Range::between(0.0, 1.0)), duration, readSeed(reader)};
}

SetBattery readBattery(const ParameterReader& reader) {
  const double voltage = reader.number("voltage", Range::positiveUpTo(1.0));
  return {voltage, fromSeconds(reader.number("over", kTime, 0.0))};
}

}  // namespace aqc
