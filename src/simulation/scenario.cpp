#include "adaptive_quadrotor_control/simulation/scenario.h"

#include <algorithm>
#include <utility>

#include "adaptive_quadrotor_control/math/number_text.h"
#include "adaptive_quadrotor_control/math/rotations.h"
#include "adaptive_quadrotor_control/parameters/parameter_reader.h"
#include "adaptive_quadrotor_control/simulation/mission.h"

namespace aqc {
namespace {

constexpr double kLongest = 1e6;  // flight [s]

Nanoseconds readPeriod(const ParameterReader& reader, const std::string& key) {
  return fromSeconds(1.0 / reader.number(key, Range::between(1.0, 1e5)));
}

State readStart(const ParameterReader& reader) {
  State start;
  start.position = reader.vector3("position", Range::any());
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
std::map<std::string, Payload> readPayloads(const ParameterReader& reader, bool ground,
                                            std::vector<Cargo>& cargo) {
  std::map<std::string, Payload> payloads;
  for (const std::string& name : reader.keys()) {
    const ParameterReader entry = reader.child(name);
    payloads[name] = readPayload(entry);
    if (!entry.has("place")) continue;
    if (!ground) {
      entry.refuse("place", "is " + entry.valueText("place") +
                                ", on the ground, but 'ground' is false; leave one of them out");
    }
    const std::vector<double> place = entry.numbers("place", 2, Range::any());
    const double height = 0.5 * payloads[name].size.z();
    cargo.push_back({name, payloads[name], {place[0], place[1], height}, Eigen::Vector3d::Zero()});
  }
  return payloads;
}

Box readBox(const ParameterReader& reader) {
  Box box{reader.vector3("min", Range::any()), reader.vector3("max", Range::any())};
  if (!((box.max - box.min).array() > 0.0).all()) {
    reader.refuseValue("max", "above 'min' " + reader.valueText("min") + " in every axis");
  }
  return box;
}

RmsErrors readPublished(const ParameterReader& reader) {
  RmsErrors errors;
  errors.position = reader.vector3("position", Range::nonNegative());
  errors.attitude = reader.vector3("attitude_deg", Range::nonNegative());
  return errors;
}

void checkRates(const ParameterReader& reader, const Scenario& scenario) {
  if (scenario.control_period % scenario.plant_step == 0) return;
  reader.refuseValue("plant_rate", "a whole multiple of 'control_rate' " +
                                       reader.valueText("control_rate") + "; steps of " +
                                       std::to_string(scenario.plant_step) +
                                       " ns do not fill a control period of " +
                                       std::to_string(scenario.control_period) + " ns");
}

void checkDuration(const ParameterReader& reader, const Scenario& scenario) {
  Nanoseconds last = 0;
  if (!scenario.set_points.empty()) last = scenario.set_points.back().time;
  if (!scenario.events.empty()) last = std::max(last, scenario.events.back().time);
  if (!scenario.switches.empty()) last = std::max(last, scenario.switches.back().time);
  if (scenario.duration < last) {
    reader.refuseValue("duration", "no less than the mission, which lasts until " +
                                       numberText(toSeconds(last)) + " s");
  }
}

// RMS errors count from there to the end.
Nanoseconds readMetricsFrom(const ParameterReader& reader, Nanoseconds duration) {
  const Nanoseconds from = fromSeconds(reader.number("from", Range::between(0.0, kLongest)));
  if (from >= duration) {
    reader.refuseValue("from",
                       "before the end of the flight at " + numberText(toSeconds(duration)) + " s");
  }
  return from;
}

}  // namespace

Nanoseconds Scenario::lastPayloadChange() const {
  Nanoseconds last = 0;
  for (const PlantEvent& event : events) {
    const bool weather = std::holds_alternative<SetWind>(event.action) ||
                         std::holds_alternative<ApplyDisturbance>(event.action);
    if (!weather) last = event.time;
  }
  return last;
}

Scenario readScenario(const ParameterReader& reader) {
  Scenario scenario;
  scenario.name = reader.text("name");
  scenario.title = reader.text("title");
  scenario.vehicle = reader.text("vehicle");
  scenario.controllers = reader.texts("controllers");
  scenario.duration = fromSeconds(reader.number("duration", Range::positiveUpTo(kLongest)));
  scenario.control_period = readPeriod(reader, "control_rate");
  scenario.plant_step = readPeriod(reader, "plant_rate");
  checkRates(reader, scenario);
  scenario.start = readStart(reader.child("start"));

  scenario.ground = reader.flag("ground", true);
  std::map<std::string, Payload> payloads;
  if (reader.has("payloads")) {
    payloads = readPayloads(reader.child("payloads"), scenario.ground, scenario.cargo);
  }
  if (reader.has("walls")) {
    for (const ParameterReader& wall : reader.children("walls")) {
      scenario.walls.push_back(readBox(wall));
    }
  }
  SetPoint start;
  start.position = scenario.start.position;
  start.yaw = rollPitchYaw(scenario.start.attitude).z();
  Mission mission = readMission(reader, payloads, start, readPeriod(reader, "set_point_rate"));
  scenario.set_points = std::move(mission.set_points);
  scenario.events = std::move(mission.events);
  scenario.switches = std::move(mission.switches);
  checkDuration(reader, scenario);

  scenario.metrics_from = readMetricsFrom(reader.child("metrics"), scenario.duration);
  if (reader.has("published")) {
    const ParameterReader published = reader.child("published");
    for (const std::string& name : published.keys()) {
      scenario.published[name] = readPublished(published.child(name));
    }
  }
  return scenario;
}

Scenario loadScenario(const std::string& path) {
  const ParameterReader reader(loadYamlFile(path), path);
  Scenario scenario = readScenario(reader);
  reader.finish();
  return scenario;
}

}  // namespace aqc
