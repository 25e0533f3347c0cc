#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>

#include "adaptive_quadrotor_control/math/approach_speed.h"

namespace aqc {

// The motion of one axis, or of some together, towards a wanted one within bounds of speed,
// acceleration and jerk: what ReferenceGovernor does in (x, y), z and yaw.

template <int N>
using Vector = Eigen::Matrix<double, N, 1>;

template <int N>
struct Motion {
  Vector<N> position, velocity, acceleration, jerk;
};

struct MotionBounds {
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

namespace shaper {

constexpr double kFar = 1e9;             // squares of more lose their meaning [m]
constexpr double kBrakingReserve = 0.7;  // part of the acceleration that braking plans with
constexpr double kClose = 1e-4;          // [m], [rad]
constexpr double kAlike = 1e-3;          // [m/s], [rad/s]

inline double square(double number) noexcept {
  return number * number;
}

// In one dimension a norm needs no root.
template <int N>
double length(const Vector<N>& vector) noexcept {
  if constexpr (N == 1) return std::abs(vector[0]);
  return vector.norm();
}

template <int N>
bool isWithin(const Vector<N>& vector, double longest) noexcept {
  if constexpr (N == 1) return std::abs(vector[0]) <= longest;
  return vector.squaredNorm() <= square(longest);
}

template <int N>
Vector<N> within(const Vector<N>& vector, double longest) noexcept {
  if (isWithin<N>(vector, longest)) return vector;
  return vector * (longest / length<N>(vector));
}

// Speed as a multiple of the one allowed.
template <int N>
double part(const Vector<N>& velocity, const MotionBounds& bounds) noexcept {
  if constexpr (N == 1) {
    return velocity[0] > 0.0 ? velocity[0] / bounds.up : -velocity[0] / bounds.down;
  } else {
    return velocity.norm() / bounds.up;
  }
}

// Whether a displacement is one that the speed allows in `time`.
template <int N>
bool isSlow(const Vector<N>& displacement, const MotionBounds& bounds, double time = 1.0) noexcept {
  if constexpr (N == 1) {
    return displacement[0] <= bounds.up * time && -displacement[0] <= bounds.down * time;
  }
  return displacement.squaredNorm() <= square(bounds.up * time);
}

// part() at worst until the acceleration is let go straight: the velocity goes on a line then.
template <int N>
double partAtWorst(const Vector<N>& v, const Vector<N>& a, const MotionBounds& bounds) noexcept {
  const Vector<N> end = v + a * (length<N>(a) / (2.0 * bounds.jerk));
  return std::max(part<N>(v, bounds), part<N>(end, bounds));
}

// Whether that is at most `allowed`, >= 1. Mostly it is, by far, and then no root is needed.
template <int N>
bool isSlowAtWorst(const Vector<N>& v, const Vector<N>& a, const MotionBounds& bounds,
                   double allowed) noexcept {
  const double rest = std::min(bounds.up, bounds.down) - a.squaredNorm() / (2.0 * bounds.jerk);
  if (rest > 0.0 && isWithin<N>(v, rest)) return true;
  return partAtWorst<N>(v, a, bounds) <= allowed;
}

// Whether the wanted motion is one that the limits allow after the present one. What tells most
// often that it is not comes first.
template <int N>
bool leadsTo(const Motion<N>& now, const Motion<N>& wanted, const MotionBounds& bounds,
             const Lead<N>& lead, double dt) noexcept {
  const Vector<N> dp = wanted.position - now.position, dv = wanted.velocity - now.velocity;
  return isWithin<N>(dp - 0.5 * dt * (now.velocity + wanted.velocity), kClose) &&
         isWithin<N>(dv - 0.5 * dt * (now.acceleration + wanted.acceleration),
                     kAlike + 0.25 * bounds.jerk * dt * dt) &&
         isSlow<N>(dp, bounds, dt) && isWithin<N>(dv, bounds.acceleration * dt) &&
         isWithin<N>(wanted.acceleration - now.acceleration, bounds.jerk * dt) &&
         isWithin<N>(wanted.acceleration, bounds.acceleration) &&
         isWithin<N>(wanted.jerk, bounds.jerk) &&
         isSlowAtWorst<N>(wanted.velocity, wanted.acceleration, bounds, 1.0) &&
         (lead.speed >= 1.0 ||
          wanted.velocity.dot(lead.ahead) <= lead.speed * bounds.up * length<N>(lead.ahead));
}

// Takes from `velocity` what goes away faster than the lead allows; whether there was such.
template <int N>
bool holdBack(Vector<N>& velocity, const MotionBounds& bounds, const Lead<N>& lead) noexcept {
  if (lead.speed >= 1.0) return false;
  const double ahead = length<N>(lead.ahead);
  const double too_fast = velocity.dot(lead.ahead) - lead.speed * bounds.up * ahead;
  if (!(too_fast > 0.0)) return false;
  velocity -= lead.ahead * (too_fast / (ahead * ahead));
  return true;
}

// The velocity to have at the end of the step and how it should change then.
template <int N>
void seek(const Motion<N>& now, const Vector<N>& v, const Motion<N>& wanted,
          const MotionBounds& bounds, double dt, Vector<N>& velocity,
          Vector<N>& acceleration) noexcept {
  velocity = wanted.velocity;
  if (!isSlow<N>(velocity, bounds)) velocity /= part<N>(velocity, bounds);
  acceleration = within<N>(wanted.acceleration, bounds.acceleration);
  const Vector<N> error = (wanted.position - now.position - 0.5 * dt * (now.velocity + v))
                              .cwiseMax(-kFar)
                              .cwiseMin(kFar);
  const double distance = length<N>(error);
  if (distance > 0.0) {
    const ApproachSpeed to_point =
        approachSpeed(distance, bounds.gain, kBrakingReserve * bounds.acceleration);
    const Vector<N> drift = velocity - v;
    const Vector<N> direction = error / distance;
    const double turning = to_point.speed / distance;
    velocity += direction * to_point.speed;
    acceleration +=
        turning * drift + direction * ((to_point.slope - turning) * direction.dot(drift));
  }
  if (isSlow<N>(velocity, bounds)) return;
  const double excess = part<N>(velocity, bounds);
  velocity /= excess;
  acceleration /= excess;
  acceleration -= velocity * (std::max(0.0, velocity.dot(acceleration)) / velocity.squaredNorm());
}

// The acceleration to have at the end of the step.
template <int N>
Vector<N> sought(const Motion<N>& now, const Motion<N>& wanted, const MotionBounds& bounds,
                 const Lead<N>& lead, double dt) noexcept {
  const Vector<N> v = now.velocity + dt * now.acceleration;
  Vector<N> velocity, acceleration;
  seek<N>(now, v, wanted, bounds, dt, velocity, acceleration);
  if (holdBack<N>(velocity, bounds, lead)) acceleration.setZero();
  const Vector<N> miss = velocity - v;
  const double size = length<N>(miss);
  const double gain = std::min(2.5 * bounds.gain, 0.5 / dt);
  if (size > 0.0) {
    acceleration += miss * (approachSpeed(size, gain, kBrakingReserve * bounds.jerk).speed / size);
  }
  return within<N>(acceleration, bounds.acceleration);
}

// One step of acceleration from a towards `most`, as far as the speed bears it.
template <int N>
void accelerate(Motion<N>& now, const Vector<N>& most, const MotionBounds& bounds,
                double dt) noexcept {
  const Vector<N> v = now.velocity, a = now.acceleration;
  Vector<N> next = most, next_v = v + 0.5 * dt * (a + most);
  if (!isSlowAtWorst<N>(next_v, next, bounds, 1.0)) {
    const double change = bounds.jerk * dt, size = length<N>(a);
    const Vector<N> least = a * (size > change ? 1.0 - change / size : 0.0);
    const double allowed = std::max(1.0, partAtWorst<N>(v, a, bounds));
    for (double share = 0.5; partAtWorst<N>(next_v, next, bounds) > allowed; share *= 0.5) {
      // Letting go is allowed always, and exactly so when it ends within the step.
      next = share > 0.01 ? Vector<N>(least + share * (most - least)) : least;
      next_v = v + 0.5 * dt * (a + next);
      if (share > 0.01) continue;
      if (size <= change) next_v = v + a * (size / (2.0 * bounds.jerk));
      break;
    }
  }
  now.position += dt * v + dt * dt / 6.0 * (2.0 * a + next);
  now.velocity = next_v;
  now.acceleration = next;
  now.jerk = (next - a) / dt;
}

}  // namespace shaper

// At rest where it is to rest.
template <int N>
bool hasArrived(const Motion<N>& now, const Motion<N>& wanted) noexcept {
  const auto rests = [](const Motion<N>& motion) {
    return motion.velocity.isZero(0.0) && motion.acceleration.isZero(0.0) &&
           motion.jerk.isZero(0.0);
  };
  return now.position == wanted.position && rests(now) && rests(wanted);
}

// `now` becomes the motion `dt` seconds later.
template <int N>
void advance(Motion<N>& now, const Motion<N>& wanted, const MotionBounds& bounds,
             const Lead<N>& lead, double dt) noexcept {
  if (shaper::leadsTo<N>(now, wanted, bounds, lead, dt)) {
    now = wanted;
    return;
  }
  const Vector<N> a = now.acceleration;
  const Vector<N> change = shaper::sought<N>(now, wanted, bounds, lead, dt) - a;
  const Vector<N> most = a + shaper::within<N>(change, bounds.jerk * dt);
  shaper::accelerate<N>(now, most, bounds, dt);
}

}  // namespace aqc
