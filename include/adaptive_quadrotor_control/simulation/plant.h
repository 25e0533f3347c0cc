#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <limits>
#include <optional>

#include "adaptive_quadrotor_control/model/force_moment.h"
#include "adaptive_quadrotor_control/model/state.h"
#include "adaptive_quadrotor_control/model/vehicle.h"
#include "adaptive_quadrotor_control/simulation/crash.h"
#include "adaptive_quadrotor_control/simulation/payload.h"
#include "adaptive_quadrotor_control/simulation/rotor_condition.h"

namespace aqc {

/// How a payload moves, were nothing holding it.
struct FreeMotion {
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  ///< of its centre of mass, in W [m]
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero();  ///< of its centre of mass, in W [m/s]
};

/// A simulated multirotor in its surroundings: rotors, body, what hangs under it, air and contact.
/// Whoever simulates it otherwise (another engine, say) writes a class like this one and one line
/// in makePlant(); clock, events and payloads that lie about are TimedPlant's.
///
/// Deterministic and free of clocks: the same calls give the same bits.
class Plant {
 public:
  virtual ~Plant() = default;

  /// Advances by `dt` seconds (> 0, at most longestStep()) under commanded rotor speeds [rad/s],
  /// held over the step. A command entry that is missing or not finite counts as 0, others are
  /// clamped to what the rotors can do. After a crash the rotors run down whatever is commanded,
  /// stuck or not.
  virtual void step(const RotorArray& command, double dt) noexcept = 0;
  /// The longest step() [s] that is stable, of the vehicle as it was built.
  virtual double longestStep() const noexcept { return std::numeric_limits<double>::infinity(); }

  /// Motion of the body frame B (base_link), not of the centre of mass.
  virtual State state() const noexcept = 0;
  /// omega_i [rad/s], as many as the vehicle has rotors.
  virtual const RotorArray& rotorSpeeds() const noexcept = 0;
  /// What an accelerometer at the origin of B reads [m/s^2], in B, at the start of the last step.
  virtual Eigen::Vector3d specificForce() const noexcept = 0;
  /// Whether the ground z = 0 is there.
  virtual bool hasGround() const noexcept = 0;
  /// Whether anything touches the ground or a wall.
  virtual bool touching() const noexcept = 0;
  /// The first crash, or Crash::kNone. A plant whose motion diverges, under a force that is absurd
  /// for its mass, say, has crashed, too: its state stays finite whatever acts on it.
  virtual Crash crash() const noexcept = 0;

  /// Joins a payload, which moved with `velocity` in W [m/s] and did not spin until now, to the
  /// vehicle; total momentum is kept. Throws std::logic_error when one is attached already.
  /// Throws std::invalid_argument for a mount that the plant does not simulate.
  virtual void attach(const Payload& payload, const Eigen::Vector3d& velocity) = 0;
  /// The same for a payload that is there already and moves like that: it jumps to where it hangs,
  /// unless a cable reaches it.
  virtual void pickUp(const Payload& payload, const FreeMotion& motion) {
    attach(payload, motion.velocity);
  }
  /// Lets go of the payload; the vehicle's own motion goes on. Throws std::logic_error without one.
  virtual FreeMotion detach() = 0;
  /// What is attached.
  virtual const std::optional<Payload>& payload() const noexcept = 0;
  /// How it moves; without a payload as the origin of B.
  virtual FreeMotion payloadMotion() const noexcept = 0;
  /// Mass [kg] and inertia (about its centre of mass, in B [kg m^2]) of the vehicle itself become
  /// others at once; its motion goes on. For models that describe a payload by such a change.
  virtual void setBody(double mass, const Eigen::Matrix3d& inertia) = 0;
  /// What the vehicle carries beyond its own mass at the start: payload and setBody() [kg].
  virtual double payloadMass() const noexcept = 0;

  /// Velocity of the air in W [m/s], held until changed; at first 0.
  virtual void setWind(const Eigen::Vector3d& velocity) noexcept = 0;
  /// A force in W [N] and a moment in B [N m] at the centre of mass, held until changed.
  virtual void setDisturbance(const ForceMoment& disturbance) noexcept = 0;
  /// What is wrong with rotor `index` of the vehicle, counted from 0, instead of what was before.
  virtual void setRotor(std::size_t index, const RotorCondition& condition) noexcept = 0;
  /// The greatest speed that rotors can reach, as a share of the vehicle's, in (0, 1], held until
  /// changed; at first 1. Those that turn faster slow down as if that were commanded.
  virtual void setSpeedLimit(double share) noexcept = 0;

 protected:
  Plant() = default;
  Plant(const Plant&) = default;
  Plant& operator=(const Plant&) = default;
};

}  // namespace aqc
