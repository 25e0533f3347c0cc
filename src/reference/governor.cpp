#include "adaptive_quadrotor_control/reference/governor.h"

#include <algorithm>
#include <cmath>

#include "adaptive_quadrotor_control/math/constants.h"
#include "adaptive_quadrotor_control/math/rotations.h"
#include "adaptive_quadrotor_control/parameters/parameter_reader.h"

namespace aqc {
namespace {

constexpr double kTwoPi = 6.283185307179586;
constexpr double kLongestStep = 0.025;      // the controller is tuned for steps up to it [s]
constexpr double kFar = 1e9;                // squares of more lose their meaning [m]
constexpr double kSteeringReserve = 0.9;    // part of the thrust that the reference may ask for
constexpr double kLeastAcceleration = 0.1;  // with no thrust to spare [m/s^2]
constexpr double kBrakingReserve = 0.7;     // part of the acceleration that braking plans with
constexpr double kYawBuildUp = 0.1;         // of yaw acceleration [s]
constexpr double kClose = 1e-4;             // [m], [rad]
constexpr double kAlike = 1e-3;             // [m/s], [rad/s]

template <int N>
using Vector = Eigen::Matrix<double, N, 1>;

template <int N>
struct Motion {
  Vector<N> position, velocity, acceleration, jerk;
};

struct Bounds {
  double up, down;  // speeds; alike where the motion has no sign
  double acceleration, jerk;
  double gain;  // of position [1/s]: what the full acceleration takes to build up, inverted
};

// How far the reference is ahead of the vehicle, and the part of its speed that it may go away
// with.
template <int N>
struct Lead {
  Vector<N> ahead;
  double speed;
};

template <int N>
Vector<N> within(const Vector<N>& vector, double longest) noexcept {
  const double length = vector.norm();
  return length > longest ? Vector<N>(vector * (longest / length)) : vector;
}

// Speed as a multiple of the one allowed.
template <int N>
double part(const Vector<N>& velocity, const Bounds& bounds) noexcept {
  if constexpr (N == 1) {
    return velocity[0] > 0.0 ? velocity[0] / bounds.up : -velocity[0] / bounds.down;
  } else {
    return velocity.norm() / bounds.up;
  }
}

// The same, at worst until the acceleration is let go straight: the velocity goes on a line then.
template <int N>
double partAtWorst(const Vector<N>& v, const Vector<N>& a, const Bounds& bounds) noexcept {
  const Vector<N> end = v + a * (a.norm() / (2.0 * bounds.jerk));
  return std::max(part<N>(v, bounds), part<N>(end, bounds));
}

// A speed to approach with that is linear near the goal and brakes evenly further away.
struct Approach {
  double speed, slope;
};

Approach approach(double distance, double gain, double braking) noexcept {
  const double linear = braking / (gain * gain);
  if (distance <= linear) return {gain * distance, gain};
  const double speed = std::sqrt(2.0 * braking * (distance - 0.5 * linear));
  return {speed, braking / speed};
}

// Whether the wanted motion is one that the limits allow after the present one.
template <int N>
bool leadsTo(const Motion<N>& now, const Motion<N>& wanted, const Bounds& bounds,
             const Lead<N>& lead, double dt) noexcept {
  const Vector<N> dp = wanted.position - now.position, dv = wanted.velocity - now.velocity;
  const double away = lead.speed * bounds.up * lead.ahead.norm();
  return (dp - 0.5 * dt * (now.velocity + wanted.velocity)).norm() <= kClose &&
         (dv - 0.5 * dt * (now.acceleration + wanted.acceleration)).norm() <=
             kAlike + 0.25 * bounds.jerk * dt * dt &&
         part<N>(dp / dt, bounds) <= 1.0 && dv.norm() <= bounds.acceleration * dt &&
         (wanted.acceleration - now.acceleration).norm() <= bounds.jerk * dt &&
         wanted.acceleration.norm() <= bounds.acceleration && wanted.jerk.norm() <= bounds.jerk &&
         partAtWorst<N>(wanted.velocity, wanted.acceleration, bounds) <= 1.0 &&
         (lead.speed >= 1.0 || wanted.velocity.dot(lead.ahead) <= away);
}

// The acceleration to have at the end of the step.
template <int N>
Vector<N> sought(const Motion<N>& now, const Motion<N>& wanted, const Bounds& bounds,
                 const Lead<N>& lead, double dt) noexcept {
  const Vector<N> v = now.velocity + dt * now.acceleration;
  const Vector<N> wanted_v = wanted.velocity / std::max(1.0, part<N>(wanted.velocity, bounds));
  const Vector<N> error = (wanted.position - now.position - 0.5 * dt * (now.velocity + v))
                              .cwiseMax(-kFar)
                              .cwiseMin(kFar);
  const Vector<N> drift = wanted_v - v;
  const double distance = error.norm();
  const Approach to_point = approach(distance, bounds.gain, kBrakingReserve * bounds.acceleration);
  Vector<N> velocity = wanted_v;
  Vector<N> acceleration = within<N>(wanted.acceleration, bounds.acceleration);
  if (distance > 0.0) {
    const Vector<N> direction = error / distance;
    const double turning = to_point.speed / distance;
    velocity += direction * to_point.speed;
    acceleration +=
        turning * drift + direction * ((to_point.slope - turning) * direction.dot(drift));
  }
  const double excess = part<N>(velocity, bounds);
  if (excess > 1.0) {
    velocity /= excess;
    acceleration /= excess;
    acceleration -= velocity * (std::max(0.0, velocity.dot(acceleration)) / velocity.squaredNorm());
  }
  const double ahead = lead.ahead.norm();
  const double too_fast = velocity.dot(lead.ahead) - lead.speed * bounds.up * ahead;
  if (lead.speed < 1.0 && too_fast > 0.0) {
    velocity -= lead.ahead * (too_fast / (ahead * ahead));
    acceleration.setZero();
  }
  const Vector<N> miss = velocity - v;
  const double size = miss.norm();
  const double gain = std::min(2.5 * bounds.gain, 0.5 / dt);
  if (size > 0.0) {
    acceleration += miss * (approach(size, gain, kBrakingReserve * bounds.jerk).speed / size);
  }
  return within<N>(acceleration, bounds.acceleration);
}

template <int N>
void advance(Motion<N>& now, const Motion<N>& wanted, const Bounds& bounds, const Lead<N>& lead,
             double dt) noexcept {
  if (leadsTo(now, wanted, bounds, lead, dt)) {
    now = wanted;
    return;
  }
  const Vector<N> v = now.velocity, a = now.acceleration;
  const double change = bounds.jerk * dt, size = a.norm();
  const Vector<N> least = a * (size > change ? 1.0 - change / size : 0.0);
  const Vector<N> most = a + within<N>(sought(now, wanted, bounds, lead, dt) - a, change);
  const double allowed = std::max(1.0, partAtWorst<N>(v, a, bounds));
  Vector<N> next = most, next_v = v + 0.5 * dt * (a + most);
  for (double share = 0.5; partAtWorst<N>(next_v, next, bounds) > allowed; share *= 0.5) {
    // Letting go is allowed always, and exactly so when it ends within the step.
    next = share > 0.01 ? Vector<N>(least + share * (most - least)) : least;
    next_v = v + 0.5 * dt * (a + next);
    if (share > 0.01) continue;
    if (size <= change) next_v = v + a * (size / (2.0 * bounds.jerk));
    break;
  }
  now.position += dt * v + dt * dt / 6.0 * (2.0 * a + next);
  now.velocity = next_v;
  now.acceleration = next;
  now.jerk = (next - a) / dt;
}

// The motion of some of x, y, z.
template <int N, int First>
Motion<N> partOf(const SetPoint& s) noexcept {
  return {s.position.segment<N>(First), s.velocity.segment<N>(First),
          s.acceleration.segment<N>(First), s.jerk.segment<N>(First)};
}

// The reference slows down from half of the lead on, horizontally and vertically apart: one that
// waits for the vehicle sideways must go on sinking.
template <int N, int First>
void advancePart(SetPoint& s, const SetPoint& wanted, const Bounds& bounds,
                 const Eigen::Vector3d& ahead, double longest, double dt) noexcept {
  Motion<N> motion = partOf<N, First>(s);
  Lead<N> lead = {ahead.segment<N>(First), 1.0};
  const double length = lead.ahead.norm();
  if (length > 0.5 * longest) lead.speed = std::max(0.0, 2.0 - 2.0 * length / longest);
  advance<N>(motion, partOf<N, First>(wanted), bounds, lead, dt);
  s.position.segment<N>(First) = motion.position;
  s.velocity.segment<N>(First) = motion.velocity;
  s.acceleration.segment<N>(First) = motion.acceleration;
  s.jerk.segment<N>(First) = motion.jerk;
}

void advanceYaw(SetPoint& s, const SetPoint& wanted, const Bounds& bounds, double dt) noexcept {
  using One = Vector<1>;
  Motion<1> motion = {One(s.yaw), One(s.yaw_rate), One(s.yaw_acceleration), One(0.0)};
  const double yaw = s.yaw + std::remainder(wanted.yaw - s.yaw, kTwoPi);
  advance<1>(motion, {One(yaw), One(wanted.yaw_rate), One(wanted.yaw_acceleration), One(0.0)},
             bounds, {One(0.0), 1.0}, dt);
  s.yaw = motion.position[0];
  s.yaw_rate = motion.velocity[0];
  s.yaw_acceleration = motion.acceleration[0];
}

}  // namespace

GovernorLimits readGovernorLimits(const ParameterReader& reader) {
  GovernorLimits limits;
  const auto read = [&](const char* key, double& limit) {
    limit = reader.number(key, Range::positive(), limit);
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
  const double lowest = std::fmax(floor, limits_.floor);
  if (wanted_.position.z() >= lowest) return;
  wanted_.position.z() = lowest;
  wanted_.velocity.z() = wanted_.acceleration.z() = wanted_.jerk.z() = 0.0;
}

void ReferenceGovernor::step(const Eigen::Vector3d& actual, double thrust_to_weight,
                             double dt) noexcept {
  // Half of the spare thrust may go upwards, what is left then sideways.
  const GovernorLimits& l = limits_;
  const double thrust = kSteeringReserve * thrust_to_weight * kGravity;
  const double up = std::max(kLeastAcceleration, 0.5 * (thrust - kGravity));
  const double vertical = std::min(l.vertical_acceleration, up);
  const double lift = kGravity + vertical;
  const double aside = std::sqrt(std::max(0.0, thrust * thrust - lift * lift));
  const double horizontal = std::min(l.acceleration, std::max(kLeastAcceleration, aside));

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
  const int pieces = static_cast<int>(std::ceil(std::min(dt, 2.0) / kLongestStep));
  for (int i = 0; i < pieces; ++i) step(actual, thrust_to_weight, std::min(dt, 2.0) / pieces);
  const Eigen::Vector3d ahead = reference_.position - actual;
  if (ahead.head<2>().norm() > limits_.lead) {
    reference_.position.head<2>() = actual.head<2>() + within<2>(ahead.head<2>(), limits_.lead);
  }
  if (std::abs(ahead.z()) > limits_.lead) {
    reference_.position.z() = actual.z() + std::copysign(limits_.lead, ahead.z());
  }
  return reference_;
}

}  // namespace aqc
