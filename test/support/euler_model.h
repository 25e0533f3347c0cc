#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cmath>

#include "adaptive_quadrotor_control/model/state.h"

namespace aqc::test {

/// Rows of the matrix that turns Z-Y-X Euler rates into body rates, omega = W dq.
inline Eigen::Matrix3d eulerToBody(double roll, double pitch) {
  Eigen::Matrix3d W;
  W << 1.0, 0.0, -std::sin(pitch),                            //
      0.0, std::cos(roll), std::sin(roll) * std::cos(pitch),  //
      0.0, -std::sin(roll), std::cos(roll) * std::cos(pitch);
  return W;
}

/// Mass and moments of inertia of thesis chapter 3.
struct EulerBody {
  double mass;              // m [kg]
  Eigen::Vector3d inertia;  // I_xx, I_yy, I_zz [kg m^2]
  double arm_length;        // l [m]

  /// Diagonal of the attitude rows of M.
  Eigen::Vector3d effectiveInertia() const {
    return {inertia.x() / arm_length, inertia.y() / arm_length, inertia.z()};
  }
};

/// The Euler-angle model of thesis chapter 3 (eq. sys_1) with its lateral motion (eq. pos_dyn_mod).
struct EulerMotion {
  Eigen::Vector4d q = Eigen::Vector4d::Zero();  // z, phi, theta, psi
  Eigen::Vector4d rate = Eigen::Vector4d::Zero();
  Eigen::Vector2d lateral = Eigen::Vector2d::Zero();  // q_u = x, y
  Eigen::Vector2d lateral_rate = Eigen::Vector2d::Zero();
};

struct EulerAcceleration {
  Eigen::Vector4d q = Eigen::Vector4d::Zero();
  Eigen::Vector2d lateral = Eigen::Vector2d::Zero();

  double norm() const { return std::sqrt(q.squaredNorm() + lateral.squaredNorm()); }
};

/// C dq, attitude rows.
inline Eigen::Vector3d coriolis(const EulerBody& body, const Eigen::Vector4d& rate) {
  const Eigen::Vector3d& I = body.inertia;
  return {(I.z() - I.y()) / body.arm_length * rate[2] * rate[3],
          (I.x() - I.z()) / body.arm_length * rate[1] * rate[3],
          (I.y() - I.x()) * rate[2] * rate[1]};
}

/// Direction of the thrust in W.
inline Eigen::Vector3d thrustAxis(const Eigen::Vector4d& q) {
  return {std::cos(q[3]) * std::sin(q[2]) * std::cos(q[1]) + std::sin(q[3]) * std::sin(q[1]),
          std::sin(q[3]) * std::sin(q[2]) * std::cos(q[1]) - std::cos(q[3]) * std::sin(q[1]),
          std::cos(q[2]) * std::cos(q[1])};
}

/// Both second derivatives under the input tau and the disturbance d (which acts along the thrust
/// in the first row). Rows one of sys_1 and pos_dyn_mod together say that the mass feels gravity
/// and T - d_1 along the body's axis.
inline EulerAcceleration accelerate(const EulerBody& body, const EulerMotion& motion,
                                    const Eigen::Vector4d& tau, const Eigen::Vector4d& d) {
  const Eigen::Vector3d linear =
      thrustAxis(motion.q) * ((tau[0] - d[0]) / body.mass) - kGravity * Eigen::Vector3d::UnitZ();
  const Eigen::Vector3d turn = (tau.tail<3>() - d.tail<3>() - coriolis(body, motion.rate))
                                   .cwiseQuotient(body.effectiveInertia());
  return {{linear.z(), turn.x(), turn.y(), turn.z()}, linear.head<2>()};
}

/// RK4 over `dt` seconds with tau and d held.
inline EulerMotion advance(const EulerBody& body, const EulerMotion& start,
                           const Eigen::Vector4d& tau, const Eigen::Vector4d& d, double dt) {
  const auto moved = [&start](const EulerMotion& slope, double h) {
    return EulerMotion{start.q + h * slope.q, start.rate + h * slope.rate,
                       start.lateral + h * slope.lateral,
                       start.lateral_rate + h * slope.lateral_rate};
  };
  const auto slope = [&](const EulerMotion& at) {
    const EulerAcceleration a = accelerate(body, at, tau, d);
    return EulerMotion{at.rate, a.q, at.lateral_rate, a.lateral};
  };
  const EulerMotion k1 = slope(start);
  const EulerMotion k2 = slope(moved(k1, 0.5 * dt));
  const EulerMotion k3 = slope(moved(k2, 0.5 * dt));
  const EulerMotion k4 = slope(moved(k3, dt));
  EulerMotion mean;
  mean.q = (k1.q + 2.0 * k2.q + 2.0 * k3.q + k4.q) / 6.0;
  mean.rate = (k1.rate + 2.0 * k2.rate + 2.0 * k3.rate + k4.rate) / 6.0;
  mean.lateral = (k1.lateral + 2.0 * k2.lateral + 2.0 * k3.lateral + k4.lateral) / 6.0;
  mean.lateral_rate =
      (k1.lateral_rate + 2.0 * k2.lateral_rate + 2.0 * k3.lateral_rate + k4.lateral_rate) / 6.0;
  return moved(mean, dt);
}

/// The same motion as controllers see it.
inline State toState(const EulerMotion& motion) {
  State state;
  state.position << motion.lateral, motion.q[0];
  state.velocity << motion.lateral_rate, motion.rate[0];
  state.attitude = Eigen::AngleAxisd(motion.q[3], Eigen::Vector3d::UnitZ()) *
                   Eigen::AngleAxisd(motion.q[2], Eigen::Vector3d::UnitY()) *
                   Eigen::AngleAxisd(motion.q[1], Eigen::Vector3d::UnitX());
  state.body_rate = eulerToBody(motion.q[1], motion.q[2]) * motion.rate.tail<3>();
  return state;
}

/// What an accelerometer reads, in B.
inline Eigen::Vector3d specificForce(const State& state, const EulerAcceleration& acceleration) {
  const Eigen::Vector3d linear(acceleration.lateral.x(), acceleration.lateral.y(),
                               acceleration.q[0] + kGravity);
  return state.attitude.conjugate() * linear;
}

/// Thesis chapter 3: tau_phi and tau_theta are moment / arm length.
inline Eigen::Vector4d toInput(const Wrench& wrench, double arm_length) {
  return {wrench.thrust, wrench.moment.x() / arm_length, wrench.moment.y() / arm_length,
          wrench.moment.z()};
}

}  // namespace aqc::test
