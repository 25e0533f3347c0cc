#include "adaptive_quadrotor_control/pilot/odometry_gate.h"

#include <algorithm>
#include <cmath>

namespace aqc {
namespace {

// How much faster than reckoned a vehicle may become, pushed by whatever: what a silence adds to
// the jumps that are allowed [m/s^2] and [rad/s].
constexpr double kUnknownAcceleration = 15.0;
constexpr double kUnknownRate = 4.0;
// Whatever the silence: an attitude that is half a turn off is no vehicle's [rad].
constexpr double kLargestTurnJump = 1.5;
// What is left of an accelerometer's bias and of a tilt that is not known [m/s^2].
constexpr double kUnknownBias = 0.5;

constexpr double kRounding = 1e-12;  // of a unit quaternion's squared norm

// Of every component; comparisons with not-a-number are false.
bool isWithin(const Eigen::Vector3d& vector, double most) noexcept {
  return std::abs(vector.x()) <= most && std::abs(vector.y()) <= most &&
         std::abs(vector.z()) <= most;
}

bool isFinite(const State& state) noexcept {
  return state.position.allFinite() && state.velocity.allFinite() && state.body_rate.allFinite() &&
         state.attitude.coeffs().allFinite();
}

bool isLonger(const Eigen::Vector3d& vector, double length) noexcept {
  return vector.squaredNorm() > length * length;
}

// Whether a turn (see Innovation) is of a larger angle than `most` [rad]. Mostly it is smaller by
// far, which needs no arc: an angle is at most pi times the sine of its half.
bool isTurnedMore(const Eigen::Vector3d& turned, double most) noexcept {
  const double squared = turned.squaredNorm();
  if (2.5 * squared < most * most) return false;
  return 2.0 * std::asin(std::min(1.0, 0.5 * std::sqrt(squared))) > most;
}

}  // namespace

const char* textOf(Doubt doubt) noexcept {
  switch (doubt) {
    case Doubt::kNone:
      break;
    case Doubt::kNotFinite:
      return "it is not finite or not a pose";
    case Doubt::kStampAhead:
      return "its stamp is ahead of now";
    case Doubt::kNoUnitQuaternion:
      return "its quaternion is not of norm 1";
    case Doubt::kAbsurd:
      return "no vehicle is there or so fast";
    case Doubt::kPositionJump:
      return "its position jumps";
    case Doubt::kVelocityJump:
      return "its velocity jumps";
    case Doubt::kTurnJump:
      return "its attitude jumps";
    case Doubt::kFrozen:
      return "it has frozen";
    case Doubt::kFirst:
      return "it is the first after a silence";
  }
  return nullptr;
}

Doubt OdometryGate::look(State& state, Nanoseconds stamp, Nanoseconds now) const noexcept {
  const bool bounded = isWithin(state.position, limits_.position) &&
                       isWithin(state.velocity, limits_.velocity) &&
                       isWithin(state.body_rate, limits_.body_rate);
  const double squared_norm = state.attitude.squaredNorm();
  if ((!bounded || !std::isfinite(squared_norm)) && !isFinite(state)) return Doubt::kNotFinite;
  if (stamp > now && stamp - now > limits_.stamp_ahead) return Doubt::kStampAhead;
  if (!(std::abs(squared_norm - 1.0) < kRounding)) {
    const double norm = std::sqrt(squared_norm);
    if (!(std::abs(norm - 1.0) <= limits_.norm)) return Doubt::kNoUnitQuaternion;
    state.attitude.coeffs() /= norm;
  }
  return bounded ? Doubt::kNone : Doubt::kAbsurd;
}

bool OdometryGate::believes(const Eigen::Vector3d& specific_force,
                            const Eigen::Vector3d& body_rate) const noexcept {
  return isWithin(specific_force, limits_.specific_force) && isWithin(body_rate, limits_.body_rate);
}

Doubt OdometryGate::jumped(const Innovation& innovation, double silence) const noexcept {
  const double speed = kUnknownAcceleration * silence;
  const double turn = std::min(limits_.turn_jump + kUnknownRate * silence, kLargestTurnJump);
  if (isTurnedMore(innovation.turned, turn)) return Doubt::kTurnJump;
  if (isLonger(innovation.position, limits_.jump + 0.5 * speed * silence)) {
    return Doubt::kPositionJump;
  }
  if (isLonger(innovation.velocity, limits_.speed_jump + speed)) {
    return Doubt::kVelocityJump;
  }
  return Doubt::kNone;
}

bool OdometryGate::frozen(const State& state, const State& last) noexcept {
  return state.position == last.position && state.velocity == last.velocity &&
         state.body_rate == last.body_rate && state.attitude.coeffs() == last.attitude.coeffs();
}

bool OdometryGate::first(const State& state) noexcept {
  const bool alone = !first_ || frozen(state, *first_);
  first_ = state;
  return alone;
}

double OdometryGate::unfeltRise(const Innovation& innovation, double silence) const noexcept {
  const double rise = innovation.position.z();
  const double error = limits_.jump + 0.5 * kUnknownBias * silence * silence;
  return std::abs(rise) > error ? rise : 0.0;
}

Doubt OdometryGate::compare(const State& state, const Innovation& innovation,
                            double silence) noexcept {
  reset_ = false;
  const Doubt doubt = jumped(innovation, silence);
  if (doubt == Doubt::kNone || doubt == Doubt::kTurnJump) {
    agreeing_ = 0;
    return doubt;
  }
  const bool agrees = agreeing_ > 0 && jumped(innovationOf(state, candidate_), 0.0) == Doubt::kNone;
  agreeing_ = agrees ? agreeing_ + 1 : 1;
  candidate_ = state;
  if (agreeing_ < limits_.confirmations) return doubt;
  agreeing_ = 0;
  reset_ = true;
  return Doubt::kNone;
}

}  // namespace aqc
