#include "adaptive_quadrotor_control/law/geometric.h"

#include "adaptive_quadrotor_control/parameters/parameter_reader.h"
#include "law/gain_ranges.h"

namespace aqc {

Geometric::Geometric(const ParameterReader& reader, const Vehicle& vehicle, BodyRate follows)
    : CascadedLaw(reader),
      mass_(vehicle.mass),
      inertia_(vehicle.inertia),
      follows_jerk_(follows == BodyRate::kJerk),
      position_gain_(
          reader.vector3({"position_gain", "k_x", "N/m", "stiffness of the position"}, kPush)),
      velocity_gain_(
          reader.vector3({"velocity_gain", "k_v", "N s/m", "damping of the velocity"}, kPush)),
      attitude_gain_(
          reader.vector3({"attitude_gain", "k_R", "N m/rad", "stiffness of the attitude"}, kPush)),
      rate_gain_(reader.vector3({"rate_gain", "k_omega", "N m s/rad", "damping of the body rate"},
                                kPush)) {}

Eigen::Vector3d Geometric::force(const PositionErrors& errors, const SetPoint& set_point) noexcept {
  const Eigen::Vector3d force =
      mass_ * (set_point.acceleration + kGravity * Eigen::Vector3d::UnitZ()) -
      position_gain_.cwiseProduct(errors.position) - velocity_gain_.cwiseProduct(errors.velocity);
  if (follows_jerk_) turn_ = turnOf(force, mass_ * set_point.jerk);
  return force;
}

Eigen::Vector3d Geometric::moment(const State& state, const AttitudeErrors& errors) noexcept {
  const Eigen::Vector3d gyroscopic = state.body_rate.cross(inertia_ * state.body_rate);
  return gyroscopic - attitude_gain_.cwiseProduct(errors.angle) -
         rate_gain_.cwiseProduct(errors.rate);
}

}  // namespace aqc
