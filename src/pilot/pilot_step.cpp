// One step of Pilot, with a guard and without.

#include <algorithm>

#include "adaptive_quadrotor_control/math/rotations.h"
#include "adaptive_quadrotor_control/pilot/pilot.h"

namespace aqc {
namespace {

constexpr double kImuSilence = 0.1;  // [s]: an IMU older than this is not felt any more
// Older odometry is worse than what the IMU makes of it: laws bear delays of 20 ms or so [s].
constexpr double kStale = 0.03;
constexpr double kWeighing = 1.0;  // [s], time constant
constexpr double kPerGravity = 1.0 / kGravity;
constexpr double kLeastMass = 0.1;  // [kg]
// Blind, without an accelerometer, a vehicle must rather sink than climb for ever.
constexpr double kBlindLightness = 0.98;
constexpr double kStreamPause = 0.5;  // [s]: a stream of single set points has ended

}  // namespace

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
    const double late = limits_.guard->odometry_late;
    const bool fresh =
        guarded.silence < (guarded.reckoning.feels() ? std::min(kStale, late) : late);
    now.state = fresh ? &sensed_.state : &guarded.reckoning.state();
  }
  now.silence = guarded.silence;
  now.feels = guarded.reckoning.feels();
  if (now.feels) {
    now.support =
        guarded.reckoning.feltLift() * kPerGravity - guarded.given.thrust * guarded.per_weight;
  }
  now.planned = planned;
  now.plan_ended =
      schedule_.pending() == 0 && (!guarded.streamed || guarded.plan_age > kStreamPause);
  now.plan_age = guarded.plan_age;
  now.given = &allocation();
  now.load = load_.load();
  // Of rotors that hover with what they carry: a load off the centre turns the body, too.
  const double laden = guarded.mass * kGravity * guarded.per_weight;
  now.missing_rotors = guarded.rotors.missing() / std::max(laden, 1.0);
  now.law_finite = law().finite() && law().telemetry().force.allFinite();
  return now;
}

// What the rotors hold up while odometry tells that they do: the mass that dead reckoning without
// an accelerometer needs. A law's own estimate may differ by what its other terms carry.
void Pilot::weigh(double dt) noexcept {
  Guarded& guarded = *guarded_;
  if (!guarded.guard.airborne()) {
    guarded.mass = std::max(law().telemetry().liftedMass(), kLeastMass);
  } else if (guarded.silence < limits_.guard->odometry_late) {
    const double lift = guarded.given.thrust * uprightness(sensed_.state.attitude);
    guarded.mass += std::min(dt / kWeighing, 1.0) * (lift * kPerGravity - guarded.mass);
    guarded.mass = std::max(guarded.mass, kLeastMass);
  }
}

// What the rotors should have given since the last step against what the body did.
void Pilot::observeRotors(double dt) noexcept {
  Guarded& guarded = *guarded_;
  const bool feels = guarded.reckoning.feels();
  const Eigen::Vector3d& rate =
      feels ? guarded.reckoning.state().body_rate : sensed_.state.body_rate;
  if (guarded.guard.airborne() && (feels || guarded.silence < kStale)) {
    guarded.rotors.observe(rate, guarded.given.moment, dt);
  } else {
    guarded.rotors.restart(rate);
  }
}

void Pilot::stepGuarded(Nanoseconds now) noexcept {
  Guarded& guarded = *guarded_;
  const double dt = clock_.begin(now, guarded.guard.armed());
  if (guarded.imu_silence > kImuSilence) guarded.reckoning.feelNothing();
  observeRotors(dt);
  const SetPoint* planned = located_ ? schedule_.at(now) : nullptr;
  const Situation situation = this->situation(planned, dt);
  const Decision decision = guarded.guard.step(situation);
  switchSubsystem(now);
  Sensed sensed = sense(now);
  if (decision.stands) guarded.reckoning.stand();
  if (decision.forget) controller_.forget();
  if (decision.set_point != nullptr) {
    set_point_ = *decision.set_point;
    if (situation.state != &sensed_.state) {  // that of dead reckoning, which is of now
      sensed.state = *situation.state;
      sensed.ages.pose = sensed.ages.body_rate = 0.0;
      sensed.rate_of_odometry = !guarded.reckoning.feels();
    }
    controller_.step(sensed, decision.set_point, dt, decision.learn);
  } else {
    controller_.idle(decision.idle, dt);
  }
  guarded.given = controller_.given();
  weigh(dt);
  const double lightness = guarded.reckoning.feels() ? 1.0 : kBlindLightness;
  guarded.reckoning.advance(guarded.given, lightness * guarded.mass, dt);
  guarded.silence += dt;
  guarded.imu_silence += dt;
  guarded.plan_age += dt;
  countStep(now, dt);
}

void Pilot::stepUnguarded(Nanoseconds now) noexcept {
  const SetPoint* set_point = located_ ? schedule_.at(now) : nullptr;
  if (set_point != nullptr) set_point_ = *set_point;
  const double dt = clock_.begin(now, set_point != nullptr);
  switchSubsystem(now);
  controller_.step(sense(now), set_point, dt);
  countStep(now, dt);
}

void Pilot::countStep(Nanoseconds now, double dt) noexcept {
  load_.update(law().telemetry().carriedMass(), controller_.given().moment, dt);
  monitor_.countStep(now, flying(), law().telemetry(), allocation().saturated, load_.load());
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

// What the law gets: odometry with its age, the specific force when it is young enough and, of a
// gyroscope that was asked no earlier, the body rate.
Sensed Pilot::sense(Nanoseconds now) noexcept {
  const Nanoseconds odometry_time = clock_.odometryTime();
  sensed_.ages.pose = sensed_.ages.body_rate = toSeconds(now - odometry_time);
  sensed_.specific_force.reset();
  if (!law().usesSpecificForce()) return sensed_;
  if (const Eigen::Vector3d* specific_force = imu_.at(odometry_time)) {
    sensed_.specific_force = *specific_force;
    sensed_.ages.specific_force = toSeconds(now - imu_.time());
  }
  Sensed sensed = sensed_;
  const Eigen::Vector3d* body_rate = law().usesGyroscope() ? imu_.bodyRate() : nullptr;
  sensed.rate_of_odometry = body_rate == nullptr;
  const bool young = now - imu_.time() <= limits_.specific_force_age;
  if (body_rate != nullptr && young && imu_.time() >= odometry_time) {
    sensed.state.body_rate = *body_rate;
    sensed.ages.body_rate = sensed.ages.specific_force;
  }
  return sensed;
}

}  // namespace aqc
