#include "adaptive_quadrotor_control/pilot/pilot.h"

#include <algorithm>
#include <utility>

#include "adaptive_quadrotor_control/pilot/plan_gate.h"

namespace aqc {
namespace {

constexpr double kImuSilence = 0.1;  // [s]: an IMU older than this is not felt any more
constexpr double kWeighing = 1.0;    // [s], time constant
constexpr double kLeastMass = 0.1;   // [kg]
// Blind, without an accelerometer, a vehicle must rather sink than climb for ever.
constexpr double kBlindLightness = 0.98;
constexpr const char* kUnfelt = "no vehicle feels or turns so";
constexpr double kStreamPause = 0.5;  // [s]: a stream of single set points has ended

}  // namespace

Pilot::Pilot(const Vehicle& vehicle, std::unique_ptr<ControlLaw> law, Nanoseconds period,
             StepClock::Trigger trigger, const PilotLimits& limits)
    : limits_(limits),
      clock_(period, trigger, limits.clock),
      controller_(vehicle, std::move(law)),
      monitor_(period, vehicle.maxThrust() / kGravity, limits.monitor),
      imu_(limits.specific_force_age, limits.clock.new_start) {
  if (!limits.guard) return;
  guarded_.emplace(Guarded{Guard(*limits.guard, vehicle.maxThrust()),
                           OdometryGate(limits.guard->gate), DeadReckoning(vehicle), vehicle.mass});
  controller_.bound({vehicle.maxThrust() / kGravity});
}

bool Pilot::awaitsImu(Nanoseconds stamp) const noexcept {
  return law().usesSpecificForce() && imu_.awaits(stamp);
}

Answer Pilot::hear(const State& heard, Nanoseconds stamp, Nanoseconds now) noexcept {
  State state = heard;
  Answer answer;
  const auto refuse = [&](const char* reason) {
    countRefusedOdometry();
    answer.refusal = reason;
    return answer;
  };
  if (guarded_) {
    const Doubt doubt = guarded_->gate.look(state, stamp, now);
    if (doubt != Doubt::kNone) return refuse(textOf(doubt));
  } else if (!state.valid()) {
    return refuse("it is not finite or not a pose");
  }
  StepClock::Answer due = clock_.hear(stamp, awaitsImu(stamp));
  if (due == StepClock::Answer::kRestart) {
    beginAnew();
    answer.began_anew = true;
    due = clock_.hear(stamp, awaitsImu(stamp));
  }
  if (due == StepClock::Answer::kDrop) return refuse("its stamp goes back");
  if (const Doubt doubt = this->doubt(state); doubt != Doubt::kNone) {
    refuse(textOf(doubt));  // a step that is due is made without it
  } else {
    takeOver(state);
    monitor_.countOdometry(stamp, now);
  }
  if (due == StepClock::Answer::kRepeat) answer.publish = Publish::kLastCommand;
  if (due == StepClock::Answer::kStep) {
    step(stamp);
    answer.publish = Publish::kNewCommand;
  }
  return answer;
}

// Whether it disagrees with what the vehicle must be doing.
Doubt Pilot::doubt(const State& state) noexcept {
  if (!guarded_ || !located_ || !guarded_->guard.flies()) return Doubt::kNone;
  if (OdometryGate::frozen(state, sensed_.state)) return Doubt::kFrozen;
  if (!guarded_->guard.airborne()) return Doubt::kNone;
  const State expected = guarded_->reckoning.state();
  const Doubt doubt = guarded_->gate.compare(state, expected, guarded_->silence);
  if (guarded_->gate.sourceReset()) guarded_->guard.sourceReset(expected, state);
  return doubt;
}

void Pilot::takeOver(const State& state) noexcept {
  const bool follows = located_;
  sensed_.state = state;
  located_ = true;
  if (!guarded_) return;
  guarded_->guard.heardOdometry(state);
  if (follows && guarded_->silence < limits_.guard->odometry_late &&
      !guarded_->gate.sourceReset()) {
    guarded_->reckoning.correct(state);
  } else {
    guarded_->reckoning.restart(state);
  }
  guarded_->silence = 0.0;
}

Answer Pilot::hear(const Eigen::Vector3d& specific_force, const Eigen::Vector3d& body_rate,
                   Nanoseconds stamp) noexcept {
  if (guarded_) {
    if (!guarded_->gate.believes(specific_force, body_rate)) {
      return {Publish::kNothing, kUnfelt, false};
    }
    guarded_->reckoning.feel(specific_force, body_rate);
    guarded_->imu_silence = 0.0;
  }
  return hear(specific_force, stamp);
}

Answer Pilot::hear(const Eigen::Vector3d& specific_force, Nanoseconds stamp) noexcept {
  if (guarded_ && !guarded_->gate.believes(specific_force, Eigen::Vector3d::Zero())) {
    return {Publish::kNothing, kUnfelt, false};
  }
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

Publish Pilot::watch(Nanoseconds now) noexcept {
  if (!guarded_ || now - clock_.stepTime() < 2 * clock_.period()) return Publish::kNothing;
  return tick(now);
}

void Pilot::beginAnew() noexcept {
  schedule_ = SetPointSchedule();
  switches_.clear();
  monitor_.countNewStart();
  if (guarded_) {
    const bool in_the_air = guarded_->guard.airborne();
    guarded_->guard.clockStepped();
    guarded_->gate.forget();
    if (in_the_air) return;  // what the law learned still holds
  }
  if (SubsystemSwitch* subsystems = controller_.subsystems()) subsystems->restart();
  last_objection_.reset();
  controller_.step(Sensed(), nullptr, toSeconds(clock_.period()));  // the law forgets
}

void Pilot::release() noexcept {
  schedule_ = SetPointSchedule();
  if (guarded_) guarded_->guard.planReleased();
}

void Pilot::step(Nanoseconds now) noexcept {
  if (guarded_) {
    stepGuarded(now);
  } else {
    stepUnguarded(now);
  }
}

Situation Pilot::situation(const SetPoint* planned, double dt) const noexcept {
  const Guarded& guarded = *guarded_;
  Situation now;
  now.dt = dt;
  if (located_) {
    const bool fresh = guarded.silence < limits_.guard->odometry_late;
    now.state = fresh ? &sensed_.state : &guarded.reckoning.state();
  }
  now.silence = guarded.silence;
  now.feels = guarded.reckoning.feels();
  if (now.feels) {
    now.support = guarded.reckoning.feltLift() / kGravity -
                  controller_.given().thrust / (guarded.empty_mass * kGravity);
  }
  now.planned = planned;
  now.plan_ended =
      schedule_.pending() == 0 && (!guarded.streamed || guarded.plan_age > kStreamPause);
  now.plan_age = guarded.plan_age;
  now.given = &allocation();
  now.mass = law().telemetry().liftedMass();
  now.law_finite = law().finite() && law().telemetry().force.allFinite();
  return now;
}

// What the rotors hold up while odometry tells that they do: the mass that dead reckoning without
// an accelerometer needs. A law's own estimate may differ by what its other terms carry.
void Pilot::weigh(double dt) noexcept {
  Guarded& guarded = *guarded_;
  const Wrench given = controller_.given();
  const double lift = given.thrust * (sensed_.state.attitude * Eigen::Vector3d::UnitZ()).z();
  if (!guarded.guard.airborne()) {
    guarded.mass = std::max(law().telemetry().liftedMass(), kLeastMass);
  } else if (guarded.silence < limits_.guard->odometry_late) {
    guarded.mass += std::min(dt / kWeighing, 1.0) * (lift / kGravity - guarded.mass);
    guarded.mass = std::max(guarded.mass, kLeastMass);
  }
}

void Pilot::stepGuarded(Nanoseconds now) noexcept {
  Guarded& guarded = *guarded_;
  const double dt = clock_.begin(now, guarded.guard.armed());
  if (guarded.imu_silence > kImuSilence) guarded.reckoning.feelNothing();
  const SetPoint* planned = located_ ? schedule_.at(now) : nullptr;
  const Situation situation = this->situation(planned, dt);
  const Decision decision = guarded.guard.step(situation);
  switchSubsystem(now);
  sense(now);
  if (decision.stands) guarded.reckoning.stand();
  if (decision.forget) controller_.forget();
  if (decision.set_point != nullptr) {
    set_point_ = *decision.set_point;
    Sensed sensed = sensed_;
    if (situation.state != &sensed_.state) {  // that of dead reckoning, which is of now
      sensed.state = *situation.state;
      sensed.ages.pose = sensed.ages.body_rate = 0.0;
    }
    controller_.step(sensed, decision.set_point, dt, decision.learn);
  } else {
    controller_.idle(decision.idle, dt);
  }
  weigh(dt);
  const double lightness = guarded.reckoning.feels() ? 1.0 : kBlindLightness;
  guarded.reckoning.advance(controller_.given(), lightness * guarded.mass, dt);
  guarded.silence += dt;
  guarded.imu_silence += dt;
  guarded.plan_age += dt;
  monitor_.countStep(now, flying(), law().telemetry(), allocation().saturated);
}

void Pilot::stepUnguarded(Nanoseconds now) noexcept {
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
  requireValid(set_points);
  if (guarded_) requireSafe(set_points, now, stamp, limits_.trajectory_age, *limits_.guard);
  const bool streamed = set_points.size() == 1;
  schedule_.replace(now, std::move(set_points));
  if (guarded_) {
    guarded_->streamed = streamed;
    guarded_->plan_age = 0.0;
    guarded_->guard.heardPlan();
  }
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

void Pilot::countRefusedOdometry() noexcept {
  ++dropped_odometry_;
  monitor_.countDroppedOdometry();
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
  if (!this->law().usesSpecificForce()) imu_.forget();  // its samples stop here
  return "";
}

std::vector<Finding> Pilot::judge(Nanoseconds now, double silence) {
  std::vector<Finding> findings = monitor_.judge(now, silence);
  if (guarded_) findings.push_back(guarded_->guard.judge());
  return findings;
}

std::vector<std::string> Pilot::findingNames() const {
  std::vector<std::string> names = FlightMonitor::names();
  if (guarded_) names.push_back(guarded_->guard.judge().name);
  return names;
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
