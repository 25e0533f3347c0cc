#include "adaptive_quadrotor_control/simulation/world.h"

#include "adaptive_quadrotor_control/math/number_text.h"
#include "adaptive_quadrotor_control/math/rotations.h"
#include "adaptive_quadrotor_control/parameters/parameter_reader.h"
#include "adaptive_quadrotor_control/simulation/flexible_plant.h"
#include "simulation/ranges.h"

namespace aqc {
namespace {

State readStart(const ParameterReader& reader) {
  State start;
  start.position = reader.vector3("position", kPlace);
  const Range tilt = Range::between(-89.0, 89.0);
  const double roll = reader.angle("roll_deg", tilt, 0.0);
  const double pitch = reader.angle("pitch_deg", tilt, 0.0);
  start.attitude = yawRotation(reader.angle("yaw_deg", Range::between(-360.0, 360.0)));
  if (roll != 0.0 || pitch != 0.0) {
    start.attitude = start.attitude * Eigen::AngleAxisd(pitch, Eigen::Vector3d::UnitY()) *
                     Eigen::AngleAxisd(roll, Eigen::Vector3d::UnitX());
  }
  return start;
}

// Payloads with a `place` lie there, on the ground, until they are picked up; the others appear
// when attached.
void readPayloads(const ParameterReader& reader, World& world) {
  for (const std::string& name : reader.keys()) {
    const ParameterReader entry = reader.child(name);
    const Payload payload = readPayload(entry);
    world.payloads[name] = payload;
    if (!entry.has("place")) continue;
    if (!world.ground) {
      entry.refuse("place", "is " + entry.valueText("place") +
                                ", on the ground, but 'ground' is false; leave one of them out");
    }
    const std::vector<double> place = entry.numbers("place", 2, kPlace);
    const Eigen::Vector3d position(place[0], place[1], 0.5 * payload.size.z());
    world.cargo.push_back({name, payload, position, Eigen::Vector3d::Zero()});
  }
}

Box readBox(const ParameterReader& reader) {
  Box box{reader.vector3("min", kPlace), reader.vector3("max", kPlace)};
  if (!((box.max - box.min).array() > 0.0).all()) {
    reader.refuseValue("max", "above 'min' " + reader.valueText("min") + " in every axis");
  }
  return box;
}

void checkRates(const ParameterReader& reader, const World& world) {
  if (world.control_period % world.plant_step == 0) return;
  reader.refuseValue("plant_rate", "a whole multiple of 'control_rate' " +
                                       reader.valueText("control_rate") + "; steps of " +
                                       std::to_string(world.plant_step) +
                                       " ns do not fill a control period of " +
                                       std::to_string(world.control_period) + " ns");
}

}  // namespace

Nanoseconds readPeriod(const ParameterReader& reader, const std::string& rate) {
  return fromSeconds(1.0 / reader.number(rate, Range::between(1.0, 1e5)));
}

Nanoseconds readCommandTimeout(const ParameterReader& reader, Nanoseconds control_period) {
  const Nanoseconds timeout = fromSeconds(reader.number("command_timeout", kTime));
  if (timeout != 0 && timeout <= control_period) {
    reader.refuseValue("command_timeout", "0 for none, or longer than the control period of " +
                                              numberText(toSeconds(control_period)) + " s");
  }
  return timeout;
}

World readWorld(const ParameterReader& scenario) {
  World world;
  world.control_period = readPeriod(scenario, "control_rate");
  world.plant_step = readPeriod(scenario, "plant_rate");
  checkRates(scenario, world);
  world.start = readStart(scenario.child("start"));
  world.ground = scenario.flag("ground", true);
  if (scenario.has("payloads")) readPayloads(scenario.child("payloads"), world);
  if (scenario.has("walls")) {
    for (const ParameterReader& wall : scenario.children("walls")) {
      world.walls.push_back(readBox(wall));
    }
  }
  if (scenario.has("rotors")) {
    const ParameterReader rotors = scenario.child("rotors");
    if (rotors.has("command_timeout")) {
      world.command_timeout = readCommandTimeout(rotors, world.control_period);
    }
  }
  if (scenario.has("sensors")) {
    world.sensors = readSensorFaults(scenario.child("sensors"), world.control_period);
  }
  return world;
}

std::unique_ptr<Plant> makePlant(const Vehicle& vehicle, const World& world) {
  return std::make_unique<FlexiblePlant>(vehicle, world.start, world.walls, world.ground);
}

}  // namespace aqc
