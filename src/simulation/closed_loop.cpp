#include "adaptive_quadrotor_control/simulation/closed_loop.h"

#include <algorithm>
#include <utility>

namespace aqc {

ClosedLoop::ClosedLoop(const Scenario& scenario, const Vehicle& vehicle,
                       std::unique_ptr<ControlLaw> law)
    : plant_(makePlant(vehicle, scenario.world), scenario.world.cargo, scenario.world.plant_step),
      controller_(vehicle, std::move(law)),
      schedule_(scenario.mission.set_points),
      period_(scenario.world.control_period),
      duration_(scenario.duration) {
  for (const PlantEvent& event : scenario.mission.events) plant_.schedule(event);
  for (const SwitchOrder& order : scenario.mission.switches) switches_.plan(order);
}

void ClosedLoop::switchSubsystem() {
  SubsystemSwitch* subsystems = controller_.subsystems();
  if (subsystems == nullptr) return;
  while (const auto report = switches_.next(*subsystems, plant_.now())) {
    if (!report->objected()) continue;
    const std::string outcome = toString(report->verdict.outcome);
    objections_.push_back({report->time, switchObjection(report->order.subsystem, outcome,
                                                         report->allowed, report->time, 0)});
  }
}

void ClosedLoop::advance() {
  const SetPoint* set_point = schedule_.at(plant_.now());
  last_.time = plant_.now();
  last_.state = plant_.plant().state();
  last_.flying = set_point != nullptr;
  if (last_.flying) last_.set_point = *set_point;
  last_.touching = plant_.plant().touching();
  last_.payload_mass = plant_.plant().payloadMass();
  last_.disturbance = plant_.disturbance();

  switchSubsystem();
  if (controller_.law().needsImu()) {
    controller_.senseSpecificForce(plant_.plant().specificForce());
  }
  const Allocation& allocation = controller_.step(last_.state, set_point, toSeconds(period_));
  plant_.advance(allocation.speeds, std::min(plant_.now() + period_, duration_));
}

FlightSample ClosedLoop::sample() const {
  FlightSample sample = last_;
  sample.telemetry = controller_.law().telemetry();
  sample.allocation = controller_.allocation();
  return sample;
}

FlightLog fly(const Scenario& scenario, const Vehicle& vehicle, const std::string& controller_name,
              std::unique_ptr<ControlLaw> law, const std::function<void(double)>& progress) {
  ClosedLoop loop(scenario, vehicle, std::move(law));
  FlightLog log;
  log.controller = controller_name;
  log.adaptive_names = loop.controller().law().adaptiveNames();
  if (const SubsystemSwitch* subsystems = loop.controller().subsystems()) {
    log.dwell_time = subsystems->text();
  }
  while (!loop.done()) {
    loop.advance();
    log.samples.push_back(loop.sample());
    if (progress) {
      progress(static_cast<double>(loop.plant().now()) / static_cast<double>(scenario.duration));
    }
  }
  log.refusals = loop.plant().refusals();
  log.refusals.insert(log.refusals.end(), loop.objections().begin(), loop.objections().end());
  const auto earlier = [](const auto& a, const auto& b) { return a.time < b.time; };
  std::stable_sort(log.refusals.begin(), log.refusals.end(), earlier);
  log.crash_time = loop.plant().crashTime();
  if (log.crash_time) log.crash_reason = toString(loop.plant().plant().crash());
  return log;
}

}  // namespace aqc
