// The rigid body between steps; rigid_body_step.cpp has its motion over one.
#include "simulation/rigid_body.h"

#include <algorithm>
#include <utility>

namespace aqc::kernel {

RigidBody::RigidBody(const Vehicle& vehicle, std::vector<Box> walls, bool ground)
    : vehicle_(vehicle),
      contact_(vehicle, std::move(walls), ground),
      speed_limit_(vehicle.max_rotor_speed),
      speeds_(RotorArray::Zero(static_cast<Eigen::Index>(vehicle.rotors.size()))) {}

State RigidBody::stateOf(const Motion& motion) const noexcept {
  const PlainRotation R(motion.attitude);
  const Plain3 centre = Plain3::from(centre_);
  State state;
  state.position = (motion.position - R.toWorld(centre)).eigen();
  state.velocity = (motion.velocity - R.toWorld(cross(motion.body_rate, centre))).eigen();
  state.attitude = motion.attitude.eigen();
  state.body_rate = motion.body_rate.eigen();
  return state;
}

void RigidBody::setState(const State& state) noexcept {
  const Motion before = motion_;
  motion_.attitude = PlainQuaternion::from(state.attitude);
  motion_.body_rate = Plain3::from(state.body_rate);
  const PlainRotation R(motion_.attitude);
  const Plain3 centre = Plain3::from(centre_);
  motion_.position = Plain3::from(state.position) + R.toWorld(centre);
  motion_.velocity = Plain3::from(state.velocity) + R.toWorld(cross(motion_.body_rate, centre));
  const double half_norm_error = 0.5 * (1.0 - state.attitude.squaredNorm());
  if (!(absurdity(motion_, half_norm_error) < 1.0)) standStill(before);
}

void RigidBody::standStill(const Motion& last) noexcept {
  const auto attitude = PlainQuaternion::from(last.attitude.eigen().normalized());
  motion_ = Motion{last.position, Plain3{}, attitude, Plain3{}};
  felt_ = Felt{attitude, Plain3{}, Plain3{}, Plain3{}, Plain3::from(centre_)};
  bearable_ = 0.0;
  if (crash_ == Crash::kNone) crash_ = Crash::kDiverged;
}

void RigidBody::strike(const ForceMoment& impulse) noexcept {
  motion_.velocity = motion_.velocity + inverse_mass_ * Plain3::from(impulse.force);
  motion_.body_rate = motion_.body_rate + inverse_inertia_ * Plain3::from(impulse.moment);
}

Eigen::Vector3d RigidBody::specificForce() const noexcept {
  const Plain3 up = {Pair{0.0, 0.0}, both(kGravity)};
  const Plain3 felt = PlainRotation(felt_.attitude).toBody(felt_.acceleration + up);
  const Plain3& rate = felt_.body_rate;
  const Plain3& centre = felt_.centre;
  return (felt - cross(felt_.angular_acceleration, centre) - cross(rate, cross(rate, centre)))
      .eigen();
}

void RigidBody::setMass(double mass, const Eigen::Vector3d& centre, const Eigen::Matrix3d& inertia,
                        const Payload* payload) {
  inverse_mass_ = 1.0 / mass;
  centre_ = centre;
  centre_distance_ = centre_.norm();
  inertia_ = Plain33::from(inertia);
  inverse_inertia_ = Plain33::from(inertia.inverse());
  for (std::size_t i = 0; i < vehicle_.rotors.size(); ++i) updateHub(i);
  lift_per_square_ = inverse_mass_ * vehicle_.force_constant;
  contact_.setPayload(payload);
  setDisturbance(disturbance_);
}

void RigidBody::updateHub(std::size_t index) noexcept {
  const Rotor& rotor = vehicle_.rotors[index];
  const Eigen::Vector2d arm = rotor.position() - centre_.head<2>();
  const double force = conditions_[index].effectiveness * vehicle_.force_constant;
  const double yaw = -rotor.direction * vehicle_.moment_constant;
  Hub& hub = hubs_[index];
  hub.arm = turned(Pair{arm.x(), arm.y()});
  hub.tilting = -force * hub.arm;
  hub.about_z = Pair{force * yaw, arm.squaredNorm()};
}

void RigidBody::setRotor(std::size_t index, const RotorCondition& condition) noexcept {
  conditions_[index] = condition;
  updateHub(index);
  if (condition.stuck_at && crash_ == Crash::kNone) {
    speeds_[static_cast<Eigen::Index>(index)] =
        std::min(*condition.stuck_at, vehicle_.max_rotor_speed);
  }
  const auto sound = [](const RotorCondition& rotor) { return rotor.sound(); };
  damaged_ = !std::all_of(conditions_.begin(), conditions_.end(), sound);
  setDisturbance(disturbance_);
}

}  // namespace aqc::kernel
