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

// Whether two attitudes are surely less than `most` [rad] apart, at a small part of the cost of
// their distance: an angle is at most pi times the sine of its half.
bool isTurnedLess(const Eigen::Quaterniond& a, const Eigen::Quaterniond& b, double most) noexcept {
  return 10.0 * (a.conjugate() * b).vec().squaredNorm() < most * most;
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
  if (!state.position.allFinite() || !state.velocity.allFinite() || !state.body_rate.allFinite() ||
      !state.attitude.coeffs().allFinite()) {
    return Doubt::kNotFinite;
  }
  if (stamp > now && stamp - now > limits_.stamp_ahead) return Doubt::kStampAhead;
  const double norm = state.attitude.norm();
  if (!(std::abs(norm - 1.0) <= limits_.norm)) return Doubt::kNoUnitQuaternion;
  state.attitude.coeffs() /= norm;
  if (state.position.cwiseAbs().maxCoeff() > limits_.position ||
      state.velocity.cwiseAbs().maxCoeff() > limits_.velocity ||
      state.body_rate.cwiseAbs().maxCoeff() > limits_.body_rate) {
    return Doubt::kAbsurd;
  }
  return Doubt::kNone;
}

bool OdometryGate::believes(const Eigen::Vector3d& specific_force,
                            const Eigen::Vector3d& body_rate) const noexcept {
  // Comparisons with not-a-number are false.
  return (specific_force.array().abs() <= limits_.specific_force).all() &&
         (body_rate.array().abs() <= limits_.body_rate).all();
}

Doubt OdometryGate::jumped(const State& state, const State& expected,
                           double silence) const noexcept {
  const double speed = kUnknownAcceleration * silence;
  const double turn = std::min(limits_.turn_jump + kUnknownRate * silence, kLargestTurnJump);
  if (!isTurnedLess(state.attitude, expected.attitude, turn) &&
      state.attitude.angularDistance(expected.attitude) > turn) {
    return Doubt::kTurnJump;
  }
  if ((state.position - expected.position).norm() > limits_.jump + 0.5 * speed * silence) {
    return Doubt::kPositionJump;
  }
  if ((state.velocity - expected.velocity).norm() > limits_.speed_jump + speed) {
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

double OdometryGate::unfeltRise(const State& state, const State& expected,
                                double silence) const noexcept {
  const double rise = state.position.z() - expected.position.z();
  const double error = limits_.jump + 0.5 * kUnknownBias * silence * silence;
  return std::abs(rise) > error ? rise : 0.0;
}

Doubt OdometryGate::compare(const State& state, const State& expected, double silence) noexcept {
  reset_ = false;
  const Doubt doubt = jumped(state, expected, silence);
  if (doubt == Doubt::kNone || doubt == Doubt::kTurnJump) {
    agreeing_ = 0;
    return doubt;
  }
  const bool agrees = agreeing_ > 0 && jumped(state, candidate_, 0.0) == Doubt::kNone;
  agreeing_ = agrees ? agreeing_ + 1 : 1;
  candidate_ = state;
  if (agreeing_ < limits_.confirmations) return doubt;
  agreeing_ = 0;
  reset_ = true;
  return Doubt::kNone;
}

}  // namespace aqc
