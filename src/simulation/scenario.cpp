#include "adaptive_quadrotor_control/simulation/scenario.h"

#include <algorithm>

#include "adaptive_quadrotor_control/math/number_text.h"
#include "adaptive_quadrotor_control/math/rotations.h"
#include "adaptive_quadrotor_control/parameters/parameter_reader.h"
#include "simulation/ranges.h"

namespace aqc {
namespace {

RmsErrors readPublished(const ParameterReader& reader) {
  RmsErrors errors;
  errors.position = reader.vector3("position", Range::between(0.0, kPlace.max));
  errors.attitude = reader.vector3("attitude_deg", Range::between(0.0, 360.0));
  return errors;
}

// Standing there.
SetPoint setPointAt(const State& state) {
  SetPoint set_point;
  set_point.position = state.position;
  set_point.yaw = rollPitchYaw(state.attitude).z();
  return set_point;
}

void checkDuration(const ParameterReader& reader, const Scenario& scenario) {
  const Mission& mission = scenario.mission;
  Nanoseconds last = 0;
  if (!mission.set_points.empty()) last = mission.set_points.back().time;
  if (!mission.events.empty()) last = std::max(last, mission.events.back().time);
  if (!mission.switches.empty()) last = std::max(last, mission.switches.back().time);
  if (scenario.duration < last) {
    reader.refuseValue("duration", "no less than the mission, which lasts until " +
                                       numberText(toSeconds(last)) + " s");
  }
}

// RMS errors count from there to the end.
Nanoseconds readMetricsFrom(const ParameterReader& reader, Nanoseconds duration) {
  const Nanoseconds from = fromSeconds(reader.number("from", kTime));
  if (from >= duration) {
    reader.refuseValue("from",
                       "before the end of the flight at " + numberText(toSeconds(duration)) + " s");
  }
  return from;
}

}  // namespace

Nanoseconds Scenario::lastPayloadChange() const {
  const Overloaded changes_payload{
      [](const AttachPayload&) { return true; },     [](const DetachPayload&) { return true; },
      [](const SetBody&) { return true; },           [](const SetWind&) { return false; },
      [](const ApplyDisturbance&) { return false; }, [](const SetRotor&) { return false; },
      [](const SetBattery&) { return false; },       [](const SetGust&) { return false; },
      [](const LoseCommands&) { return false; }};
  Nanoseconds last = 0;
  for (const PlantEvent& event : mission.events) {
    if (std::visit(changes_payload, event.action)) last = event.time;
  }
  return last;
}

MetricsWindow metricsWindow(const Scenario& scenario) {
  return {scenario.metrics_from, scenario.lastPayloadChange(), scenario.duration};
}

Scenario readScenario(const ParameterReader& reader) {
  Scenario scenario;
  scenario.name = reader.text("name");
  scenario.title = reader.text("title");
  scenario.vehicle = reader.text("vehicle");
  scenario.controllers = reader.texts("controllers");
  scenario.duration = fromSeconds(reader.number("duration", Range::positiveUpTo(kTime.max)));
  scenario.world = readWorld(reader);
  scenario.mission = readMission(reader, scenario.world.payloads, setPointAt(scenario.world.start),
                                 readPeriod(reader, "set_point_rate"));
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

World readWorldAlone(const ParameterReader& reader) {
  for (const char* other : {"name", "title", "vehicle", "controllers", "duration", "set_point_rate",
                            "mission", "metrics", "published"}) {
    reader.skip(other);
  }
  return readWorld(reader);
}

Scenario loadScenario(const std::string& path) {
  const ParameterReader reader(loadYamlFile(path), path);
  Scenario scenario = readScenario(reader);
  reader.finish();
  return scenario;
}

}  // namespace aqc
