#include "adaptive_quadrotor_control/simulation/cargo.h"

#include "adaptive_quadrotor_control/model/state.h"

namespace aqc {

void Cargo::fall(double dt, bool ground) noexcept {
  const double resting_height = 0.5 * payload.size.z();
  if (ground && position.z() <= resting_height) return;
  const Eigen::Vector3d gravity = -kGravity * Eigen::Vector3d::UnitZ();
  position += dt * velocity + 0.5 * dt * dt * gravity;
  velocity += dt * gravity;
  if (ground && position.z() <= resting_height) {
    position.z() = resting_height;
    velocity.setZero();
  }
}

}  // namespace aqc
