#pragma once

#include "simulation/hanging_load.h"

namespace aqc::kernel {

/// A point mass on a massless cable that does not stretch: see aqc::Cable. While the cable is taut,
/// the tension is what keeps its length, solved exactly at every stage of a step (for a hook in the
/// centre of mass these are the equations of K. Sreenath, T. Lee and V. Kumar, "Geometric control
/// and differential flatness of a quadrotor UAV with a cable-suspended load", CDC 2013); where that
/// would push, the cable is slack and both move freely. When a slack cable becomes taut, within a
/// step too, an impulse along it takes away the speed that would stretch it; momentum stays.
class CableLoad final : public HangingLoad {
 public:
  /// The load is at `motion`; its distance from the hook must be <= the cable's length.
  CableLoad(const Payload& payload, const Cable& cable, const FreeMotion& motion,
            const RigidBody& vehicle);

  void advance(RigidBody& vehicle, const RotorArray& command, double dt) noexcept override;
  ForceMoment pull(const Carrier& vehicle, const LoadMotion& load,
                   LoadMotion& slope) const noexcept override;
  double storedEnergy(const Carrier&) const noexcept override { return 0.0; }
  Eigen::Vector3d spin() const noexcept override { return Eigen::Vector3d::Zero(); }
  double spinEnergy() const noexcept override { return 0.0; }

 private:
  // The cable as a straight line from hook to load.
  struct Line {
    Eigen::Vector3d along;  // unit vector, in W
    Eigen::Vector3d lever;  // moment about the vehicle's centre of mass of a unit pull, in B
    double length = 0.0;    // [m]
    double rate = 0.0;      // of the length [m/s]
    double turning = 0.0;   // what the length's second derivative has of the line's rotation
    double mobility = 0.0;  // how much a unit pull shortens it, second derivative [1/kg]
  };

  Line lineAt(const Carrier& vehicle, const LoadMotion& load) const noexcept;
  // Second derivative of the length without a pull [m/s^2].
  double parting(const Line& line, const Carrier& vehicle,
                 const Eigen::Vector3d& load_acceleration) const noexcept;
  double parting(const Line& line, const Carrier& vehicle) const noexcept;
  void strike(RigidBody& vehicle, const Line& line) noexcept;
  double judgeTension(RigidBody& vehicle) noexcept;
  void part(RigidBody& vehicle, const RotorArray& command, double dt) noexcept;
  void keepLength(RigidBody& vehicle) noexcept;

  Eigen::Vector3d hook_;  // from the vehicle's centre of mass, in B [m]
  double length_;
  bool taut_ = false;  // in the step that is being made
};

}  // namespace aqc::kernel
