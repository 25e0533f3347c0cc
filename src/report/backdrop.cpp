#include "report/backdrop.h"

#include <variant>

namespace aqc {
namespace {

// Where the next sample would have been: with it the last one has lasted as long as the others.
Nanoseconds endOf(const FlightLog& log) {
  const auto& samples = log.samples;
  const Nanoseconds last = samples.back().time;
  return samples.size() < 2 ? last : 2 * last - samples[samples.size() - 2].time;
}

}  // namespace

Backdrop backdropOf(const Scenario& scenario) {
  Backdrop backdrop;
  backdrop.title = scenario.title;
  backdrop.duration = scenario.duration;
  backdrop.walls = scenario.world.walls;
  backdrop.mission = {scenario.world.start.position, scenario.world.start.position};
  for (const TimedSetPoint& timed : scenario.mission.set_points) {
    backdrop.mission.min = backdrop.mission.min.cwiseMin(timed.set_point.position);
    backdrop.mission.max = backdrop.mission.max.cwiseMax(timed.set_point.position);
  }
  for (const PlantEvent& event : scenario.mission.events) {
    const Overloaded add{
        [&](const AttachPayload& attach) {
          backdrop.payloads.push_back({event.time, std::nullopt, attach.payload.mass});
        },
        [&](const DetachPayload&) { backdrop.payloads.back().to = event.time; },
        [](const SetWind&) {},
        [](const SetBody&) {},
        [](const ApplyDisturbance&) {},
        [](const SetRotor&) {},
        [](const SetBattery&) {},
        [](const SetGust&) {},
        [](const LoseCommands&) {}};
    std::visit(add, event.action);
  }
  return backdrop;
}

Backdrop backdropOf(const FlightLog& log, const std::string& title) {
  Backdrop backdrop;
  backdrop.title = title;
  backdrop.duration = endOf(log);
  double mass = 0.0;
  for (const FlightSample& sample : log.samples) {
    if (sample.payload_mass == mass) continue;
    if (mass > 0.0) backdrop.payloads.back().to = sample.time;
    mass = sample.payload_mass;
    if (mass != 0.0) backdrop.payloads.push_back({sample.time, std::nullopt, mass});
  }
  return backdrop;
}

}  // namespace aqc
