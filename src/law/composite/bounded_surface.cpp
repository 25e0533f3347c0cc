#include "adaptive_quadrotor_control/law/composite/bounded_surface.h"

#include <algorithm>
#include <cmath>

#include "adaptive_quadrotor_control/math/approach_speed.h"

namespace aqc {
namespace {

// phi and its slope at the distance r >= 0.
struct Point {
  double value;
  double slope;
  bool linear;
};

Point at(double r, const Approach& approach) noexcept {
  const ApproachSpeed phi = approachSpeed(r, approach.slope, approach.braking);
  if (phi.speed > approach.speed) return {approach.speed, 0.0, false};
  return {phi.speed, phi.slope, r <= approach.braking / (approach.slope * approach.slope)};
}

}  // namespace

BoundedSurface::BoundedSurface(const Eigen::Vector3d& error, const Approach& sideways,
                               const Approach& vertical) noexcept {
  const double distance = error.head<2>().norm();
  const Point side = at(distance, sideways);
  const bool away = distance > 0.0;
  direction_ = away ? Eigen::Vector2d(error.head<2>() / distance) : Eigen::Vector2d::UnitX();
  radial_ = side.slope;
  tangential_ = side.linear ? side.slope : side.value / distance;
  linear_sideways_ = side.linear;

  const Point height = at(std::abs(error.z()), vertical);
  vertical_ = height.slope;
  linear_vertically_ = height.linear;
  value_ << side.value * direction_, std::copysign(height.value, error.z());
}

Eigen::Vector3d BoundedSurface::slopeTimes(const Eigen::Vector3d& vector) const noexcept {
  const double along = direction_.dot(vector.head<2>());
  Eigen::Vector3d product;
  product << tangential_ * vector.head<2>() + ((radial_ - tangential_) * along) * direction_,
      vertical_ * vector.z();
  return product;
}

}  // namespace aqc
