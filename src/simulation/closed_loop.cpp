#include "adaptive_quadrotor_control/simulation/closed_loop.h"

#include <algorithm>
#include <utility>

namespace aqc {

ClosedLoop::ClosedLoop(const Scenario& scenario, const Vehicle& vehicle,
                       std::unique_ptr<ControlLaw> law, const PilotLimits& limits)
    : ClosedLoop(scenario, vehicle, vehicle, std::move(law), limits) {}

ClosedLoop::ClosedLoop(const Scenario& scenario, const Vehicle& flown, const Vehicle& believed,
                       std::unique_ptr<ControlLaw> law, const PilotLimits& limits)
    : plant_(makePlant(flown, scenario.world), scenario.world.cargo, scenario.world.plant_step, 0,
             scenario.world.command_timeout.value_or(0)),
      pilot_(believed, std::move(law), scenario.world.control_period,
             scenario.world.sensors || limits.guard ? StepClock::Trigger::kTimer
                                                    : StepClock::Trigger::kOdometry,
             limits),
      period_(scenario.world.control_period),
      plant_step_(scenario.world.plant_step),
      duration_(scenario.duration) {
  if (const std::optional<SensorFaults>& sensors = scenario.world.sensors) {
    channels_.emplace(*sensors, plant_.now());
  }
  for (const PlantEvent& event : scenario.mission.events) plant_.schedule(event);
  for (const SwitchOrder& order : scenario.mission.switches) pilot_.order(order);
  if (Guard* guard = pilot_.guard()) {
    set_points_ = scenario.mission.set_points;
    guard->wasArmed();
  } else {
    pilot_.plan(scenario.mission.set_points, plant_.now(), plant_.now());
  }
}

void ClosedLoop::takeOff() {
  Guard* guard = pilot_.guard();
  if (guard == nullptr || taken_off_) return;
  if (!guard->armed()) guard->arm();
  if (!guard->airborne() && guard->takeOff() != nullptr) return;
  taken_off_ = true;
  if (!set_points_.empty()) pilot_.plan(std::move(set_points_), plant_.now(), plant_.now());
}

void ClosedLoop::feelImu(const Eigen::Vector3d& specific_force, const Eigen::Vector3d& body_rate,
                         Nanoseconds stamp) {
  if (pilot_.guard() != nullptr || pilot_.law().usesGyroscope()) {
    pilot_.hear(specific_force, body_rate, stamp);
  } else {
    pilot_.hear(specific_force, stamp);
  }
}

void ClosedLoop::advance() {
  const Nanoseconds now = plant_.now();
  truth_ = {now, plant_.plant().payloadMass(), plant_.plant().touching(), plant_.disturbance()};

  if (channels_) {
    listen();
  } else {
    const State state = plant_.plant().state();
    if (pilot_.guard() != nullptr || pilot_.law().usesSpecificForce()) {
      feelImu(plant_.plant().specificForce(), state.body_rate, now);
    }
    pilot_.hear(state, now, now);
  }
  takeOff();
  if (pilot_.stepClock().trigger() == StepClock::Trigger::kTimer) pilot_.tick(now);
  plant_.command(pilot_.allocation().speeds);
  for (const SwitchReport& report : pilot_.objections()) {
    objections_.push_back({report.time, switchObjection(report, 0)});
  }
  const Nanoseconds until = std::min(now + period_, duration_);
  if (channels_) {
    SensorChannels::advance(plant_, plant_step_, until, [this] { listen(); });
  } else {
    plant_.advance(until);
  }
}

// Whatever the sensors measure and the pilot hears at this instant.
void ClosedLoop::listen() {
  channels_->listen(
      plant_,
      [this](const ImuMessage& message) {
        feelImu(message.specific_force, message.body_rate, message.stamp);
      },
      [this](const OdometryMessage& message) {
        pilot_.hear(message.state, message.stamp, plant_.now());
      });
}

FlightSample ClosedLoop::sample() const {
  FlightSample sample = pilot_.sample();
  sample.time = truth_.time;
  addTruth(truth_, sample);
  return sample;
}

}  // namespace aqc
