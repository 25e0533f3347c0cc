#pragma once

#include <memory>
#include <vector>

#include "adaptive_quadrotor_control/simulation/rigid_plant.h"

namespace aqc {

namespace kernel {
class HangingLoad;
}

/// A RigidPlant whose payload may also hang on a joint or on a cable. As long as it does not, this
/// is the RigidPlant to the last bit. Such a payload is a body of its own: it is integrated with
/// the vehicle by the same steps of RK4, of which a stiff joint needs several in a step(); it feels
/// its weight and what it touches, but no air; disturbances act on the vehicle alone.
///
/// After a crash, and when either motion diverges, the same happens as with a rigid payload. A
/// payload on a cable may meet the ground at any speed; one on a joint is as delicate as a rigid
/// one. Walls are a crash for all. step() allocates nothing.
class FlexiblePlant final : public Plant {
 public:
  /// Without `ground` nothing holds the vehicle up at z = 0.
  FlexiblePlant(const Vehicle& vehicle, const State& start, std::vector<Box> walls = {},
                bool ground = true);
  ~FlexiblePlant() override;

  void step(const RotorArray& command, double dt) noexcept override;
  double longestStep() const noexcept override { return vehicle_.longestStep(); }

  State state() const noexcept override { return vehicle_.state(); }
  const RotorArray& rotorSpeeds() const noexcept override { return vehicle_.rotorSpeeds(); }
  /// At the start of the last step of RK4, which may be a part of step(). The impulse of a cable
  /// that jerks tight is not felt.
  Eigen::Vector3d specificForce() const noexcept override { return vehicle_.specificForce(); }
  bool hasGround() const noexcept override { return vehicle_.hasGround(); }
  bool touching() const noexcept override;
  Crash crash() const noexcept override { return vehicle_.crash(); }

  /// On a cable it appears straight below the hook, or on the ground if that is nearer. On a joint
  /// it appears in its place; nothing jerks, the joint takes up its velocity.
  void attach(const Payload& payload,
              const Eigen::Vector3d& velocity = Eigen::Vector3d::Zero()) override;
  /// On a cable it stays where it is, within the cable's length of the hook.
  void pickUp(const Payload& payload, const FreeMotion& motion) override;
  FreeMotion detach() override;
  const std::optional<Payload>& payload() const noexcept override;
  FreeMotion payloadMotion() const noexcept override;
  void setBody(double mass, const Eigen::Matrix3d& inertia) override {
    vehicle_.setBody(mass, inertia);
  }
  double payloadMass() const noexcept override;

  void setWind(const Eigen::Vector3d& velocity) noexcept override { vehicle_.setWind(velocity); }
  void setDisturbance(const ForceMoment& disturbance) noexcept override {
    vehicle_.setDisturbance(disturbance);
  }
  void setRotor(std::size_t index, const RotorCondition& condition) noexcept override {
    vehicle_.setRotor(index, condition);
  }
  void setSpeedLimit(double share) noexcept override { vehicle_.setSpeedLimit(share); }

  /// Of vehicle and payload, in W [kg m/s].
  Eigen::Vector3d linearMomentum() const;
  /// Of both about `point` (W), in W [kg m^2/s].
  Eigen::Vector3d angularMomentum(const Eigen::Vector3d& point) const;
  /// Kinetic energy of both, their energy of height, and what a joint's springs hold [J].
  double energy() const;

 private:
  void requireNone() const;
  FreeMotion below(const Payload& payload, const Eigen::Vector3d& velocity) const;
  void hang(const Payload& payload, const FreeMotion& motion);

  RigidPlant vehicle_;                         // with a rigid payload, if that is what it has
  std::unique_ptr<kernel::HangingLoad> load_;  // or with this one
  std::optional<Payload> hanging_;             // which is that
};

}  // namespace aqc
