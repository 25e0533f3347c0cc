#include "adaptive_quadrotor_control/reference/governor.h"

#include <algorithm>
#include <cmath>

#include "adaptive_quadrotor_control/math/constants.h"
#include "adaptive_quadrotor_control/math/rotations.h"
#include "adaptive_quadrotor_control/parameters/parameter_reader.h"
#include "reference/motion_shaper.h"

namespace aqc {
namespace {

constexpr double kPi = 3.141592653589793;
constexpr double kLongestStep = 0.025;      // the controller is tuned for steps up to it [s]
constexpr double kLongest = 2.0;            // of a pause between steps [s]
constexpr double kSteeringReserve = 0.9;    // part of the thrust that the reference may ask for
constexpr double kLeastAcceleration = 0.1;  // with no thrust to spare [m/s^2]
constexpr double kYawBuildUp = 0.1;         // of yaw acceleration [s]
constexpr double kMost = 1e6;               // of any limit: what is squared stays finite

// The motion of some of x, y, z.
template <int N, int First>
Motion<N> partOf(const SetPoint& s) noexcept {
  return {s.position.segment<N>(First), s.velocity.segment<N>(First),
          s.acceleration.segment<N>(First), s.jerk.segment<N>(First)};
}

// The reference slows down from half of the lead on, horizontally and vertically apart: one that
// waits for the vehicle sideways must go on sinking.
template <int N, int First>
void advancePart(SetPoint& s, const SetPoint& wanted, const MotionBounds& bounds,
                 const Eigen::Vector3d& ahead, double longest, double dt) noexcept {
  Motion<N> motion = partOf<N, First>(s);
  const Motion<N> target = partOf<N, First>(wanted);
  if (hasArrived<N>(motion, target)) return;
  Lead<N> lead = {ahead.segment<N>(First), 1.0};
  if (lead.ahead.squaredNorm() > shaper::square(0.5 * longest)) {
    lead.speed = std::max(0.0, 2.0 - 2.0 * shaper::length<N>(lead.ahead) / longest);
  }
  advance<N>(motion, target, bounds, lead, dt);
  s.position.segment<N>(First) = motion.position;
  s.velocity.segment<N>(First) = motion.velocity;
  s.acceleration.segment<N>(First) = motion.acceleration;
  s.jerk.segment<N>(First) = motion.jerk;
}

void advanceYaw(SetPoint& s, const SetPoint& wanted, const MotionBounds& bounds,
                double dt) noexcept {
  using One = Vector<1>;
  const double turn = wanted.yaw - s.yaw;
  const double yaw = s.yaw + (std::abs(turn) <= kPi ? turn : std::remainder(turn, 2.0 * kPi));
  Motion<1> motion = {One(s.yaw), One(s.yaw_rate), One(s.yaw_acceleration), One(0.0)};
  const Motion<1> target = {One(yaw), One(wanted.yaw_rate), One(wanted.yaw_acceleration), One(0.0)};
  if (hasArrived<1>(motion, target)) return;
  advance<1>(motion, target, bounds, {One(0.0), 1.0}, dt);
  s.yaw = motion.position[0];
  s.yaw_rate = motion.velocity[0];
  s.yaw_acceleration = motion.acceleration[0];
}

// Whether it is at rest where it is to rest, in all of x, y, z and yaw: most of the time, in a
// hover, and told by sums without a branch.
bool rests(const SetPoint& now, const SetPoint& wanted) noexcept {
  const auto motion = [](const SetPoint& s) {
    return (s.velocity.cwiseAbs() + s.acceleration.cwiseAbs() + s.jerk.cwiseAbs()).sum() +
           std::abs(s.yaw_rate) + std::abs(s.yaw_acceleration);
  };
  return now.position == wanted.position && now.yaw == wanted.yaw &&
         motion(now) + motion(wanted) == 0.0;
}

}  // namespace

GovernorLimits readGovernorLimits(const ParameterReader& reader) {
  GovernorLimits limits;
  const auto read = [&](const char* key, double& limit) {
    limit = reader.number(key, Range::positiveUpTo(kMost), limit);
  };
  read("horizontal_speed", limits.horizontal_speed);
  read("climb_speed", limits.climb_speed);
  read("descent_speed", limits.descent_speed);
  read("acceleration", limits.acceleration);
  read("vertical_acceleration", limits.vertical_acceleration);
  read("jerk", limits.jerk);
  read("yaw_rate", limits.yaw_rate);
  read("yaw_acceleration", limits.yaw_acceleration);
  read("lead", limits.lead);
  limits.floor = reader.number("floor", Range::any(), limits.floor);
  return limits;
}

void ReferenceGovernor::restart(const SetPoint& at) noexcept {
  reference_ = {};
  reference_.position = at.position;
  reference_.yaw = at.yaw;
  wanted_ = reference_;
  reference_.velocity = at.velocity;
  reference_.yaw_rate = at.yaw_rate;
  started_ = true;
}

void ReferenceGovernor::shift(const Eigen::Vector3d& position, double yaw) noexcept {
  const Eigen::Matrix3d turn = yawRotation(yaw).toRotationMatrix();
  for (SetPoint* s : {&reference_, &wanted_}) {
    s->position += position;
    s->velocity = turn * s->velocity;
    s->acceleration = turn * s->acceleration;
    s->jerk = turn * s->jerk;
    s->yaw += yaw;
  }
}

void ReferenceGovernor::take(const SetPoint& wanted, double floor) noexcept {
  if (wanted.valid()) {
    wanted_ = wanted;
  } else {  // to rest at the last one
    SetPoint rest;
    rest.position = wanted_.position;
    rest.yaw = wanted_.yaw;
    wanted_ = rest;
  }
  const double lowest = floor > limits_.floor ? floor : limits_.floor;
  if (wanted_.position.z() >= lowest) return;
  wanted_.position.z() = lowest;
  wanted_.velocity.z() = wanted_.acceleration.z() = wanted_.jerk.z() = 0.0;
}

void ReferenceGovernor::step(const Eigen::Vector3d& actual, double thrust_to_weight,
                             double dt) noexcept {
  if (rests(reference_, wanted_)) return;
  // Half of the spare thrust may go upwards, what is left then sideways.
  const GovernorLimits& l = limits_;
  const double ratio = std::isnan(thrust_to_weight) ? HUGE_VAL : thrust_to_weight;
  const double thrust = kSteeringReserve * ratio * kGravity;
  const double up = std::max(kLeastAcceleration, 0.5 * (thrust - kGravity));
  const double vertical = std::min(l.vertical_acceleration, up);
  const double lift = kGravity + vertical;
  const double aside_squared = thrust * thrust - lift * lift;
  const bool plenty = !(aside_squared < l.acceleration * l.acceleration);
  const double horizontal =
      plenty ? l.acceleration
             : std::min(l.acceleration,
                        std::max(kLeastAcceleration, std::sqrt(std::max(0.0, aside_squared))));

  const Eigen::Vector3d ahead = reference_.position - actual;
  advancePart<2, 0>(
      reference_, wanted_,
      {l.horizontal_speed, l.horizontal_speed, horizontal, l.jerk, l.jerk / l.acceleration}, ahead,
      l.lead, dt);
  advancePart<1, 2>(
      reference_, wanted_,
      {l.climb_speed, l.descent_speed, vertical, l.jerk, l.jerk / l.vertical_acceleration}, ahead,
      l.lead, dt);
  advanceYaw(reference_, wanted_,
             {l.yaw_rate, l.yaw_rate, l.yaw_acceleration, l.yaw_acceleration / kYawBuildUp,
              1.0 / kYawBuildUp},
             dt);
}

// Back to the lead, where the limits of motion did not suffice.
void ReferenceGovernor::stayNear(const Eigen::Vector3d& actual) noexcept {
  const Eigen::Vector3d ahead = reference_.position - actual;
  const double lead = limits_.lead;
  if (ahead.head<2>().squaredNorm() > lead * lead) {
    reference_.position.head<2>() =
        actual.head<2>() + ahead.head<2>() * (lead / ahead.head<2>().norm());
  }
  if (std::abs(ahead.z()) > lead) {
    reference_.position.z() = actual.z() + std::copysign(lead, ahead.z());
  }
}

const SetPoint& ReferenceGovernor::follow(const SetPoint& wanted, const Eigen::Vector3d& actual,
                                          double thrust_to_weight, double floor,
                                          double dt) noexcept {
  if (!started_) {
    SetPoint at;
    at.position = actual;
    at.yaw = std::isfinite(wanted.yaw) ? wanted.yaw : 0.0;
    restart(at);
  }
  if (!(dt > 0.0)) return reference_;
  take(wanted, floor);
  if (dt <= kLongestStep) {
    step(actual, thrust_to_weight, dt);
  } else {
    const double time = std::min(dt, kLongest);
    const int pieces = static_cast<int>(std::ceil(time / kLongestStep));
    for (int i = 0; i < pieces; ++i) step(actual, thrust_to_weight, time / pieces);
  }
  stayNear(actual);
  return reference_;
}

}  // namespace aqc
