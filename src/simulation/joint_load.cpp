#include "simulation/joint_load.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

namespace aqc::kernel {
namespace {

// RK4 takes (a h)^6 / 72 of an oscillation's energy each step: at this angle, once in 3e5 of them.
constexpr double kAngleOfAPart = 0.25;  // [rad]

LoadMotion inPlace(const Payload& payload, const Eigen::Vector3d& velocity, const State& vehicle) {
  LoadMotion load;
  load.position = vehicle.position + vehicle.attitude * payload.offset;
  load.velocity = velocity;
  load.attitude = vehicle.attitude.coeffs();
  return load;
}

Eigen::Matrix3d crossMatrix(const Eigen::Vector3d& v) {
  Eigen::Matrix3d matrix;
  matrix << 0.0, -v.z(), v.y(), v.z(), 0.0, -v.x(), -v.y(), v.x(), 0.0;
  return matrix;
}

// How force and moment at a point `arm` from the centre of mass of a body accelerate it there.
Eigen::Matrix<double, 6, 6> mobility(double inverse_mass, const Eigen::Matrix3d& inverse_inertia,
                                     const Eigen::Vector3d& arm) {
  const Eigen::Matrix3d cross = crossMatrix(arm);
  Eigen::Matrix<double, 6, 6> matrix;
  matrix << inverse_mass * Eigen::Matrix3d::Identity() - cross * inverse_inertia * cross,
      -cross * inverse_inertia, inverse_inertia * cross, inverse_inertia;
  return matrix;
}

// The change of a unit quaternion (x y z w) that turns with `rate` in its own axes.
Eigen::Vector4d quaternionRate(const Eigen::Vector4d& q, const Eigen::Vector3d& rate) {
  Eigen::Vector4d slope;
  slope << q.w() * rate + q.head<3>().cross(rate), -q.head<3>().dot(rate);
  return 0.5 * slope;
}

}  // namespace

JointLoad::JointLoad(const Payload& payload, const Joint& joint, const Eigen::Vector3d& velocity,
                     const RigidBody& vehicle)
    : HangingLoad(payload,
                  LoadContact(payload, false, Contact::kCrashSpeed, vehicle.walls(),
                              vehicle.contact().hasGround()),
                  inPlace(payload, velocity, vehicle.state())),
      place_(payload.offset),
      inertia_(payload.inertia),
      inverse_inertia_(payload.inertia.inverse()),
      angular_frequency_(2.0 * M_PI * joint.frequency) {
  const Carrier carrier = vehicle.carrier();
  const Matrix6 together = mobility(carrier.inverse_mass, carrier.inverse_inertia, place_) +
                           mobility(1.0 / mass_, inverse_inertia_, Eigen::Vector3d::Zero());
  const Matrix6 reduced = together.inverse();
  stiffness_ = angular_frequency_ * angular_frequency_ * reduced;
  damping_ = 2.0 * joint.damping * angular_frequency_ * reduced;
}

void JointLoad::advance(RigidBody& vehicle, const RotorArray& command, double dt) noexcept {
  const double longest = std::min(kAngleOfAPart / angular_frequency_, kLongestPart);
  const double parts = std::max(1.0, std::ceil(dt / longest));
  for (int i = 0; i < static_cast<int>(parts); ++i) vehicle.stepWith(*this, command, dt / parts);
  judge(vehicle);
}

JointLoad::Relative JointLoad::relativeTo(const Carrier& vehicle,
                                          const LoadMotion& load) const noexcept {
  Relative relative;
  relative.arm = vehicle.rotation.transpose() * (load.position - vehicle.position);
  relative.turn = vehicle.attitude.conjugate() * Eigen::Quaterniond(load.attitude);
  if (relative.turn.w() < 0.0) relative.turn.coeffs() *= -1.0;
  relative.displacement << relative.arm - place_, 2.0 * relative.turn.vec();
  return relative;
}

ForceMoment JointLoad::pull(const Carrier& vehicle, const LoadMotion& load,
                            LoadMotion& slope) const noexcept {
  Eigen::Vector3d moment;
  slope = fall(load, moment);
  const Relative relative = relativeTo(vehicle, load);
  const Eigen::Matrix3d rotation = Eigen::Quaterniond(load.attitude).toRotationMatrix();
  const Eigen::Matrix3d turn = vehicle.rotation.transpose() * rotation;
  Vector6 rate;
  rate << vehicle.rotation.transpose() * (load.velocity - vehicle.velocity) -
              vehicle.body_rate.cross(relative.arm),
      turn * load.body_rate - vehicle.body_rate;

  // Of the load, in B. A rotation by dtheta changes twice the vector part by w dtheta + dtheta x v.
  const Vector6 spring = stiffness_ * relative.displacement;
  const Vector6 damper = damping_ * rate;
  const Eigen::Vector3d force = -spring.head<3>() - damper.head<3>();
  const Eigen::Vector3d twist = spring.tail<3>();
  const Eigen::Vector3d held =
      -relative.turn.w() * twist - relative.turn.vec().cross(twist) - damper.tail<3>();

  slope.velocity += vehicle.rotation * force / mass_;
  slope.attitude = quaternionRate(load.attitude, load.body_rate);
  moment += turn.transpose() * held - load.body_rate.cross(inertia_ * load.body_rate);
  slope.body_rate = inverse_inertia_ * moment;
  return {-(vehicle.rotation * force), -relative.arm.cross(force) - held};
}

double JointLoad::storedEnergy(const Carrier& vehicle) const noexcept {
  const Vector6 displacement = relativeTo(vehicle, motion_).displacement;
  return 0.5 * displacement.dot(stiffness_ * displacement);
}

Eigen::Vector3d JointLoad::spin() const noexcept {
  return Eigen::Quaterniond(motion_.attitude) * (inertia_ * motion_.body_rate);
}

double JointLoad::spinEnergy() const noexcept {
  return 0.5 * motion_.body_rate.dot(inertia_ * motion_.body_rate);
}

}  // namespace aqc::kernel
