#pragma once

#include <Eigen/Core>

#include "adaptive_quadrotor_control/model/rotor_allocation.h"
#include "adaptive_quadrotor_control/model/state.h"
#include "adaptive_quadrotor_control/model/vehicle.h"
#include "adaptive_quadrotor_control/pilot/innovation.h"

namespace aqc {

/// Where the vehicle must be while no odometry comes: by the IMU (strap-down integration) or,
/// without one, by what the rotors were told and the vehicle's own inertia.
///
/// While odometry comes the IMU smooths it (a complementary filter of fixed gains), and what the
/// two disagree about for seconds is the IMU's bias. Good for seconds, not for minutes: what is
/// left of the bias grows with the square of time, and the model knows no wind. Nothing in it
/// allocates or throws.
class DeadReckoning {
 public:
  explicit DeadReckoning(const Vehicle& vehicle);

  /// What odometry said, one message after the other, and how far that is from state().
  void correct(const State& state, const Innovation& innovation) noexcept;
  /// What it said first, or first again.
  void restart(const State& state) noexcept { state_ = state; }
  /// It stands on the ground.
  void stand() noexcept { state_.velocity.setZero(); }
  /// The IMU's last sample, held until the next one: specific force [m/s^2] and rate [rad/s] in B.
  void feel(const Eigen::Vector3d& specific_force, const Eigen::Vector3d& body_rate) noexcept;
  /// The IMU has fallen silent.
  void feelNothing() noexcept { felt_ = false; }
  bool feels() const noexcept { return felt_; }

  /// `dt` seconds (> 0) pass under what the rotors give, with `mass` [kg] to carry (> 0).
  void advance(const Wrench& given, double mass, double dt) noexcept;

  const State& state() const noexcept { return state_; }
  /// What the accelerometer reads along +z of B [m/s^2]; only while feels().
  double feltLift() const noexcept { return specific_force_.z(); }

 private:
  Eigen::Matrix3d inertia_;
  Eigen::Matrix3d inverse_inertia_;
  State state_;
  Eigen::Vector3d specific_force_ = Eigen::Vector3d::Zero();
  Eigen::Vector3d body_rate_ = Eigen::Vector3d::Zero();
  Eigen::Vector3d force_bias_ = Eigen::Vector3d::Zero();  // in what is felt [m/s^2]
  Eigen::Vector3d rate_bias_ = Eigen::Vector3d::Zero();   // [rad/s]
  bool felt_ = false;
};

}  // namespace aqc
