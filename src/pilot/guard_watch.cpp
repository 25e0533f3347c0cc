// What the guard looks at in every step, and the modes that end by it.

#include <algorithm>
#include <cmath>

#include "adaptive_quadrotor_control/pilot/guard.h"
#include "pilot/guard_terms.h"

namespace aqc {
namespace {

constexpr double kLiftedOff = 0.05;     // [m] above where it stood
constexpr double kRocking = 1.0 / 6.0;  // part of tip_time that suffices before lift-off
constexpr double kStill = 0.1;          // [m/s]: does not sink
constexpr double kSmoothing = 0.3;      // [s], of a vertical velocity that may be noisy
constexpr double kSupport = 0.25;       // part of the weight that only the ground can hold up
constexpr double kBlindReserve = 3.0;   // [s] longer than the way down takes
constexpr double kBlindPatience = 1.5;  // times longer with an IMU that does not feel the ground

}  // namespace

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
  const double up = uprightness(state_.attitude);
  const bool near = state_.position.z() < stood_at_ + kNear;
  const bool rocks = mode_ == Mode::kTakingOff && !airborne_ && up < least_up_.standing;
  const bool tumbled = tumbling_.update(up < least_up_.flying, now.dt, limits_.tumble_time);
  const bool lies = tipped_.update(near && up < least_up_.near, now.dt, limits_.tip_time);
  const bool rocked = rocking_.update(rocks, now.dt, kRocking * limits_.tip_time);
  const bool tipped = lies || rocked;
  if (!armed() || !(tumbled || tipped)) return;
  crashed_ = true;
  enter(Mode::kDisarmed, tumbled ? Rule::kTumble : Rule::kTipped);
}

void Guard::watchLift(const Situation& now) noexcept {
  const bool flies = airborne() && mode_ != Mode::kLanding && mode_ != Mode::kDescending;
  const bool heavy = flies && now.load.carried > limits_.overload * now.load.liftable;
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

// The ground, too, gives moments that no rotor gives.
void Guard::watchRotors(const Situation& now) noexcept {
  const bool flies =
      airborne() && mode_ != Mode::kDescending && state_.position.z() > stood_at_ + kNear;
  const bool fails = flies && now.missing_rotors > limits_.rotor_loss;
  if (!failing_.update(fails, now.dt, limits_.rotor_loss_time)) return;
  if (mode_ != Mode::kLanding) restAhead();
  enter(Mode::kLanding, Rule::kRotorLoss);
}

void Guard::watchPlan(const Situation& now) noexcept {
  if (mode_ == Mode::kHolding && plan_is_new_ && now.planned != nullptr) {
    enter(Mode::kFlying, Rule::kSetPoint);
  }
  if (mode_ != Mode::kFlying) return;
  plan_is_new_ = false;
  const bool old = limits_.set_point_age > 0.0 && now.plan_age > limits_.set_point_age;
  const double lead = (governor_.setPoint().position - state_.position).squaredNorm();
  const double longest = 0.95 * limits_.governor.lead;
  const bool lagging = lagging_.update(lead > longest * longest, now.dt, limits_.lag);
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
  if (!brakesFirst()) sunk_ += now.dt;
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
  const double time = kBlindReserve + wayDown() / limits_.descent_speed;
  return sunk_ > (now.feels ? kBlindPatience * time : time);
}

// From where odometry was lost [m].
double Guard::wayDown() const noexcept {
  return std::max(0.0, place_.position.z() - ground_);
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

}  // namespace aqc
