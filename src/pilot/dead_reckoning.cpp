#include "adaptive_quadrotor_control/pilot/dead_reckoning.h"

#include "adaptive_quadrotor_control/math/rotations.h"

namespace aqc {
namespace {

constexpr double kGain = 0.1;              // of a message
constexpr double kBiasGain = kGain / 5.0;  // [1/s]: a bias is known after 5 s
// What differs by more is no bias but a push, as of a load that was picked up.
constexpr double kLargestGain = 0.02;      // [m/s]
constexpr double kLargestTurn = 0.005;     // [rad]
constexpr double kLargestForceBias = 1.0;  // [m/s^2]
constexpr double kLargestRateBias = 0.1;   // [rad/s]

Eigen::Vector3d clamped(const Eigen::Vector3d& vector, double most) noexcept {
  return vector.cwiseMax(-most).cwiseMin(most);
}

}  // namespace

DeadReckoning::DeadReckoning(const Vehicle& vehicle)
    : inertia_(vehicle.inertia), inverse_inertia_(vehicle.inertia.inverse()) {}

void DeadReckoning::feel(const Eigen::Vector3d& specific_force,
                         const Eigen::Vector3d& body_rate) noexcept {
  specific_force_ = specific_force;
  body_rate_ = body_rate;
  felt_ = true;
}

void DeadReckoning::correct(const State& state, const Innovation& innovation) noexcept {
  if (!felt_) return restart(state);
  const Eigen::Vector3d& turned = innovation.turned;
  const Eigen::Vector3d& gained = innovation.velocity;
  const Eigen::Vector3d felt = state_.attitude.conjugate() * clamped(gained, kLargestGain);
  force_bias_ = clamped(force_bias_ - kBiasGain * felt, kLargestForceBias);
  rate_bias_ = clamped(rate_bias_ - kBiasGain * clamped(turned, kLargestTurn), kLargestRateBias);
  state_.position += kGain * innovation.position;
  state_.velocity += kGain * gained;
  state_.attitude = state_.attitude * turn(turned, kGain);
}

void DeadReckoning::advance(const Wrench& given, double mass, double dt) noexcept {
  Eigen::Vector3d specific_force = specific_force_ - force_bias_;
  if (felt_) {
    state_.body_rate = body_rate_ - rate_bias_;
  } else {
    specific_force = given.thrust / mass * Eigen::Vector3d::UnitZ();
    const Eigen::Vector3d spin = inertia_ * state_.body_rate;
    state_.body_rate += dt * (inverse_inertia_ * (given.moment - state_.body_rate.cross(spin)));
  }
  const Eigen::Vector3d acceleration =
      state_.attitude * specific_force - kGravity * Eigen::Vector3d::UnitZ();
  state_.position += dt * state_.velocity + 0.5 * dt * dt * acceleration;
  state_.velocity += dt * acceleration;
  state_.attitude = state_.attitude * turn(state_.body_rate, dt);
  keepUnit(state_.attitude);
}

}  // namespace aqc
