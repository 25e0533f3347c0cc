#include "adaptive_quadrotor_control/simulation/closed_loop.h"

#include <algorithm>
#include <utility>

namespace aqc {

ClosedLoop::ClosedLoop(const Scenario& scenario, const Vehicle& vehicle,
                       std::unique_ptr<ControlLaw> law)
    : plant_(Plant(vehicle, scenario.start, scenario.walls, scenario.ground), scenario.cargo,
             scenario.plant_step),
      controller_(vehicle, std::move(law)),
      schedule_(scenario.set_points),
      period_(scenario.control_period),
      duration_(scenario.duration) {
  for (const PlantEvent& event : scenario.events) plant_.schedule(event);
  for (const SwitchOrder& order : scenario.switches) switches_.plan(order);
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

}  // namespace aqc
