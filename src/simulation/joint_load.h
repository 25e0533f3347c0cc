#pragma once

#include "simulation/hanging_load.h"

namespace aqc::kernel {

/// A rigid body held by springs and dampers along and about all axes: see aqc::Joint. The springs'
/// energy is 1/2 q' K q, where q holds the translation of the load's centre of mass from its place
/// in B and twice the vector part of the quaternion of its rotation against B; forces and moments
/// are its gradient, so that energy and both momenta are kept but for what the dampers take.
class JointLoad final : public HangingLoad {
 public:
  /// In its place under the vehicle, parallel to it, with a velocity in W and without a spin.
  JointLoad(const Payload& payload, const Joint& joint, const Eigen::Vector3d& velocity,
            const RigidBody& vehicle);

  void advance(RigidBody& vehicle, const RotorArray& command, double dt) noexcept override;
  ForceMoment pull(const Carrier& vehicle, const LoadMotion& load,
                   LoadMotion& slope) const noexcept override;
  double storedEnergy(const Carrier& vehicle) const noexcept override;
  Eigen::Vector3d spin() const noexcept override;
  double spinEnergy() const noexcept override;

 private:
  using Vector6 = Eigen::Matrix<double, 6, 1>;
  using Matrix6 = Eigen::Matrix<double, 6, 6>;
  // The load against its place under the vehicle, in B.
  struct Relative {
    Eigen::Vector3d arm;      // from the vehicle's centre of mass to the load's
    Eigen::Quaterniond turn;  // of the load's axes against B, w >= 0
    Vector6 displacement;     // q
  };

  Relative relativeTo(const Carrier& vehicle, const LoadMotion& load) const noexcept;

  Eigen::Vector3d place_;    // of its centre of mass, in B [m]
  Eigen::Matrix3d inertia_;  // about its centre of mass, in its own axes [kg m^2]
  Eigen::Matrix3d inverse_inertia_;
  double angular_frequency_;  // [rad/s]
  Matrix6 stiffness_;         // K
  Matrix6 damping_;
};

}  // namespace aqc::kernel
