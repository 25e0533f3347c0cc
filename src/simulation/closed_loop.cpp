#include "adaptive_quadrotor_control/simulation/closed_loop.h"

#include <algorithm>
#include <utility>

namespace aqc {

ClosedLoop::ClosedLoop(const Scenario& scenario, const Vehicle& vehicle,
                       std::unique_ptr<ControlLaw> law)
    : plant_(makePlant(vehicle, scenario.world), scenario.world.cargo, scenario.world.plant_step),
      pilot_(vehicle, std::move(law), scenario.world.control_period, StepClock::Trigger::kOdometry),
      period_(scenario.world.control_period),
      duration_(scenario.duration) {
  for (const PlantEvent& event : scenario.mission.events) plant_.schedule(event);
  for (const SwitchOrder& order : scenario.mission.switches) pilot_.order(order);
  pilot_.plan(scenario.mission.set_points, plant_.now(), plant_.now());
}

void ClosedLoop::advance() {
  const Nanoseconds now = plant_.now();
  truth_ = {now, plant_.plant().payloadMass(), plant_.plant().touching(), plant_.disturbance()};

  if (pilot_.law().usesSpecificForce()) pilot_.hear(plant_.plant().specificForce(), now);
  pilot_.hear(plant_.plant().state(), now, now);
  for (const SwitchReport& report : pilot_.objections()) {
    objections_.push_back({report.time, switchObjection(report, 0)});
  }
  plant_.advance(pilot_.allocation().speeds, std::min(now + period_, duration_));
}

FlightSample ClosedLoop::sample() const {
  FlightSample sample = pilot_.sample();
  sample.time = truth_.time;
  sample.payload_mass = truth_.payload_mass;
  sample.touching = truth_.touching;
  sample.disturbance = truth_.disturbance;
  return sample;
}

}  // namespace aqc
