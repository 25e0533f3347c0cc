// The rigid body's motion over one step; rigid_body.cpp has what happens between steps.
#include <algorithm>
#include <cmath>

#include "adaptive_quadrotor_control/model/rotor_lag.h"
#include "simulation/hanging_load.h"
#include "simulation/rigid_body.h"

namespace aqc::kernel {
namespace {

// Makes a quaternion nearly unit whose norm an integration step has moved a little, times this: one
// step of Newton's method, which leaves 3/8 of the square of the norm's relative error, without
// root and division.
Pair unitScale(const PlainQuaternion& q) {
  return 1.5 - 0.5 * (dot(q.xy, q.xy) + dot(q.zw, q.zw));
}

}  // namespace

inline Motion Motion::after(double time, const Motion& slope) const {
  return {position + time * slope.position, velocity + time * slope.velocity,
          attitude + time * slope.attitude, body_rate + time * slope.body_rate};
}

inline Motion Motion::operator+(const Motion& other) const {
  return {position + other.position, velocity + other.velocity, attitude + other.attitude,
          body_rate + other.body_rate};
}

[[gnu::noinline, gnu::cold]] double RigidBody::givenSquares(
    const RotorArray& speeds) const noexcept {
  double sum = 0.0;
  for (Eigen::Index i = 0; i < speeds.size(); ++i) {
    sum += conditions_[static_cast<std::size_t>(i)].effectiveness * (speeds[i] * speeds[i]);
  }
  return sum;
}

template <bool damaged>
[[gnu::always_inline]] inline RigidBody::RotorLoads RigidBody::rotorLoads(
    const RotorArray& speeds) const noexcept {
  RotorLoads loads = {};
  loads.tilting = Plain3::from(disturbance_.moment).xy;
  loads.about_z = Pair{disturbance_.moment.z(), 0.0};
  for (Eigen::Index i = 0; i < speeds.size(); ++i) {
    const Hub& hub = hubs_[static_cast<std::size_t>(i)];
    const double speed = speeds[i];
    const Pair square_and_speed = {speed * speed, speed};
    loads.sums += square_and_speed;
    loads.about_z += square_and_speed * hub.about_z;
    loads.tilting += square_and_speed[0] * hub.tilting;
    loads.arm += speed * hub.arm;
  }
  if (damaged) loads.sums[0] = givenSquares(speeds);
  return loads;
}

void RigidBody::setDisturbance(const ForceMoment& disturbance) noexcept {
  disturbance_ = disturbance;
  steady_acceleration_ = inverse_mass_ * Plain3::from(disturbance.force);
  steady_acceleration_.zz -= kGravity;
  loads_ = damaged_ ? rotorLoads<true>(speeds_) : rotorLoads<false>(speeds_);
}

// Newton and Euler for the whole of mass m and inertia J, with the centre of mass at p moving at v,
// attitude q (R as a matrix), body rate w, and rotor i at r_i from the centre of mass:
//
//     p' = v
//     v' = 1/m (R f + F + F_contact) - g e_z
//     q' = 1/2 q (0, w)
//     J w' = M - w x J w + M_disturbance + M_contact
//
//     v_i = P (R' (v - wind) + w x r_i)         velocity of the hub in the air, across the axis
//     d_i = -c_d |omega_i| v_i                  rotor drag
//     t_i = e_i k_f omega_i^2                   thrust of a rotor of effectiveness e_i
//     f = sum_i t_i e_z + d_i                   in B
//     M = sum_i r_i x (t_i e_z + d_i) - c_r |omega_i| v_i - dir_i k_m t_i e_z
//
// where P = diag(1, 1, 0), and F, M_disturbance are the disturbance. Drag and rolling moment are
// linear in the motion: their sums over the rotors need only the sums in `rotors`. The same plant
// without shortcuts is Textbook in plant_reference_test.cpp.
[[gnu::always_inline]] inline Motion RigidBody::derivative(
    const Motion& motion, const RotorLoads& rotors) const noexcept {
  const PlainRotation R(motion.attitude);  // of unit norm to rounding and RK4's order
  const Plain3& rate = motion.body_rate;
  const double height = -centre_.z();  // of the rotors' plane above the centre of mass
  // Velocity in the rotors' plane, above or below the centre of mass, without the spin's share.
  const Pair hub_air = R.acrossBody(motion.velocity - wind_, -height * turned(rate.xy));
  const Pair flow = rotors.sums[1] * hub_air + rate.zz * rotors.arm;  // sum |omega_i| v_i
  const Pair turning = dot(rotors.arm, hub_air) + rate.zz * second(rotors.about_z);
  const double drag = vehicle_.drag_coefficient;

  Plain3 acceleration =
      R.toWorld(-drag * inverse_mass_ * flow,
                lift_per_square_ * rotors.sums[0] * R.axisZ() + steady_acceleration_);
  Plain3 moment = Plain3{rotors.tilting, first(rotors.about_z)} - cross(rate, inertia_ * rate);
  moment.xy -= vehicle_.rolling_moment_coefficient * flow;
  moment.xy -= drag * height * turned(flow);
  moment.zz -= drag * turning;
  if (near_contact_) {
    const ForceMoment contact = contactForce(motion);
    acceleration = acceleration + inverse_mass_ * Plain3::from(contact.force);
    moment = moment + Plain3::from(contact.moment);
  }
  return {motion.velocity, acceleration, motion.attitude * (0.5 * rate), inverse_inertia_ * moment};
}

[[gnu::noinline, gnu::cold]] ForceMoment RigidBody::contactForce(Motion motion) const noexcept {
  const State state = stateOf(motion);
  return contact_.force(state.position, state.attitude.toRotationMatrix(), state.velocity,
                        state.body_rate, centre_);
}

// The speed that a rotor is to reach.
[[gnu::always_inline]] inline double RigidBody::target(const RotorArray& command,
                                                       Eigen::Index rotor) const noexcept {
  const bool usable =
      crash_ == Crash::kNone && rotor < command.size() && std::isfinite(command[rotor]);
  return usable ? std::clamp(command[rotor], 0.0, speed_limit_) : 0.0;
}

[[gnu::noinline, gnu::cold]] RotorArray RigidBody::turnDamagedRotors(const RotorArray& command,
                                                                     double dt) noexcept {
  RotorArray half(speeds_.size());
  for (Eigen::Index i = 0; i < speeds_.size(); ++i) {
    const RotorCondition& condition = conditions_[static_cast<std::size_t>(i)];
    if (condition.stuck_at && crash_ == Crash::kNone) {
      half[i] = speeds_[i];
      continue;
    }
    const double target = this->target(command, i);
    const double lag =
        target > speeds_[i] ? vehicle_.time_constant_up : vehicle_.time_constant_down;
    const double decay = lagDecay(0.5 * dt, condition.slower * lag);
    half[i] = target + (speeds_[i] - target) * decay;
    speeds_[i] = target + (half[i] - target) * decay;
  }
  return half;
}

// Turns the rotors over a step; returns their speeds halfway.
[[gnu::always_inline]] inline RotorArray RigidBody::turnRotors(const RotorArray& command,
                                                               double dt) noexcept {
  if (dt != step_) {  // a fixed step pays for the exponentials once
    step_ = dt;
    decay_[1] = lagDecay(0.5 * dt, vehicle_.time_constant_up);
    decay_[0] = lagDecay(0.5 * dt, vehicle_.time_constant_down);
  }
  RotorArray half(speeds_.size());
  for (Eigen::Index i = 0; i < speeds_.size(); ++i) {
    const double target = this->target(command, i);
    const double decay = decay_[target > speeds_[i]];
    half[i] = target + (speeds_[i] - target) * decay;
    speeds_[i] = target + (half[i] - target) * decay;
  }
  return half;
}

template <bool damaged>
[[gnu::always_inline]] inline RigidBody::RotorStages RigidBody::beginStep(const RotorArray& command,
                                                                          double dt) noexcept {
  const RotorArray speeds_half = damaged ? turnDamagedRotors(command, dt) : turnRotors(command, dt);
  const RotorLoads loads_start = loads_;
  const RotorLoads loads_half = rotorLoads<damaged>(speeds_half);
  loads_ = rotorLoads<damaged>(speeds_);

  const Plain3& v = motion_.velocity;
  const double speed_bound = std::abs(v.xy[0]) + std::abs(v.xy[1]) + std::abs(v.zz[0]);
  near_contact_ =
      contact_.near(motion_.position.eigen(), centre_distance_ + 0.01 + 2.0 * dt * speed_bound);
  return {loads_start, loads_half, loads_};
}

// `slope` is that at the start.
[[gnu::always_inline]] inline void RigidBody::endStep(const Motion& start, const Motion& slope,
                                                      const Motion& end) noexcept {
  felt_ = {start.attitude, start.body_rate, slope.velocity, slope.body_rate, Plain3::from(centre_)};
  motion_ = end;
  const Pair scale = unitScale(motion_.attitude);
  motion_.attitude = {scale * motion_.attitude.xy, scale * motion_.attitude.zw};

  touching_ = false;
  if (!(absurdity(motion_, scale[0] - 1.0) < bearable_)) return standStill(start);
  if (near_contact_) judgeContact();
}

template <bool damaged>
[[gnu::always_inline]] inline void RigidBody::stepAny(const RotorArray& command,
                                                      double dt) noexcept {
  const RotorStages rotors = beginStep<damaged>(command, dt);
  const Motion start = motion_;
  const Motion k1 = derivative(start, rotors.start);
  const Motion k2 = derivative(start.after(0.5 * dt, k1), rotors.half);
  const Motion k3 = derivative(start.after(0.5 * dt, k2), rotors.half);
  const Motion k4 = derivative(start.after(dt, k3), rotors.end);
  const Motion middle = k2 + k3;
  endStep(start, k1, start.after(dt / 6.0, k1 + middle + middle + k4));
}

void RigidBody::step(const RotorArray& command, double dt) noexcept {
  if (damaged_) return stepDamaged(command, dt);
  stepAny<false>(command, dt);
}

[[gnu::noinline, gnu::cold]] void RigidBody::stepDamaged(const RotorArray& command,
                                                         double dt) noexcept {
  stepAny<true>(command, dt);
}

// The slopes of vehicle and load, which act on each other.
struct RigidBody::Together {
  Motion vehicle;
  LoadMotion load;

  Together after(double time, const Together& slope) const {
    return {vehicle.after(time, slope.vehicle), load.after(time, slope.load)};
  }
  Together operator+(const Together& other) const {
    return {vehicle + other.vehicle, load + other.load};
  }
};

[[gnu::noinline]] RigidBody::Together RigidBody::slopeWith(
    const HangingLoad& load, const Together& now, const RotorLoads& rotors) const noexcept {
  Together slope;
  slope.vehicle = derivative(now.vehicle, rotors);
  const ForceMoment pull = load.pull(carrierAt(now.vehicle, slope.vehicle), now.load, slope.load);
  slope.vehicle.velocity = slope.vehicle.velocity + inverse_mass_ * Plain3::from(pull.force);
  slope.vehicle.body_rate = slope.vehicle.body_rate + inverse_inertia_ * Plain3::from(pull.moment);
  return slope;
}

void RigidBody::stepWith(HangingLoad& load, const RotorArray& command, double dt) noexcept {
  const RotorStages rotors =
      damaged_ ? beginStep<true>(command, dt) : beginStep<false>(command, dt);
  const Together start = {motion_, load.motion()};
  const Together k1 = slopeWith(load, start, rotors.start);
  const Together k2 = slopeWith(load, start.after(0.5 * dt, k1), rotors.half);
  const Together k3 = slopeWith(load, start.after(0.5 * dt, k2), rotors.half);
  const Together k4 = slopeWith(load, start.after(dt, k3), rotors.end);
  const Together middle = k2 + k3;
  const Together end = start.after(dt / 6.0, k1 + middle + middle + k4);
  endStep(start.vehicle, k1.vehicle, end.vehicle);
  if (crash_ == Crash::kDiverged) return;  // both stay
  if (!load.arrive(end.load)) standStill(start.vehicle);
}

Carrier RigidBody::carrierAt(const Motion& motion, const Motion& slope) const noexcept {
  Carrier carrier;
  carrier.position = motion.position.eigen();
  carrier.velocity = motion.velocity.eigen();
  carrier.attitude = motion.attitude.eigen();
  carrier.rotation = carrier.attitude.toRotationMatrix();
  carrier.body_rate = motion.body_rate.eigen();
  carrier.acceleration = slope.velocity.eigen();
  carrier.angular_acceleration = slope.body_rate.eigen();
  carrier.inverse_mass = inverse_mass_;
  carrier.inverse_inertia << inverse_inertia_.x.eigen(), inverse_inertia_.y.eigen(),
      inverse_inertia_.z.eigen();
  return carrier;
}

[[gnu::noinline]] Carrier RigidBody::carrier() const noexcept {
  return carrierAt(motion_, derivative(motion_, loads_));
}

[[gnu::noinline, gnu::cold]] void RigidBody::judgeContact() noexcept {
  const State state = this->state();
  const Contact::Judgement judgement = contact_.judge(
      state.position, state.attitude.toRotationMatrix(), state.velocity, state.body_rate);
  touching_ = judgement.touching;
  if (crash_ == Crash::kNone) crash_ = judgement.crash;
}

}  // namespace aqc::kernel
