#include "adaptive_quadrotor_control/simulation/flexible_plant.h"

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "simulation/cable_load.h"
#include "simulation/joint_load.h"

namespace aqc {

FlexiblePlant::FlexiblePlant(const Vehicle& vehicle, const State& start, std::vector<Box> walls,
                             bool ground)
    : vehicle_(vehicle, start, std::move(walls), ground) {}

FlexiblePlant::~FlexiblePlant() = default;

void FlexiblePlant::step(const RotorArray& command, double dt) noexcept {
  if (load_) return load_->advance(*vehicle_.body_, command, dt);
  vehicle_.step(command, dt);
}

bool FlexiblePlant::touching() const noexcept {
  return vehicle_.touching() || (load_ && load_->touching());
}

void FlexiblePlant::requireNone() const {
  if (payload()) throw std::logic_error("a payload is attached already; detach it first");
}

FreeMotion FlexiblePlant::below(const Payload& payload, const Eigen::Vector3d& velocity) const {
  const State state = this->state();
  FreeMotion motion = {state.position + state.attitude * payload.offset, velocity};
  const double length = std::get<Cable>(payload.mount).length;
  double height = motion.position.z() - length;
  if (hasGround()) height = std::max(height, 0.5 * payload.size.z());
  motion.position.z() = std::min(height, motion.position.z() + length);
  return motion;
}

void FlexiblePlant::attach(const Payload& payload, const Eigen::Vector3d& velocity) {
  requireNone();
  if (std::holds_alternative<Cable>(payload.mount)) return hang(payload, below(payload, velocity));
  if (payload.rigid()) return vehicle_.attach(payload, velocity);
  const Joint& joint = std::get<Joint>(payload.mount);
  load_ = std::make_unique<kernel::JointLoad>(payload, joint, velocity, *vehicle_.body_);
  hanging_ = payload;
}

void FlexiblePlant::pickUp(const Payload& payload, const FreeMotion& motion) {
  if (!std::holds_alternative<Cable>(payload.mount)) return attach(payload, motion.velocity);
  requireNone();
  const State state = this->state();
  const Eigen::Vector3d hook = state.position + state.attitude * payload.offset;
  const Eigen::Vector3d away = motion.position - hook;
  const double share = std::get<Cable>(payload.mount).length / std::max(away.norm(), 1e-9);
  hang(payload, {hook + std::min(share, 1.0) * away, motion.velocity});
}

void FlexiblePlant::hang(const Payload& payload, const FreeMotion& motion) {
  const Cable& cable = std::get<Cable>(payload.mount);
  load_ = std::make_unique<kernel::CableLoad>(payload, cable, motion, *vehicle_.body_);
  hanging_ = payload;
}

FreeMotion FlexiblePlant::detach() {
  if (!load_) return vehicle_.detach();
  const FreeMotion motion = load_->freeMotion();
  load_.reset();
  hanging_.reset();
  return motion;
}

const std::optional<Payload>& FlexiblePlant::payload() const noexcept {
  return load_ ? hanging_ : vehicle_.payload();
}

FreeMotion FlexiblePlant::payloadMotion() const noexcept {
  return load_ ? load_->freeMotion() : vehicle_.payloadMotion();
}

double FlexiblePlant::payloadMass() const noexcept {
  return vehicle_.payloadMass() + (load_ ? hanging_->mass : 0.0);
}

Eigen::Vector3d FlexiblePlant::linearMomentum() const {
  Eigen::Vector3d sum = vehicle_.linearMomentum();
  if (load_) sum += hanging_->mass * load_->motion().velocity;
  return sum;
}

Eigen::Vector3d FlexiblePlant::angularMomentum(const Eigen::Vector3d& point) const {
  Eigen::Vector3d sum = vehicle_.angularMomentum(point);
  if (!load_) return sum;
  const kernel::LoadMotion& load = load_->motion();
  return sum + (load.position - point).cross(hanging_->mass * load.velocity) + load_->spin();
}

double FlexiblePlant::energy() const {
  const kernel::Carrier vehicle = vehicle_.body_->carrier();
  const Eigen::Vector3d& rate = vehicle.body_rate;
  double sum =
      vehicle_.mass() * (0.5 * vehicle.velocity.squaredNorm() + kGravity * vehicle.position.z()) +
      0.5 * rate.dot(vehicle_.inertia() * rate);
  if (!load_) return sum;
  const kernel::LoadMotion& load = load_->motion();
  sum += hanging_->mass * (0.5 * load.velocity.squaredNorm() + kGravity * load.position.z());
  return sum + load_->spinEnergy() + load_->storedEnergy(vehicle);
}

}  // namespace aqc
