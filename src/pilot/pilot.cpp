#include "adaptive_quadrotor_control/pilot/pilot.h"

#include <utility>

namespace aqc {

Pilot::Pilot(const Vehicle& vehicle, std::unique_ptr<ControlLaw> law, Nanoseconds period,
             StepClock::Trigger trigger, const PilotLimits& limits)
    : limits_(limits),
      clock_(period, trigger, limits.clock),
      controller_(vehicle, std::move(law)),
      monitor_(period, vehicle.maxThrust() / kGravity, limits.monitor),
      imu_(limits.specific_force_age, limits.clock.new_start) {}

bool Pilot::awaitsImu(Nanoseconds stamp) const noexcept {
  return law().usesSpecificForce() && imu_.awaits(stamp);
}

Answer Pilot::hear(const State& state, Nanoseconds stamp, Nanoseconds now) noexcept {
  Answer answer;
  const auto refuse = [&](const char* reason) {
    ++dropped_odometry_;
    monitor_.countDroppedOdometry();
    answer.refusal = reason;
    return answer;
  };
  if (!state.valid()) return refuse("it is not finite or not a pose");
  StepClock::Answer due = clock_.hear(stamp, awaitsImu(stamp));
  if (due == StepClock::Answer::kRestart) {
    beginAnew();
    answer.began_anew = true;
    due = clock_.hear(stamp, awaitsImu(stamp));
  }
  if (due == StepClock::Answer::kDrop) return refuse("its stamp goes back");
  sensed_.state = state;
  located_ = true;
  monitor_.countOdometry(stamp, now);
  if (due == StepClock::Answer::kRepeat) answer.publish = Publish::kLastCommand;
  if (due == StepClock::Answer::kStep) {
    step(stamp);
    answer.publish = Publish::kNewCommand;
  }
  return answer;
}

Answer Pilot::hear(const Eigen::Vector3d& specific_force, Nanoseconds stamp) noexcept {
  if (!imu_.take(specific_force, stamp)) {
    return {Publish::kNothing, "it is not finite or its stamp goes back", false};
  }
  const Nanoseconds odometry_time = clock_.odometryTime();
  if (!clock_.waiting() || !imu_.covers(odometry_time)) return {};
  step(odometry_time);
  return {Publish::kNewCommand, nullptr, false};
}

Publish Pilot::tick(Nanoseconds now) noexcept {
  step(now);
  return Publish::kNewCommand;
}

void Pilot::beginAnew() noexcept {
  schedule_ = SetPointSchedule();
  switches_.clear();
  if (SubsystemSwitch* subsystems = controller_.subsystems()) subsystems->restart();
  last_objection_.reset();
  controller_.step(Sensed(), nullptr, toSeconds(clock_.period()));  // the law forgets
  monitor_.countNewStart();
}

void Pilot::step(Nanoseconds now) noexcept {
  const SetPoint* set_point = located_ ? schedule_.at(now) : nullptr;
  if (set_point != nullptr) set_point_ = *set_point;
  const double dt = clock_.begin(now, set_point != nullptr);
  switchSubsystem(now);
  sense(now);
  const Allocation& allocation = controller_.step(sensed_, set_point, dt);
  monitor_.countStep(now, flying(), law().telemetry(), allocation.saturated);
}

void Pilot::switchSubsystem(Nanoseconds now) noexcept {
  objections_.clear();
  SubsystemSwitch* subsystems = controller_.subsystems();
  if (subsystems == nullptr) return;
  while (const auto report = switches_.next(*subsystems, now)) {
    if (!report->objected()) continue;
    objections_.push_back(*report);  // order() has made room
    last_objection_ = *report;
  }
}

void Pilot::sense(Nanoseconds now) noexcept {
  const Nanoseconds odometry_time = clock_.odometryTime();
  sensed_.ages.pose = sensed_.ages.body_rate = toSeconds(now - odometry_time);
  sensed_.specific_force.reset();
  if (!law().usesSpecificForce()) return;
  if (const Eigen::Vector3d* specific_force = imu_.at(odometry_time)) {
    sensed_.specific_force = *specific_force;
    sensed_.ages.specific_force = toSeconds(now - imu_.time());
  }
}

void Pilot::plan(std::vector<TimedSetPoint> set_points, Nanoseconds now, Nanoseconds stamp) {
  schedule_.replace(now, std::move(set_points));
  set_point_stamp_ = stamp;
  monitor_.countSetPoint(now);
}

Nanoseconds Pilot::beginning(Nanoseconds stamp, Nanoseconds now) const noexcept {
  return stamp + limits_.trajectory_age > now ? stamp : now;
}

void Pilot::countRefusedSetPoints() noexcept {
  ++dropped_set_points_;
  monitor_.countDroppedSetPoint();
}

bool Pilot::order(const SwitchOrder& order) {
  if (!switches_.plan(order)) return false;
  objections_.reserve(switches_.pending());
  return true;
}

std::string Pilot::handOver(std::unique_ptr<ControlLaw>& law) {
  const bool another = law->name() != std::string(this->law().name());
  if (flying() && another) {
    const std::string obstacle =
        handoverObstacle(this->law().telemetry(), allocation().saturated, limits_.handover);
    if (!obstacle.empty()) {
      return std::string("'") + law->name() + "' cannot take over from '" + this->law().name() +
             "' now: " + obstacle;
    }
  }
  law = controller_.replaceLaw(std::move(law));
  return "";
}

FlightSample Pilot::sample() const {
  FlightSample sample;
  sample.time = clock_.odometryTime();
  sample.state = sensed_.state;
  sample.flying = flying();
  sample.set_point = set_point_;
  sample.telemetry = law().telemetry();
  sample.allocation = allocation();
  return sample;
}

}  // namespace aqc
