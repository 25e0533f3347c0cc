#include "adaptive_quadrotor_control/model/vehicle.h"

#include <cmath>

#include "adaptive_quadrotor_control/model/inertia.h"
#include "adaptive_quadrotor_control/model/rotor_allocation.h"
#include "adaptive_quadrotor_control/parameters/parameter_reader.h"

namespace aqc {
namespace {

std::vector<Rotor> readRotors(const ParameterReader& reader) {
  const std::vector<double> angles = reader.angles("angles_deg", Range::between(-360.0, 360.0));
  if (angles.size() < 4 || angles.size() > kMaxRotors) {
    reader.refuse("angles_deg", "lists " + std::to_string(angles.size()) +
                                    " rotors; it must list 4 to " + std::to_string(kMaxRotors));
  }
  const std::vector<double> directions = reader.numbers("directions", angles.size(), Range::any());
  const double arm_length = reader.number("arm_length", Range::positiveUpTo(10.0));
  std::vector<Rotor> rotors;
  for (std::size_t i = 0; i < angles.size(); ++i) {
    if (std::abs(directions[i]) != 1.0) {
      reader.refuseValue("directions", "a list of 1 (counter-clockwise) and -1 (clockwise)");
    }
    rotors.push_back({angles[i], arm_length, static_cast<int>(directions[i])});
  }
  return rotors;
}

}  // namespace

Eigen::Vector2d Rotor::position() const {
  return arm_length * Eigen::Vector2d(std::cos(angle), std::sin(angle));
}

std::array<Eigen::Vector2d, 4> Vehicle::feet() const {
  std::array<Eigen::Vector2d, 4> feet;
  for (std::size_t i = 0; i < feet.size(); ++i) {
    const double angle = (0.25 + 0.5 * static_cast<double>(i)) * M_PI;
    feet[i] << gear_radius * std::cos(angle), gear_radius * std::sin(angle);
  }
  return feet;
}

double Vehicle::maxThrust() const {
  return static_cast<double>(rotors.size()) * force_constant * max_rotor_speed * max_rotor_speed;
}

Vehicle readVehicle(const ParameterReader& reader) {
  Vehicle vehicle;
  vehicle.name = reader.text("name");
  vehicle.mass = reader.number("mass", kVehicleMass);
  vehicle.inertia = readInertia(reader, kLeastVehicleMoment);

  const ParameterReader rotors = reader.child("rotors");
  vehicle.rotors = readRotors(rotors);
  vehicle.force_constant = rotors.number("force_constant", Range::positiveUpTo(1.0));
  vehicle.moment_constant = rotors.number("moment_constant", Range::positiveUpTo(10.0));
  vehicle.max_rotor_speed = rotors.number("max_speed", Range::positiveUpTo(1e5));
  vehicle.time_constant_up = rotors.number("time_constant_up", Range::between(0.0, 10.0));
  vehicle.time_constant_down = rotors.number("time_constant_down", Range::between(0.0, 10.0));
  vehicle.drag_coefficient = rotors.number("drag_coefficient", Range::between(0.0, 1.0));
  vehicle.rolling_moment_coefficient =
      rotors.number("rolling_moment_coefficient", Range::between(0.0, 1.0));

  const ParameterReader gear = reader.child("landing_gear");
  vehicle.gear_height = gear.number("height", Range::positiveUpTo(10.0));
  vehicle.gear_radius = gear.number("radius", Range::positiveUpTo(10.0));

  if (!RotorAllocation(vehicle).wellPosed()) {
    rotors.refuseValue("angles_deg", "such that, with the 'directions' " +
                                         rotors.valueText("directions") +
                                         ", thrust, roll, pitch and yaw are independent");
  }
  return vehicle;
}

Vehicle loadVehicle(const std::string& path) {
  const ParameterReader reader(loadYamlFile(path), path);
  Vehicle vehicle = readVehicle(reader);
  reader.finish();
  return vehicle;
}

}  // namespace aqc
