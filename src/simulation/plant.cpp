#include "adaptive_quadrotor_control/simulation/plant.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace aqc {
namespace {

// Adds the inertia of a mass at `arm` from the reference point (parallel axes).
Eigen::Matrix3d pointInertia(double mass, const Eigen::Vector3d& arm) {
  return mass * (arm.squaredNorm() * Eigen::Matrix3d::Identity() - arm * arm.transpose());
}

}  // namespace

Plant::Plant(const Vehicle& vehicle, const State& start)
    : vehicle_(vehicle),
      contact_(vehicle),
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
  inverse_inertia_ = inertia_.inverse();
  for (std::size_t i = 0; i < vehicle_.rotors.size(); ++i) {
    hubs_[i] << vehicle_.rotors[i].position(), 0.0;
    hubs_[i] -= centre_;
  }
  contact_.setPayload(payload_ ? &*payload_ : nullptr);
}

void Plant::attach(const Payload& payload) {
  if (payload_) throw std::logic_error("a payload is attached already; detach it first");
  const Eigen::Vector3d where = state_.position + state_.attitude * payload.offset;
  const Eigen::Vector3d linear = linearMomentum();
  const Eigen::Vector3d angular = angularMomentum(where);
  payload_ = payload;
  updateMassProperties();

  // Both bodies now move as one with the momentum the vehicle had (the payload was at rest).
  Motion joined = motion();
  joined.velocity = linear / mass_;
  const Eigen::Vector3d spin = angular - (joined.position - where).cross(linear);
  joined.body_rate = inverse_inertia_ * (state_.attitude.conjugate() * spin);
  setMotion(joined);
}

void Plant::detach() {
  if (!payload_) throw std::logic_error("no payload is attached");
  payload_.reset();
  updateMassProperties();
}

Eigen::Vector3d Plant::linearMomentum() const { return mass_ * motion().velocity; }

Eigen::Vector3d Plant::angularMomentum(const Eigen::Vector3d& point) const {
  const Motion now = motion();
  return state_.attitude * (inertia_ * now.body_rate) +
         (now.position - point).cross(mass_ * now.velocity);
}

Plant::Motion Plant::motion() const {
  return {state_.position + state_.attitude * centre_,
          state_.velocity + state_.attitude * state_.body_rate.cross(centre_),
          state_.attitude.coeffs(), state_.body_rate};
}

void Plant::setMotion(const Motion& motion) {
  state_.attitude.coeffs() = motion.attitude.normalized();
  state_.body_rate = motion.body_rate;
  state_.position = motion.position - state_.attitude * centre_;
  state_.velocity = motion.velocity - state_.attitude * state_.body_rate.cross(centre_);
}

Plant::RotorLoads Plant::rotorLoads(const RotorArray& speeds) const noexcept {
  RotorLoads loads;
  for (Eigen::Index i = 0; i < speeds.size(); ++i) {
    const auto index = static_cast<std::size_t>(i);
    const Eigen::Vector3d& hub = hubs_[index];
    const double thrust = vehicle_.force_constant * speeds[i] * speeds[i];
    loads.thrust += thrust;
    loads.moment.x() += hub.y() * thrust;
    loads.moment.y() -= hub.x() * thrust;
    loads.moment.z() -= vehicle_.rotors[index].direction * vehicle_.moment_constant * thrust;
    loads.speed_sum += speeds[i];
    loads.speed_moment += speeds[i] * hub.head<2>();
    loads.speed_inertia += speeds[i] * hub.head<2>().squaredNorm();
  }
  return loads;
}

// Rotor drag -c_d |omega_i| v_i and rolling moment -c_r |omega_i| v_i of all rotors together, where
// v_i is the hub's velocity through the air across the rotor axis. Being linear in the motion, the
// sum over the rotors needs only the sums in `rotors`. Force and moment both in B.
ForceMoment Plant::aerodynamics(const RotorLoads& rotors, const Eigen::Vector3d& air_velocity,
                                const Eigen::Vector3d& body_rate) const noexcept {
  const double height = hubs_[0].z();
  const double spin = body_rate.z();
  // Velocity in the rotor plane at the centre of mass's foot point, without the spin's share.
  const Eigen::Vector2d base(air_velocity.x() + body_rate.y() * height,
                             air_velocity.y() - body_rate.x() * height);
  const Eigen::Vector2d& lever = rotors.speed_moment;
  const Eigen::Vector2d flow =
      rotors.speed_sum * base + spin * Eigen::Vector2d(-lever.y(), lever.x());
  const double turning =
      lever.x() * base.y() - lever.y() * base.x() + spin * rotors.speed_inertia;

  const Eigen::Vector2d drag = -vehicle_.drag_coefficient * flow;
  const Eigen::Vector2d rolling = -vehicle_.rolling_moment_coefficient * flow;
  ForceMoment result;
  result.force << drag, 0.0;
  result.moment << rolling.x() - height * drag.y(), rolling.y() + height * drag.x(),
      -vehicle_.drag_coefficient * turning;
  return result;
}

Plant::Motion Plant::derivative(const Motion& motion, const RotorLoads& rotors) const noexcept {
  const Eigen::Quaterniond attitude(motion.attitude);  // normalised to rounding and RK4's order
  const Eigen::Matrix3d R = attitude.toRotationMatrix();
  const Eigen::Vector3d& rate = motion.body_rate;

  const ForceMoment air =
      aerodynamics(rotors, R.transpose() * (motion.velocity - wind_), rate);
  Eigen::Vector3d body_force = air.force;
  body_force.z() += rotors.thrust;
  Eigen::Vector3d force = R * body_force + disturbance_.force;
  Eigen::Vector3d moment = rotors.moment + air.moment + disturbance_.moment;
  if (near_ground_) {
    const ForceMoment ground =
        contact_.force(motion.position - R * centre_, R,
                       motion.velocity - R * rate.cross(centre_), rate, centre_);
    force += ground.force;
    moment += ground.moment;
  }

  Motion change;
  change.position = motion.velocity;
  change.velocity = force / mass_;
  change.velocity.z() -= kGravity;
  change.attitude = 0.5 * (attitude * Eigen::Quaterniond(0.0, rate.x(), rate.y(), rate.z())).coeffs();
  change.body_rate = inverse_inertia_ * (moment - rate.cross(inertia_ * rate));
  return change;
}

void Plant::step(const RotorArray& command, double dt) noexcept {
  if (dt != step_) {  // a fixed step pays for the exponentials once
    step_ = dt;
    decay_up_ = std::exp(-0.5 * dt / vehicle_.time_constant_up);
    decay_down_ = std::exp(-0.5 * dt / vehicle_.time_constant_down);
  }
  RotorArray half(speeds_.size());
  RotorArray end(speeds_.size());
  for (Eigen::Index i = 0; i < speeds_.size(); ++i) {
    const bool usable = crash_ == Crash::kNone && i < command.size() && std::isfinite(command[i]);
    const double target = usable ? std::clamp(command[i], 0.0, vehicle_.max_rotor_speed) : 0.0;
    const double decay = target > speeds_[i] ? decay_up_ : decay_down_;
    half[i] = target + (speeds_[i] - target) * decay;
    end[i] = target + (half[i] - target) * decay;
  }
  const RotorLoads loads_start = rotorLoads(speeds_);
  const RotorLoads loads_half = rotorLoads(half);
  const RotorLoads loads_end = rotorLoads(end);
  speeds_ = end;

  const Motion start = motion();
  // Above its own reach plus what it can move in a step nothing can touch.
  near_ground_ = state_.position.z() < contact_.reach() + 0.01 + 2.0 * dt * start.velocity.norm();
  const auto along = [&start](const Motion& slope, double time) {
    return Motion{start.position + time * slope.position, start.velocity + time * slope.velocity,
                  start.attitude + time * slope.attitude, start.body_rate + time * slope.body_rate};
  };
  const Motion k1 = derivative(start, loads_start);
  const Motion k2 = derivative(along(k1, 0.5 * dt), loads_half);
  const Motion k3 = derivative(along(k2, 0.5 * dt), loads_half);
  const Motion k4 = derivative(along(k3, dt), loads_end);

  const Eigen::Vector3d& rate = start.body_rate;
  specific_force_ = state_.attitude.conjugate() *
                        (k1.velocity + kGravity * Eigen::Vector3d::UnitZ()) -
                    k1.body_rate.cross(centre_) - rate.cross(rate.cross(centre_));

  const double sixth = dt / 6.0;
  setMotion({start.position + sixth * (k1.position + 2.0 * (k2.position + k3.position) + k4.position),
             start.velocity + sixth * (k1.velocity + 2.0 * (k2.velocity + k3.velocity) + k4.velocity),
             start.attitude + sixth * (k1.attitude + 2.0 * (k2.attitude + k3.attitude) + k4.attitude),
             start.body_rate +
                 sixth * (k1.body_rate + 2.0 * (k2.body_rate + k3.body_rate) + k4.body_rate)});

  touching_ = false;
  if (near_ground_) {
    const Contact::Judgement judgement =
        contact_.judge(state_.position, state_.attitude.toRotationMatrix(), state_.velocity,
                       state_.body_rate);
    touching_ = judgement.touching;
    if (crash_ == Crash::kNone) crash_ = judgement.crash;
  }
}

}  // namespace aqc
