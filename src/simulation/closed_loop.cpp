#include "adaptive_quadrotor_control/simulation/closed_loop.h"

#include <algorithm>
#include <utility>

namespace aqc {

ClosedLoop::ClosedLoop(const Scenario& scenario, const Vehicle& vehicle,
                       std::unique_ptr<ControlLaw> law)
    : plant_(makePlant(vehicle, scenario.world), scenario.world.cargo, scenario.world.plant_step),
      pilot_(vehicle, std::move(law), scenario.world.control_period,
             scenario.world.sensors ? StepClock::Trigger::kTimer : StepClock::Trigger::kOdometry),
      period_(scenario.world.control_period),
      plant_step_(scenario.world.plant_step),
      duration_(scenario.duration) {
  if (const std::optional<SensorFaults>& sensors = scenario.world.sensors) {
    channels_ = {OdometryChannel(sensors->odometry, sensors->seed, plant_.now()),
                 ImuChannel(sensors->imu, sensors->seed, plant_.now())};
  }
  for (const PlantEvent& event : scenario.mission.events) plant_.schedule(event);
  for (const SwitchOrder& order : scenario.mission.switches) pilot_.order(order);
  pilot_.plan(scenario.mission.set_points, plant_.now(), plant_.now());
}

void ClosedLoop::advance() {
  const Nanoseconds now = plant_.now();
  truth_ = {now, plant_.plant().payloadMass(), plant_.plant().touching(), plant_.disturbance()};

  if (channels_) {
    listen();
    pilot_.tick(now);
  } else {
    if (pilot_.law().usesSpecificForce()) pilot_.hear(plant_.plant().specificForce(), now);
    pilot_.hear(plant_.plant().state(), now, now);
  }
  for (const SwitchReport& report : pilot_.objections()) {
    objections_.push_back({report.time, switchObjection(report, 0)});
  }
  const Nanoseconds until = std::min(now + period_, duration_);
  if (channels_) return advanceThroughChannels(until);
  plant_.advance(pilot_.allocation().speeds, until);
}

// Whatever the sensors measure and the pilot hears at this instant.
void ClosedLoop::listen() {
  const Nanoseconds now = plant_.now();
  const State state = plant_.plant().state();
  channels_->imu.observe(plant_.plant().specificForce(), state.body_rate, now);
  channels_->odometry.observe(state, now);
  while (const std::optional<ImuMessage> message = channels_->imu.receive(now)) {
    pilot_.hear(message->specific_force, message->stamp);
  }
  while (const std::optional<OdometryMessage> message = channels_->odometry.receive(now)) {
    pilot_.hear(message->state, message->stamp, now);
  }
}

void ClosedLoop::advanceThroughChannels(Nanoseconds until) {
  while (plant_.now() < until) {
    plant_.advance(pilot_.allocation().speeds, std::min(plant_.now() + plant_step_, until));
    if (plant_.now() < until) listen();
  }
}

FlightSample ClosedLoop::sample() const {
  FlightSample sample = pilot_.sample();
  sample.time = truth_.time;
  addTruth(truth_, sample);
  return sample;
}

}  // namespace aqc
