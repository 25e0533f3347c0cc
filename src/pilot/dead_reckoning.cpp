#include "adaptive_quadrotor_control/pilot/dead_reckoning.h"

namespace aqc {
namespace {

// The turn of a body that spins at `rate` for `dt` seconds.
Eigen::Quaterniond turn(const Eigen::Vector3d& rate, double dt) noexcept {
  const double speed = rate.norm();
  const double half = 0.5 * speed * dt;
  const double scale = speed > 1e-9 ? std::sin(half) / speed : 0.5 * dt;
  return {std::cos(half), scale * rate.x(), scale * rate.y(), scale * rate.z()};
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

void DeadReckoning::advance(const Wrench& given, double mass, double dt) noexcept {
  Eigen::Vector3d specific_force = specific_force_;
  if (felt_) {
    state_.body_rate = body_rate_;
  } else {
    specific_force = given.thrust / mass * Eigen::Vector3d::UnitZ();
    const Eigen::Vector3d spin = inertia_ * state_.body_rate;
    state_.body_rate += dt * (inverse_inertia_ * (given.moment - state_.body_rate.cross(spin)));
  }
  const Eigen::Vector3d acceleration =
      state_.attitude * specific_force - kGravity * Eigen::Vector3d::UnitZ();
  state_.position += dt * state_.velocity + 0.5 * dt * dt * acceleration;
  state_.velocity += dt * acceleration;
  state_.attitude = (state_.attitude * turn(state_.body_rate, dt)).normalized();
}

}  // namespace aqc
