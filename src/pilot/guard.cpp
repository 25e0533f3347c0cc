#include "adaptive_quadrotor_control/pilot/guard.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "adaptive_quadrotor_control/math/rotations.h"

namespace aqc {
namespace {

constexpr double kLiftedOff = 0.05;     // [m] above where it stood
constexpr double kNear = 0.3;           // [m] above the ground: close to it
constexpr double kStill = 0.1;          // [m/s]: does not sink
constexpr double kSlow = 0.5;           // [m/s]: slow enough to touch down
constexpr double kBraking = 4.0;        // [s], at the most until a landing sinks
constexpr double kSmoothing = 0.3;      // [s], of a vertical velocity that may be noisy
constexpr double kSettling = 0.1;       // [s], part of touch_down_time: what does not sink stands
constexpr double kSupport = 0.25;       // part of the weight that only the ground can hold up
constexpr double kBlindReserve = 3.0;   // [s] longer than the way down takes
constexpr double kBlindPatience = 1.5;  // times longer with an IMU that does not feel the ground

double yaw(const Eigen::Quaterniond& attitude) noexcept {
  return rollPitchYaw(attitude).z();
}

double tilt(const State& state) noexcept {
  const double up = (state.attitude * Eigen::Vector3d::UnitZ()).z();
  return std::acos(std::clamp(up, -1.0, 1.0));
}

SetPoint standing(const State& state) noexcept {
  SetPoint place;
  place.position = state.position;
  place.yaw = yaw(state.attitude);
  return place;
}

}  // namespace

Guard::Guard(const GuardLimits& limits, double max_thrust)
    : limits_(limits),
      max_thrust_(max_thrust),
      governor_(limits.governor),
      ground_(limits.ground) {}

void Guard::enter(Mode mode, Rule rule) noexcept {
  if (mode_ == Mode::kKilled) return;
  rule_ = rule;
  if (mode == mode_) return;
  mode_ = mode;
  mode_time_ = 0.0;
  lagging_ = overloaded_ = saturated_ = standing_ = {};
  if (!armed()) airborne_ = false;
}

const char* Guard::arm() noexcept {
  if (mode_ == Mode::kKilled) return "it was killed; start the controller again";
  if (armed()) return "it is armed already";
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
  plan_is_new_ = false;
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

// A vehicle on the ground waits; one that was armed in the air is taken over.
void Guard::begin(const Situation& now) noexcept {
  if (mode_ != Mode::kDisarmed) return;
  if (was_armed_) {
    was_armed_ = false;
    if (state_.position.z() > ground_ + kNear) {
      stood_at_ = ground_;
      airborne_ = true;
      restartReference(state_);
      brake(Rule::kAirborne);
      return;
    }
  }
  const bool asked = now.planned != nullptr && plan_is_new_ &&
                     now.planned->position.z() > state_.position.z() + kLiftedOff;
  if (!limits_.auto_arm || crashed_ || !asked || now.silence > limits_.odometry_late) return;
  if (arm() != nullptr) return;
  takeOff();
  plan_is_new_ = true;
  rule_ = Rule::kAutoArm;
}

void Guard::watchOdometry(const Situation& now) noexcept {
  if (!armed() || now.silence < limits_.odometry_late) return;
  if (!airborne_) {
    if (now.silence >= limits_.odometry_lost) enter(Mode::kDisarmed, Rule::kOdometryLost);
    return;
  }
  if (mode_ == Mode::kDescending) return;
  if (now.silence < limits_.odometry_lost) {
    rule_ = Rule::kOdometryLate;
    return;
  }
  was_landing_ = mode_ == Mode::kLanding;
  restartReference(state_);
  restAhead();
  enter(Mode::kDescending, Rule::kOdometryLost);
}

void Guard::watchAttitude(const Situation& now) noexcept {
  const double tilt = aqc::tilt(state_);
  const bool near = state_.position.z() < stood_at_ + kNear;
  const bool tumbled = tumbling_.update(tilt > limits_.tumble_tilt, now.dt, limits_.tumble_time);
  const bool tipped = tipped_.update(near && tilt > limits_.tip_tilt, now.dt, limits_.tip_time);
  if (!armed() || !(tumbled || tipped)) return;
  crashed_ = true;
  enter(Mode::kDisarmed, tumbled ? Rule::kTumble : Rule::kTipped);
}

void Guard::watchLift(const Situation& now) noexcept {
  const bool flies = airborne() && mode_ != Mode::kLanding && mode_ != Mode::kDescending;
  const bool heavy = flies && now.mass * kGravity > limits_.overload * max_thrust_;
  const bool overload = overloaded_.update(heavy, now.dt, limits_.overload_time);
  const bool saturation =
      saturated_.update(flies && thrustIsShort(now), now.dt, limits_.saturation_time);
  if (armed() && !now.law_finite) {
    enter(airborne() ? Mode::kLanding : Mode::kDisarmed, Rule::kLawNotFinite);
  } else if (overload || saturation) {
    restAhead();
    enter(Mode::kLanding, overload ? Rule::kOverload : Rule::kSaturation);
  }
}

void Guard::watchPlan(const Situation& now) noexcept {
  if (mode_ == Mode::kHolding && plan_is_new_ && now.planned != nullptr) {
    enter(Mode::kFlying, Rule::kSetPoint);
  }
  if (mode_ != Mode::kFlying) return;
  plan_is_new_ = false;
  const bool old = limits_.set_point_age > 0.0 && now.plan_age > limits_.set_point_age;
  const double lead = (governor_.setPoint().position - state_.position).norm();
  const bool lagging = lagging_.update(lead > 0.95 * limits_.governor.lead, now.dt, limits_.lag);
  if (now.planned == nullptr || old) {
    brake(Rule::kSetPointOld);
  } else if (lagging) {
    governor_.restart(standing(state_));
    brake(Rule::kNotFollowing);
  }
}

// Modes that end by themselves.
void Guard::progress(const Situation& now) noexcept {
  mode_time_ += now.dt;
  climbing_ += std::min(now.dt / kSmoothing, 1.0) * (state_.velocity.z() - climbing_);
  const double risen = state_.position.z() - stood_at_;
  if (flies() && risen > kLiftedOff) airborne_ = true;
  if (mode_ == Mode::kTakingOff) {
    if (risen >= limits_.take_off_height - 0.1) {
      place_.position.z() = stood_at_ + limits_.take_off_height;
      enter(Mode::kHolding, Rule::kTakenOff);
    } else if (!airborne_ && mode_time_ > limits_.lift_off_time) {
      crashed_ = true;
      enter(Mode::kDisarmed, Rule::kNoLiftOff);
    }
    return;
  }
  const bool blind = mode_ == Mode::kDescending;
  if (mode_ != Mode::kLanding && !blind) return;
  const bool above = governor_.setPoint().position.z() < state_.position.z() - 0.2;
  const bool stands = blind ? now.support > kSupport : above && std::abs(climbing_) < kStill;
  const bool stood = standing_.update(stands, now.dt, limits_.touch_down_time);
  if (standing_.time >= kSettling) settle();
  if (stood) {
    enter(Mode::kDisarmed, Rule::kTouchDown);
  } else if (blind && mustBeDown(now)) {
    enter(Mode::kDisarmed, Rule::kBlindEnd);
  }
}

// A vehicle on its feet must not lean towards a place aside.
void Guard::settle() noexcept {
  SetPoint below = governor_.setPoint();
  below.position.head<2>() = place_.position.head<2>() = state_.position.head<2>();
  below.velocity.head<2>().setZero();
  governor_.restart(below);
}

// The time for the way down is over; an IMU would feel the ground, and is waited for.
bool Guard::mustBeDown(const Situation& now) const noexcept {
  const double way = (place_.position.z() - ground_) / limits_.descent_speed;
  const double time = kBlindReserve + std::max(way, 0.0);
  return mode_time_ > (now.feels ? kBlindPatience * time : time);
}

SetPoint Guard::wanted(const Situation& now) noexcept {
  SetPoint wanted = place_;
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
    wanted = *now.planned;
    if (now.plan_ended) {
      wanted.velocity.setZero();
      wanted.acceleration.setZero();
      wanted.jerk.setZero();
      wanted.yaw_rate = wanted.yaw_acceleration = 0.0;
    }
  } else if (mode_ == Mode::kDescending) {
    sink(limits_.descent_speed);
  } else if (mode_ == Mode::kLanding) {
    const bool brakes = mode_time_ < kBraking && state_.velocity.head<2>().norm() > kSlow;
    sink(brakes ? 0.0 : limits_.landing_speed);
  }
  return wanted;
}

// All the thrust there is, and it does not suffice.
bool Guard::thrustIsShort(const Situation& now) const noexcept {
  return now.given->requested.thrust >= max_thrust_ && now.given->saturated &&
         state_.position.z() < governor_.setPoint().position.z();
}

// Estimates rest on the ground, without odometry or an IMU that tells of what is not known, and
// while more thrust than there is would be learned.
bool Guard::mayLearn(const Situation& now) const noexcept {
  if ((now.silence >= limits_.odometry_late && !now.feels) || thrustIsShort(now)) return false;
  return airborne_ || mode_ == Mode::kTakingOff;
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
    watchPlan(now);
    progress(now);
  }
  Decision decision;
  decision.forget = !now.law_finite;
  if (mode_ == Mode::kArmed) decision.idle = limits_.idle_speed;
  if (!flies()) return decision;
  const double thrust_to_weight = max_thrust_ / (std::max(now.mass, 1e-3) * kGravity);
  goal_ = wanted(now);
  decision.set_point = &governor_.follow(goal_, state_.position, thrust_to_weight, floor(), now.dt);
  decision.learn = mayLearn(now);
  decision.stands = mode_ == Mode::kDescending && standing_.time >= kSettling;
  return decision;
}

}  // namespace aqc
