#pragma once

#include <memory>
#include <vector>

#include "adaptive_quadrotor_control/simulation/box.h"
#include "adaptive_quadrotor_control/simulation/plant.h"

namespace aqc {

namespace kernel {
class RigidBody;
}

/// A multirotor with an optional rigid payload, as RotorS models it: Newton-Euler rigid body
/// integrated by RK4, first-order rotors, rotor drag and rolling moment, wind, ground contact.
///
/// Rotor speeds follow their command with separate time constants up and down (solved exactly for
/// a command held over the step) and stay in [0, omega_max]; see also setSpeedLimit(). The payload
/// is a second rigid body that is fixed to the first: mass, centre of mass and inertia of the whole
/// change, momentum does not. step() allocates nothing.
///
/// A motion beyond 1e4 m/s, 1e4 rad/s or 1e6 m, one that is not finite, and a spin that a step of
/// RK4 cannot follow have diverged: the vehicle stands still from then on where it was last within
/// these bounds, with Crash::kDiverged unless it had crashed before.
class RigidPlant final : public Plant {
 public:
  /// Without `ground` nothing holds the vehicle up at z = 0.
  RigidPlant(const Vehicle& vehicle, const State& start, std::vector<Box> walls = {},
             bool ground = true);
  RigidPlant(const RigidPlant& other);
  RigidPlant& operator=(const RigidPlant& other);
  RigidPlant(RigidPlant&& other) noexcept;
  RigidPlant& operator=(RigidPlant&& other) noexcept;
  ~RigidPlant() override;

  void step(const RotorArray& command, double dt) noexcept override;
  double longestStep() const noexcept override;

  State state() const noexcept override;
  const RotorArray& rotorSpeeds() const noexcept override;
  Eigen::Vector3d specificForce() const noexcept override;
  bool hasGround() const noexcept override;
  bool touching() const noexcept override;
  Crash crash() const noexcept override;

  void attach(const Payload& payload,
              const Eigen::Vector3d& velocity = Eigen::Vector3d::Zero()) override;
  FreeMotion detach() override;
  const std::optional<Payload>& payload() const noexcept override { return payload_; }
  FreeMotion payloadMotion() const noexcept override;
  void setBody(double mass, const Eigen::Matrix3d& inertia) override;
  double payloadMass() const noexcept override;

  void setWind(const Eigen::Vector3d& velocity) noexcept override;
  void setDisturbance(const ForceMoment& disturbance) noexcept override;
  void setRotor(std::size_t index, const RotorCondition& condition) noexcept override;
  void setSpeedLimit(double share) noexcept override;

  double mass() const noexcept { return whole_.mass; }  ///< total [kg]
  /// In B [m].
  const Eigen::Vector3d& centreOfMass() const noexcept { return whole_.centre; }
  /// About the centre of mass, in B [kg m^2].
  const Eigen::Matrix3d& inertia() const noexcept { return whole_.inertia; }
  /// Of the whole, in W [kg m/s].
  Eigen::Vector3d linearMomentum() const;
  /// Of the whole about `point` (W), in W [kg m^2/s].
  Eigen::Vector3d angularMomentum(const Eigen::Vector3d& point) const;

 private:
  friend class FlexiblePlant;  // lets other bodies act on this one within a step

  // Mass [kg], centre of mass in B [m] and inertia about it, in B [kg m^2].
  struct Solid {
    double mass = 0.0;
    Eigen::Vector3d centre = Eigen::Vector3d::Zero();
    Eigen::Matrix3d inertia = Eigen::Matrix3d::Zero();
  };

  void updateWhole();

  double empty_mass_;  // of the vehicle at the start [kg]
  Solid vehicle_;
  std::optional<Payload> payload_;
  Solid whole_;                              // vehicle and payload
  std::unique_ptr<kernel::RigidBody> body_;  // what a step reads and writes
};

}  // namespace aqc
