#include "adaptive_quadrotor_control/simulation/plant_action_reader.h"

#include "adaptive_quadrotor_control/model/inertia.h"
#include "adaptive_quadrotor_control/model/vehicle.h"
#include "adaptive_quadrotor_control/parameters/parameter_reader.h"

namespace aqc {

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

}  // namespace aqc
