#pragma once

#include "adaptive_quadrotor_control/simulation/plant.h"
#include "simulation/load_contact.h"
#include "simulation/rigid_body.h"

namespace aqc::kernel {

/// How a load moves, or its change with time.
struct LoadMotion {
  Eigen::Vector3d position = Eigen::Vector3d::Zero();   ///< of its centre of mass, in W [m]
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero();   ///< in W [m/s]
  Eigen::Vector4d attitude = Eigen::Vector4d::Zero();   ///< quaternion, x y z w
  Eigen::Vector3d body_rate = Eigen::Vector3d::Zero();  ///< in its own axes [rad/s]

  LoadMotion after(double time, const LoadMotion& slope) const {
    return {position + time * slope.position, velocity + time * slope.velocity,
            attitude + time * slope.attitude, body_rate + time * slope.body_rate};
  }
  LoadMotion operator+(const LoadMotion& other) const {
    return {position + other.position, velocity + other.velocity, attitude + other.attitude,
            body_rate + other.body_rate};
  }
};

/// A payload that moves on its own under a vehicle, and what holds it.
class HangingLoad {
 public:
  virtual ~HangingLoad() = default;

  /// One step of both, `dt` [s], in as many parts as the load needs. As Plant::step().
  virtual void advance(RigidBody& vehicle, const RotorArray& command, double dt) noexcept = 0;

  /// At one stage of a step: how the load moves on, and what it does to the vehicle: a force in W
  /// [N] and a moment about the vehicle's centre of mass, in B [N m].
  virtual ForceMoment pull(const Carrier& vehicle, const LoadMotion& load,
                           LoadMotion& slope) const noexcept = 0;
  /// Energy that what holds it has stored [J].
  virtual double storedEnergy(const Carrier& vehicle) const noexcept = 0;
  /// Angular momentum about its centre of mass, in W [kg m^2/s].
  virtual Eigen::Vector3d spin() const noexcept = 0;
  /// Energy of its rotation [J].
  virtual double spinEnergy() const noexcept = 0;

  const LoadMotion& motion() const noexcept { return motion_; }
  FreeMotion freeMotion() const noexcept { return {motion_.position, motion_.velocity}; }
  /// The load is there now; false, and it stays where it was, for a motion that is absurd.
  bool arrive(const LoadMotion& motion) noexcept;
  bool touching() const noexcept { return touching_; }

 protected:
  HangingLoad(const Payload& payload, LoadContact contact, const LoadMotion& motion)
      : mass_(payload.mass), contact_(std::move(contact)), motion_(motion) {}

  // Its integration steps are no longer, so that it can stand on the ground [s].
  static constexpr double kLongestPart = 5e-3;

  // Looks whether it touches anything.
  void judge(RigidBody& vehicle) noexcept;
  // Weight and contact alone; the moment is in the load's own axes.
  LoadMotion fall(const LoadMotion& load, Eigen::Vector3d& moment) const noexcept;

  double mass_;
  LoadContact contact_;
  LoadMotion motion_;

 private:
  bool touching_ = false;
};

}  // namespace aqc::kernel
