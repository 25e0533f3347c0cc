#include "adaptive_quadrotor_control/pilot/pilot.h"

#include <algorithm>
#include <utility>

#include "adaptive_quadrotor_control/pilot/attitude_loop.h"
#include "adaptive_quadrotor_control/pilot/plan_gate.h"

namespace aqc {
namespace {

constexpr const char* kUnfelt = "no vehicle feels or turns so";

// Why a law with a loop that is unstable about this axis (null: none) must not be armed.
const char* unfit(const char* axis) noexcept {
  switch (axis == nullptr ? '\0' : axis[0]) {
    case '\0':
      return nullptr;
    case 'x':
      return "with its gains the attitude loop about x would be unstable";
    case 'y':
      return "with its gains the attitude loop about y would be unstable";
    default:
      return "with its gains the attitude loop about z would be unstable";
  }
}

}  // namespace

Pilot::Pilot(const Vehicle& vehicle, std::unique_ptr<ControlLaw> law, Nanoseconds period,
             StepClock::Trigger trigger, const PilotLimits& limits)
    : limits_(limits),
      clock_(period, trigger, limits.clock),
      controller_(vehicle, std::move(law)),
      monitor_(period, limits.monitor),
      load_(vehicle),
      imu_(limits.specific_force_age, limits.clock.new_start),
      inertia_(vehicle.inertia.diagonal()),
      least_lag_(std::min(vehicle.time_constant_up, vehicle.time_constant_down)) {
  if (!limits.guard) return;
  guarded_.emplace(Guarded{Guard(*limits.guard, vehicle.maxThrust()),
                           OdometryGate(limits.guard->gate), DeadReckoning(vehicle),
                           RotorObserver(vehicle), 1.0 / (vehicle.mass * kGravity)});
  controller_.bound({vehicle.maxThrust() / kGravity});
  guarded_->guard.judgeLaw(unfit(unstableAxis(this->law())));
}

const char* Pilot::unstableAxis(const ControlLaw& law) const {
  return aqc::unstableAxis(law, inertia_, least_lag_, toSeconds(clock_.period()));
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
  if (const Doubt doubt = judge(state); doubt != Doubt::kNone) {
    refuse(textOf(doubt));  // a step that is due is made without it
  } else {
    sensed_.state = state;
    located_ = true;
    monitor_.countOdometry(stamp, now);
  }
  if (due == StepClock::Answer::kRepeat) answer.publish = Publish::kLastCommand;
  if (due == StepClock::Answer::kStep) {
    step(stamp);
    answer.publish = Publish::kNewCommand;
  }
  return answer;
}

// Without a doubt all that a guard needs has taken the state over.
Doubt Pilot::judge(const State& state) noexcept {
  if (!guarded_) return Doubt::kNone;
  const Innovation innovation = innovationOf(state, guarded_->reckoning.state());
  const Doubt doubt = this->doubt(state, innovation);
  if (doubt == Doubt::kNone) takeOver(state, innovation);
  return doubt;
}

// Whether it disagrees with what the vehicle must be doing.
Doubt Pilot::doubt(const State& state, const Innovation& innovation) noexcept {
  if (!located_ || !guarded_->guard.flies()) return Doubt::kNone;
  if (OdometryGate::frozen(state, sensed_.state)) return Doubt::kFrozen;
  // What is reckoned from commands alone knows no ground to stand on.
  if (!guarded_->guard.airborne() && !guarded_->reckoning.feels()) return Doubt::kNone;
  if (guarded_->guard.mode() == Mode::kDescending && guarded_->gate.first(state)) {
    return Doubt::kFirst;
  }
  const Doubt doubt = guarded_->gate.compare(state, innovation, guarded_->silence);
  if (guarded_->gate.sourceReset()) {
    guarded_->guard.sourceReset(guarded_->reckoning.state(), state);
  }
  return doubt;
}

void Pilot::takeOver(const State& state, const Innovation& innovation) noexcept {
  guarded_->gate.believed();
  if (guarded_->guard.mode() == Mode::kDescending && guarded_->reckoning.feels()) {
    guarded_->guard.groundRose(guarded_->gate.unfeltRise(innovation, guarded_->silence));
  }
  guarded_->guard.heardOdometry(state);
  if (located_ && guarded_->silence < limits_.guard->odometry_late &&
      !guarded_->gate.sourceReset()) {
    guarded_->reckoning.correct(state, innovation);
  } else {
    guarded_->reckoning.restart(state);
  }
  guarded_->silence = 0.0;
}

Answer Pilot::hear(const Eigen::Vector3d& specific_force, const Eigen::Vector3d& body_rate,
                   Nanoseconds stamp) noexcept {
  if (const char* refusal = take(specific_force, body_rate, stamp)) {
    return {Publish::kNothing, refusal, false};
  }
  if (guarded_) {
    guarded_->reckoning.feel(specific_force, body_rate);
    guarded_->imu_silence = 0.0;
  }
  return stepIfAwaited();
}

Answer Pilot::hear(const Eigen::Vector3d& specific_force, Nanoseconds stamp) noexcept {
  if (const char* refusal = take(specific_force, std::nullopt, stamp)) {
    return {Publish::kNothing, refusal, false};
  }
  return stepIfAwaited();
}

// Null, or why the sample is refused; nobody may have seen it then.
const char* Pilot::take(const Eigen::Vector3d& specific_force,
                        const std::optional<Eigen::Vector3d>& body_rate,
                        Nanoseconds stamp) noexcept {
  const Eigen::Vector3d turning = body_rate.value_or(Eigen::Vector3d::Zero());
  if (guarded_ && !guarded_->gate.believes(specific_force, turning)) return kUnfelt;
  return imu_.take(specific_force, stamp, body_rate) ? nullptr
                                                     : "it is not finite or its stamp goes back";
}

// The step that waited for a sample.
Answer Pilot::stepIfAwaited() noexcept {
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
  const char* axis = guarded_ ? unstableAxis(*law) : nullptr;
  if (flying() && axis != nullptr) {
    return std::string("with these gains of '") + law->name() + "' the attitude loop about " +
           axis + " would be unstable: errors grow from step to step, given the rotors' lag";
  }
  if (flying() && another) {
    const std::string obstacle =
        handoverObstacle(this->law().telemetry(), allocation().saturated, limits_.handover);
    if (!obstacle.empty()) {
      return std::string("'") + law->name() + "' cannot take over from '" + this->law().name() +
             "' now: " + obstacle;
    }
  }
  law = controller_.replaceLaw(std::move(law));
  if (guarded_) guarded_->guard.judgeLaw(unfit(axis));
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
