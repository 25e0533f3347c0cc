#include "adaptive_quadrotor_control/simulation/rigid_plant.h"

#include <stdexcept>
#include <utility>

#include "simulation/rigid_body.h"

namespace aqc {
namespace {

// Adds the inertia of a mass at `arm` from the reference point (parallel axes).
Eigen::Matrix3d pointInertia(double mass, const Eigen::Vector3d& arm) {
  return mass * (arm.squaredNorm() * Eigen::Matrix3d::Identity() - arm * arm.transpose());
}

}  // namespace

RigidPlant::RigidPlant(const Vehicle& vehicle, const State& start, std::vector<Box> walls,
                       bool ground)
    : empty_mass_(vehicle.mass),
      vehicle_{vehicle.mass, Eigen::Vector3d::Zero(), vehicle.inertia},
      body_(std::make_unique<kernel::RigidBody>(vehicle, std::move(walls), ground)) {
  updateWhole();
  State unit = start;
  unit.attitude.normalize();
  body_->setState(unit);
}

RigidPlant::RigidPlant(const RigidPlant& other)
    : Plant(other),
      empty_mass_(other.empty_mass_),
      vehicle_(other.vehicle_),
      payload_(other.payload_),
      whole_(other.whole_),
      body_(std::make_unique<kernel::RigidBody>(*other.body_)) {}

RigidPlant& RigidPlant::operator=(const RigidPlant& other) {
  return *this = RigidPlant(other);
}

RigidPlant::RigidPlant(RigidPlant&& other) noexcept = default;
RigidPlant& RigidPlant::operator=(RigidPlant&& other) noexcept = default;
RigidPlant::~RigidPlant() = default;

void RigidPlant::step(const RotorArray& command, double dt) noexcept {
  body_->step(command, dt);
}

double RigidPlant::longestStep() const noexcept {
  return body_->contact().longestStep();
}

State RigidPlant::state() const noexcept {
  return body_->state();
}

const RotorArray& RigidPlant::rotorSpeeds() const noexcept {
  return body_->rotorSpeeds();
}

Eigen::Vector3d RigidPlant::specificForce() const noexcept {
  return body_->specificForce();
}

bool RigidPlant::hasGround() const noexcept {
  return body_->contact().hasGround();
}

bool RigidPlant::touching() const noexcept {
  return body_->touching();
}

Crash RigidPlant::crash() const noexcept {
  return body_->crash();
}

void RigidPlant::setWind(const Eigen::Vector3d& velocity) noexcept {
  body_->setWind(velocity);
}

void RigidPlant::setDisturbance(const ForceMoment& disturbance) noexcept {
  body_->setDisturbance(disturbance);
}

void RigidPlant::setRotor(std::size_t index, const RotorCondition& condition) noexcept {
  body_->setRotor(index, condition);
}

void RigidPlant::setSpeedLimit(double share) noexcept {
  body_->setSpeedLimit(share);
}

void RigidPlant::updateWhole() {
  whole_ = vehicle_;
  if (payload_) {
    whole_.mass += payload_->mass;
    whole_.centre = payload_->mass / whole_.mass * payload_->offset;
    whole_.inertia += pointInertia(vehicle_.mass, whole_.centre) + payload_->inertia +
                      pointInertia(payload_->mass, payload_->offset - whole_.centre);
  }
  body_->setMass(whole_.mass, whole_.centre, whole_.inertia, payload_ ? &*payload_ : nullptr);
}

void RigidPlant::attach(const Payload& payload, const Eigen::Vector3d& velocity) {
  if (payload_) throw std::logic_error("a payload is attached already; detach it first");
  if (!payload.rigid()) throw std::invalid_argument("this plant has no joint and no cable");
  State state = this->state();
  const Eigen::Vector3d where = state.position + state.attitude * payload.offset;
  const Eigen::Vector3d linear = linearMomentum() + payload.mass * velocity;
  const Eigen::Vector3d angular = angularMomentum(where);
  payload_ = payload;
  updateWhole();

  // Both bodies now move as one with the momentum they had; the payload's own has no moment about
  // where it is.
  const Eigen::Vector3d lever = state.attitude * (whole_.centre - payload.offset);
  const Eigen::Matrix3d inverse_inertia = whole_.inertia.inverse();
  state.body_rate =
      inverse_inertia * (state.attitude.conjugate() * (angular - lever.cross(linear)));
  state.velocity = linear / whole_.mass - state.attitude * state.body_rate.cross(whole_.centre);
  body_->setState(state);
}

FreeMotion RigidPlant::detach() {
  if (!payload_) throw std::logic_error("no payload is attached");
  const State state = this->state();
  const FreeMotion motion = payloadMotion();
  payload_.reset();
  updateWhole();
  body_->setState(state);
  return motion;
}

FreeMotion RigidPlant::payloadMotion() const noexcept {
  const State state = this->state();
  if (!payload_) return {state.position, state.velocity};
  const Eigen::Vector3d& offset = payload_->offset;
  return {state.position + state.attitude * offset,
          state.velocity + state.attitude * state.body_rate.cross(offset)};
}

void RigidPlant::setBody(double mass, const Eigen::Matrix3d& inertia) {
  const State state = this->state();
  vehicle_.mass = mass;
  vehicle_.inertia = inertia;
  updateWhole();
  body_->setState(state);
}

double RigidPlant::payloadMass() const noexcept {
  return (payload_ ? payload_->mass : 0.0) + (vehicle_.mass - empty_mass_);
}

Eigen::Vector3d RigidPlant::linearMomentum() const {
  return whole_.mass * body_->motion().velocity.eigen();
}

Eigen::Vector3d RigidPlant::angularMomentum(const Eigen::Vector3d& point) const {
  const kernel::Motion& motion = body_->motion();
  const Eigen::Vector3d spin =
      motion.attitude.eigen() * (whole_.inertia * motion.body_rate.eigen());
  return spin + (motion.position.eigen() - point).cross(linearMomentum());
}

}  // namespace aqc
