#include "adaptive_quadrotor_control/simulation/plant.h"

#include <stdexcept>
#include <utility>

namespace aqc {
namespace {

// Adds the inertia of a mass at `arm` from the reference point (parallel axes).
Eigen::Matrix3d pointInertia(double mass, const Eigen::Vector3d& arm) {
  return mass * (arm.squaredNorm() * Eigen::Matrix3d::Identity() - arm * arm.transpose());
}

}  // namespace

Plant::Plant(const Vehicle& vehicle, const State& start, std::vector<Box> walls, bool ground)
    : vehicle_(vehicle),
      empty_mass_(vehicle.mass),
      contact_(vehicle, std::move(walls), ground),
      speeds_(RotorArray::Zero(static_cast<Eigen::Index>(vehicle.rotors.size()))) {
  updateMassProperties();
  State unit = start;
  unit.attitude.normalize();
  setState(unit);
}

State Plant::stateOf(const Motion& motion) const noexcept {
  const PlainRotation R(motion.attitude);
  const Plain3 centre = Plain3::from(centre_);
  State state;
  state.position = (motion.position - R.toWorld(centre)).eigen();
  state.velocity = (motion.velocity - R.toWorld(cross(motion.body_rate, centre))).eigen();
  state.attitude = motion.attitude.eigen();
  state.body_rate = motion.body_rate.eigen();
  return state;
}

void Plant::setState(const State& state) noexcept {
  motion_.attitude = PlainQuaternion::from(state.attitude);
  motion_.body_rate = Plain3::from(state.body_rate);
  const PlainRotation R(motion_.attitude);
  const Plain3 centre = Plain3::from(centre_);
  motion_.position = Plain3::from(state.position) + R.toWorld(centre);
  motion_.velocity = Plain3::from(state.velocity) + R.toWorld(cross(motion_.body_rate, centre));
}

Eigen::Vector3d Plant::specificForce() const noexcept {
  const Plain3 up = {Pair{0.0, 0.0}, both(kGravity)};
  const Plain3 felt = PlainRotation(felt_.attitude).toBody(felt_.acceleration + up);
  const Plain3& rate = felt_.body_rate;
  const Plain3& centre = felt_.centre;
  return (felt - cross(felt_.angular_acceleration, centre) - cross(rate, cross(rate, centre)))
      .eigen();
}

void Plant::updateMassProperties() {
  mass_ = vehicle_.mass;
  centre_.setZero();
  inertia_ = vehicle_.inertia;
  if (payload_) {
    mass_ += payload_->mass;
    centre_ = payload_->mass / mass_ * payload_->offset;
    inertia_ += pointInertia(vehicle_.mass, centre_) + payload_->inertia +
                pointInertia(payload_->mass, payload_->offset - centre_);
  }
  inverse_mass_ = 1.0 / mass_;
  centre_distance_ = centre_.norm();
  inverse_inertia_ = inertia_.inverse();
  plain_inertia_ = Plain33::from(inertia_);
  plain_inverse_inertia_ = Plain33::from(inverse_inertia_);
  for (std::size_t i = 0; i < vehicle_.rotors.size(); ++i) {
    const Rotor& rotor = vehicle_.rotors[i];
    const Eigen::Vector2d arm = rotor.position() - centre_.head<2>();
    const double yaw = -rotor.direction * vehicle_.moment_constant;
    hubs_[i].arm = turned(Pair{arm.x(), arm.y()});
    hubs_[i].tilting = -vehicle_.force_constant * hubs_[i].arm;
    hubs_[i].about_z = Pair{vehicle_.force_constant * yaw, arm.squaredNorm()};
  }
  lift_per_square_ = inverse_mass_ * vehicle_.force_constant;
  contact_.setPayload(payload_ ? &*payload_ : nullptr);
  setDisturbance(disturbance_);
}

void Plant::attach(const Payload& payload, const Eigen::Vector3d& velocity) {
  if (payload_) throw std::logic_error("a payload is attached already; detach it first");
  State state = this->state();
  const Eigen::Vector3d where = state.position + state.attitude * payload.offset;
  const Eigen::Vector3d linear = linearMomentum() + payload.mass * velocity;
  const Eigen::Vector3d angular = angularMomentum(where);
  payload_ = payload;
  updateMassProperties();

  // Both bodies now move as one with the momentum they had; the payload's own has no moment about
  // where it is.
  const Eigen::Vector3d lever = state.attitude * (centre_ - payload.offset);
  state.body_rate =
      inverse_inertia_ * (state.attitude.conjugate() * (angular - lever.cross(linear)));
  state.velocity = linear / mass_ - state.attitude * state.body_rate.cross(centre_);
  setState(state);
}

void Plant::detach() {
  if (!payload_) throw std::logic_error("no payload is attached");
  const State state = this->state();
  payload_.reset();
  updateMassProperties();
  setState(state);
}

void Plant::setBody(double mass, const Eigen::Matrix3d& inertia) {
  const State state = this->state();
  vehicle_.mass = mass;
  vehicle_.inertia = inertia;
  updateMassProperties();
  setState(state);
}

double Plant::payloadMass() const noexcept {
  return (payload_ ? payload_->mass : 0.0) + (vehicle_.mass - empty_mass_);
}

Eigen::Vector3d Plant::linearMomentum() const {
  return mass_ * motion_.velocity.eigen();
}

Eigen::Vector3d Plant::angularMomentum(const Eigen::Vector3d& point) const {
  const Eigen::Vector3d spin = motion_.attitude.eigen() * (inertia_ * motion_.body_rate.eigen());
  return spin + (motion_.position.eigen() - point).cross(linearMomentum());
}

}  // namespace aqc
