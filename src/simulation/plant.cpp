#include "adaptive_quadrotor_control/simulation/plant.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

namespace aqc {
namespace {

// Adds the inertia of a mass at `arm` from the reference point (parallel axes).
Eigen::Matrix3d pointInertia(double mass, const Eigen::Vector3d& arm) {
  return mass * (arm.squaredNorm() * Eigen::Matrix3d::Identity() - arm * arm.transpose());
}

}  // namespace

// What RK4 integrates: motion of the centre of mass, or its change with time.
struct Plant::Motion {
  Plain3 position;
  Plain3 velocity;
  PlainQuaternion attitude;
  Plain3 body_rate;

  Motion after(double time, const Motion& slope) const {
    return {position + time * slope.position,
            velocity + time * slope.velocity,
            {attitude.vector + time * slope.attitude.vector,
             attitude.scalar + time * slope.attitude.scalar},
            body_rate + time * slope.body_rate};
  }
  Motion operator+(const Motion& other) const {
    return {position + other.position,
            velocity + other.velocity,
            {attitude.vector + other.attitude.vector, attitude.scalar + other.attitude.scalar},
            body_rate + other.body_rate};
  }
};

Plant::Plant(const Vehicle& vehicle, const State& start, std::vector<Box> walls, bool ground)
    : vehicle_(vehicle),
      empty_mass_(vehicle.mass),
      contact_(vehicle, std::move(walls), ground),
      state_(start),
      speeds_(RotorArray::Zero(static_cast<Eigen::Index>(vehicle.rotors.size()))) {
  state_.attitude.normalize();
  updateMassProperties();
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
  inverse_inertia_ = inertia_.inverse();
  for (std::size_t i = 0; i < vehicle_.rotors.size(); ++i) {
    const Eigen::Vector2d arm = vehicle_.rotors[i].position() - centre_.head<2>();
    hubs_[i] = {arm.x(), arm.y(), arm.squaredNorm(),
                -vehicle_.rotors[i].direction * vehicle_.moment_constant};
  }
  contact_.setPayload(payload_ ? &*payload_ : nullptr);
  loads_ = rotorLoads(speeds_);
}

void Plant::attach(const Payload& payload, const Eigen::Vector3d& velocity) {
  if (payload_) throw std::logic_error("a payload is attached already; detach it first");
  const Eigen::Vector3d where = state_.position + state_.attitude * payload.offset;
  const Eigen::Vector3d linear = linearMomentum() + payload.mass * velocity;
  const Eigen::Vector3d angular = angularMomentum(where);
  payload_ = payload;
  updateMassProperties();

  // Both bodies now move as one with the momentum they had; the payload's own has no moment about
  // where it is.
  const Eigen::Vector3d lever = state_.attitude * (centre_ - payload.offset);
  state_.body_rate =
      inverse_inertia_ * (state_.attitude.conjugate() * (angular - lever.cross(linear)));
  state_.velocity = linear / mass_ - state_.attitude * state_.body_rate.cross(centre_);
}

void Plant::detach() {
  if (!payload_) throw std::logic_error("no payload is attached");
  payload_.reset();
  updateMassProperties();
}

void Plant::setBody(double mass, const Eigen::Matrix3d& inertia) {
  vehicle_.mass = mass;
  vehicle_.inertia = inertia;
  updateMassProperties();
}

double Plant::payloadMass() const noexcept {
  return (payload_ ? payload_->mass : 0.0) + (vehicle_.mass - empty_mass_);
}

Eigen::Vector3d Plant::linearMomentum() const {
  return mass_ * (state_.velocity + state_.attitude * state_.body_rate.cross(centre_));
}

Eigen::Vector3d Plant::angularMomentum(const Eigen::Vector3d& point) const {
  const Eigen::Vector3d arm = state_.position + state_.attitude * centre_ - point;
  return state_.attitude * (inertia_ * state_.body_rate) + arm.cross(linearMomentum());
}

Plant::RotorLoads Plant::rotorLoads(const RotorArray& speeds) const noexcept {
  RotorLoads loads = {};
  for (Eigen::Index i = 0; i < speeds.size(); ++i) {
    const Hub& hub = hubs_[static_cast<std::size_t>(i)];
    const double speed = speeds[i];
    const double thrust = vehicle_.force_constant * speed * speed;
    loads.thrust += thrust;
    loads.moment = loads.moment + thrust * Plain3{hub.y, -hub.x, hub.yaw};
    loads.speed_sum += speed;
    loads.speed_moment_x += hub.x * speed;
    loads.speed_moment_y += hub.y * speed;
    loads.speed_inertia += hub.distance_squared * speed;
  }
  return loads;
}

// Rotor drag -c_d |omega_i| v_i and rolling moment -c_r |omega_i| v_i act at every hub, where v_i
// is the hub's velocity through the air across the rotor axis. Being linear in the motion, their
// sum over the rotors needs only the sums in `rotors`.
[[gnu::always_inline]] inline Plant::Motion Plant::derivative(
    const Motion& motion, const RotorLoads& rotors) const noexcept {
  const PlainRotation R(motion.attitude);  // of unit norm to rounding and RK4's order
  const Plain3& rate = motion.body_rate;
  const Plain3 air = R.toBody(motion.velocity - Plain3::from(wind_));
  const double height = -centre_.z();  // of the rotors' plane above the centre of mass
  // Velocity in the rotors' plane, above or below the centre of mass, without the spin's share.
  const double base_x = air.x + rate.y * height;
  const double base_y = air.y - rate.x * height;
  const double flow_x = rotors.speed_sum * base_x - rate.z * rotors.speed_moment_y;
  const double flow_y = rotors.speed_sum * base_y + rate.z * rotors.speed_moment_x;
  const double turning = rotors.speed_moment_x * base_y - rotors.speed_moment_y * base_x +
                         rate.z * rotors.speed_inertia;
  const double drag = vehicle_.drag_coefficient;
  const double rolling = vehicle_.rolling_moment_coefficient;

  Plain3 force =
      R.toWorld({-drag * flow_x, -drag * flow_y, rotors.thrust}) + Plain3::from(disturbance_.force);
  Plain3 moment = rotors.moment + Plain3::from(disturbance_.moment) - cross(rate, inertia_ * rate) +
                  Plain3{height * drag * flow_y - rolling * flow_x,
                         -height * drag * flow_x - rolling * flow_y, -drag * turning};
  if (near_contact_) {
    const ForceMoment contact = contactForce(motion);
    force = force + Plain3::from(contact.force);
    moment = moment + Plain3::from(contact.moment);
  }

  Motion change;
  change.position = motion.velocity;
  change.velocity = inverse_mass_ * force - Plain3{0.0, 0.0, kGravity};
  // Half the quaternion product of the attitude and (rate, 0).
  const Plain3 half = 0.5 * rate;
  change.attitude.vector = motion.attitude.scalar * half + cross(motion.attitude.vector, half);
  change.attitude.scalar = -dot(motion.attitude.vector, half);
  change.body_rate = inverse_inertia_ * moment;
  return change;
}

[[gnu::noinline, gnu::cold]] ForceMoment Plant::contactForce(const Motion& motion) const noexcept {
  const PlainRotation R(motion.attitude);
  const Plain3 centre = Plain3::from(centre_);
  const Plain3 position = motion.position - R.toWorld(centre);
  const Plain3 velocity = motion.velocity - R.toWorld(cross(motion.body_rate, centre));
  return contact_.force(position.eigen(), R.eigen(), velocity.eigen(), motion.body_rate.eigen(),
                        centre_);
}

[[gnu::always_inline]] inline void Plant::setMotion(const Motion& motion) noexcept {
  const PlainQuaternion& q = motion.attitude;
  const double scale = 1.0 / std::sqrt(dot(q.vector, q.vector) + q.scalar * q.scalar);
  const PlainQuaternion attitude = {scale * q.vector, scale * q.scalar};
  const PlainRotation R(attitude);
  const Plain3 centre = Plain3::from(centre_);
  state_.position = (motion.position - R.toWorld(centre)).eigen();
  state_.velocity = (motion.velocity - R.toWorld(cross(motion.body_rate, centre))).eigen();
  state_.attitude =
      Eigen::Quaterniond(attitude.scalar, attitude.vector.x, attitude.vector.y, attitude.vector.z);
  state_.body_rate = motion.body_rate.eigen();
}

void Plant::step(const RotorArray& command, double dt) noexcept {
  if (dt != step_) {  // a fixed step pays for the exponentials once
    step_ = dt;
    decay_up_ = std::exp(-0.5 * dt / vehicle_.time_constant_up);
    decay_down_ = std::exp(-0.5 * dt / vehicle_.time_constant_down);
  }
  RotorArray half(speeds_.size());
  for (Eigen::Index i = 0; i < speeds_.size(); ++i) {
    const bool usable = crash_ == Crash::kNone && i < command.size() && std::isfinite(command[i]);
    const double target = usable ? std::clamp(command[i], 0.0, vehicle_.max_rotor_speed) : 0.0;
    const double decay = target > speeds_[i] ? decay_up_ : decay_down_;
    half[i] = target + (speeds_[i] - target) * decay;
    speeds_[i] = target + (half[i] - target) * decay;
  }
  const RotorLoads loads_start = loads_;
  const RotorLoads loads_half = rotorLoads(half);
  loads_ = rotorLoads(speeds_);

  const Plain3 centre = Plain3::from(centre_);
  const PlainQuaternion attitude = PlainQuaternion::from(state_.attitude);
  const PlainRotation R(attitude);
  const Plain3 rate = Plain3::from(state_.body_rate);
  const Motion start = {Plain3::from(state_.position) + R.toWorld(centre),
                        Plain3::from(state_.velocity) + R.toWorld(cross(rate, centre)), attitude,
                        rate};
  const double speed = std::sqrt(dot(start.velocity, start.velocity));
  near_contact_ = contact_.near(state_.position, 0.01 + 2.0 * dt * speed);

  const Motion k1 = derivative(start, loads_start);
  const Motion k2 = derivative(start.after(0.5 * dt, k1), loads_half);
  const Motion k3 = derivative(start.after(0.5 * dt, k2), loads_half);
  const Motion k4 = derivative(start.after(dt, k3), loads_);
  const Motion middle = k2 + k3;
  setMotion(start.after(dt / 6.0, k1 + middle + middle + k4));

  specific_force_ = (R.toBody(k1.velocity + Plain3{0.0, 0.0, kGravity}) -
                     cross(k1.body_rate, centre) - cross(rate, cross(rate, centre)))
                        .eigen();

  touching_ = false;
  if (near_contact_) {
    const Contact::Judgement judgement = contact_.judge(
        state_.position, state_.attitude.toRotationMatrix(), state_.velocity, state_.body_rate);
    touching_ = judgement.touching;
    if (crash_ == Crash::kNone) crash_ = judgement.crash;
  }
}

}  // namespace aqc
