#include "adaptive_quadrotor_control/pilot/guard.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "pilot/guard_terms.h"

namespace aqc {
namespace {

constexpr double kRock = 1.0 / 3.0;  // part of tip_tilt that is too much before lift-off
constexpr double kSlow = 0.5;        // [m/s]: slow enough to touch down
constexpr double kBraking = 4.0;     // [s], at the most until a landing sinks
// Without odometry speeds are not known for so long.
constexpr double kBlindBraking = 1.5;  // [s]
// What is not known of an accelerometer's bias must not let a descent end in a climb: late, it
// sinks faster and faster, to some times the descent's speed.
constexpr double kHurry = 0.2;  // [m/s^2]
constexpr double kHaste = 2.0;

}  // namespace

Guard::Guard(const GuardLimits& limits, double max_thrust)
    : limits_(limits),
      max_thrust_(max_thrust),
      governor_(limits.governor),
      least_up_{std::cos(limits.tumble_tilt), std::cos(limits.tip_tilt),
                std::cos(kRock * limits.tip_tilt)},
      ground_(limits.ground) {}

void Guard::enter(Mode mode, Rule rule) noexcept {
  if (mode_ == Mode::kKilled) return;
  rule_ = rule;
  if (mode == mode_) return;
  mode_ = mode;
  mode_time_ = sunk_ = 0.0;
  lagging_ = overloaded_ = saturated_ = failing_ = standing_ = {};
  if (!armed()) airborne_ = false;
}

const char* Guard::arm() noexcept {
  if (mode_ == Mode::kKilled) return "it was killed; start the controller again";
  if (armed()) return "it is armed already";
  if (unfit_ != nullptr) return unfit_;
  if (!located_) return "there is no odometry";
  if (state_.velocity.norm() > 0.5) return "the vehicle moves";
  if (tilt(state_) > limits_.tip_tilt) return "the vehicle is tilted";
  stood_at_ = state_.position.z();
  place_ = standing(state_);
  crashed_ = false;
  enter(Mode::kArmed, Rule::kOperator);
  return nullptr;
}

const char* Guard::disarm() noexcept {
  if (airborne()) return "it is in the air; land, or kill";
  enter(Mode::kDisarmed, Rule::kOperator);
  return nullptr;
}

const char* Guard::takeOff() noexcept {
  if (mode_ != Mode::kArmed) return "it is not armed and on the ground";
  if (unfit_ != nullptr) return unfit_;  // gains may have changed since
  plan_is_new_ = false;
  // From whatever slope it stands on.
  least_up_.standing = std::cos(tilt(state_) + kRock * limits_.tip_tilt);
  enter(Mode::kTakingOff, Rule::kOperator);
  governor_.restart(place_);
  return nullptr;
}

const char* Guard::land() noexcept {
  if (!airborne()) return "it does not fly";
  if (mode_ == Mode::kDescending) return "it descends already";
  restAhead();
  enter(Mode::kLanding, Rule::kOperator);
  return nullptr;
}

const char* Guard::hold() noexcept {
  if (!airborne()) return "it does not fly";
  if (mode_ == Mode::kDescending) return "it flies without odometry";
  brake(Rule::kOperator);
  return nullptr;
}

const char* Guard::goTo(const SetPoint& place) noexcept {
  if (!place.valid() || place.position.cwiseAbs().maxCoeff() > limits_.set_point_bound) {
    return "the place is not finite or too far away";
  }
  if (const char* why = hold()) return why;
  place_ = SetPoint();
  place_.position = place.position;
  place_.yaw = place.yaw;
  return nullptr;
}

// Where the reference comes to rest: a hold must not turn back.
void Guard::restAhead() noexcept {
  const SetPoint& reference = governor_.setPoint();
  const double deceleration = 0.6 * limits_.governor.acceleration;
  place_ = SetPoint();
  place_.position =
      reference.position + reference.velocity * (reference.velocity.norm() / (2.0 * deceleration));
  place_.yaw = reference.yaw;
  plan_is_new_ = false;
}

void Guard::brake(Rule rule) noexcept {
  restAhead();
  enter(Mode::kHolding, rule);
}

void Guard::restartReference(const State& moving) noexcept {
  SetPoint reference = standing(moving);
  reference.velocity = moving.velocity;
  governor_.restart(reference);
}

void Guard::heardOdometry(const State& state) noexcept {
  if (mode_ != Mode::kDescending) return;
  restartReference(state);
  restAhead();
  const bool lands = was_landing_ || state.position.z() < stood_at_ + kNear;
  enter(lands ? Mode::kLanding : Mode::kHolding, Rule::kOdometryBack);
}

void Guard::sourceReset(const State& expected, const State& said) noexcept {
  const double turn = yaw(said.attitude) - yaw(expected.attitude);
  const Eigen::Vector3d shift = said.position - expected.position;
  governor_.shift(shift, turn);
  groundRose(shift.z());
  if (!airborne()) {
    place_.position += shift;
    return;
  }
  restAhead();
  enter(mode_ == Mode::kLanding ? Mode::kLanding : Mode::kHolding, Rule::kSourceReset);
}

void Guard::clockStepped() noexcept {
  if (mode_ == Mode::kDescending) return;
  if (!airborne()) {
    enter(Mode::kDisarmed, Rule::kClockStep);
  } else if (mode_ == Mode::kFlying) {
    brake(Rule::kClockStep);
  } else {
    rule_ = Rule::kClockStep;
  }
}

void Guard::planReleased() noexcept {
  plan_is_new_ = false;
  if (mode_ == Mode::kFlying) brake(Rule::kOperator);
}

// Whether a landing or a descent is still too fast over the ground to sink.
bool Guard::brakesFirst() const noexcept {
  const double longest = mode_ == Mode::kDescending ? kBlindBraking : kBraking;
  return mode_time_ < longest && state_.velocity.head<2>().norm() > kSlow;
}

double Guard::blindSinking() const noexcept {
  const double late = std::max(0.0, sunk_ - wayDown() / limits_.descent_speed);
  return std::min(limits_.descent_speed + kHurry * late, kHaste * limits_.descent_speed);
}

void Guard::aim(const Situation& now) noexcept {
  SetPoint& wanted = goal_;
  wanted = mode_ == Mode::kFlying ? *now.planned : place_;
  const auto sink = [&](double speed) {
    wanted.position.z() = governor_.setPoint().position.z() - speed * now.dt;
    wanted.velocity.z() = -speed;
  };
  if (mode_ == Mode::kTakingOff) {
    const double top = stood_at_ + limits_.take_off_height;
    const double next = governor_.setPoint().position.z() + limits_.take_off_speed * now.dt;
    wanted.position.z() = std::min(top, next);
    if (next < top) wanted.velocity.z() = limits_.take_off_speed;
  } else if (mode_ == Mode::kFlying) {
    if (now.plan_ended) {
      wanted.velocity.setZero();
      wanted.acceleration.setZero();
      wanted.jerk.setZero();
      wanted.yaw_rate = wanted.yaw_acceleration = 0.0;
    }
  } else if (mode_ == Mode::kDescending) {
    sink(brakesFirst() ? 0.0 : blindSinking());
  } else if (mode_ == Mode::kLanding) {
    sink(brakesFirst() ? 0.0 : limits_.landing_speed);
  }
}

Finding Guard::judge() const {
  Finding finding;
  finding.name = "guard";
  const RuleText& text = textOf(rule_);
  const bool wanted = rule_ <= Rule::kSetPoint || rule_ == Rule::kTouchDown;
  if (!wanted) finding.health = Health::kWarn;
  if (mode_ == Mode::kDescending || mode_ == Mode::kKilled || crashed_) {
    finding.health = Health::kError;
  }
  finding.reason = std::string(toString(mode_)) + ": " + text.check;
  finding.values = {{"mode", toString(mode_)}, {"rule", text.name}};
  return finding;
}

// The lowest height to go to: whoever flies there in a tilt must not scrape the ground.
double Guard::floor() const noexcept {
  if (mode_ == Mode::kLanding || mode_ == Mode::kDescending) {
    return -std::numeric_limits<double>::infinity();
  }
  return mode_ == Mode::kTakingOff ? stood_at_ : stood_at_ + limits_.clearance;
}

Decision Guard::step(const Situation& now) noexcept {
  if (now.state != nullptr) {
    state_ = *now.state;
    located_ = true;
  }
  if (located_) {
    begin(now);
    watchOdometry(now);
    watchAttitude(now);
    watchLift(now);
    watchRotors(now);
    watchPlan(now);
    progress(now);
  }
  Decision decision;
  decision.forget = !now.law_finite;
  if (mode_ == Mode::kArmed) decision.idle = limits_.idle_speed;
  if (!flies()) return decision;
  const double thrust_to_weight = max_thrust_ / (std::max(now.load.carried, 1e-3) * kGravity);
  aim(now);
  decision.set_point = &governor_.follow(goal_, state_.position, thrust_to_weight, floor(), now.dt);
  decision.learn = mayLearn(now);
  decision.stands = mode_ == Mode::kDescending && standing_.time >= kSettling;
  return decision;
}

}  // namespace aqc
