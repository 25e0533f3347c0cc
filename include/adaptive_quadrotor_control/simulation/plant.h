#pragma once

#include <array>
#include <optional>
#include <vector>

#include "adaptive_quadrotor_control/model/state.h"
#include "adaptive_quadrotor_control/model/vehicle.h"
#include "adaptive_quadrotor_control/simulation/contact.h"
#include "adaptive_quadrotor_control/simulation/payload.h"
#include "adaptive_quadrotor_control/simulation/plain_vector.h"

namespace aqc {

/// A multirotor with an optional payload, as RotorS models it: Newton-Euler rigid body integrated
/// by RK4, first-order rotors, rotor drag and rolling moment, wind, ground contact.
///
/// Rotor speeds follow their command with separate time constants up and down (solved exactly for
/// a command held over the step) and stay in [0, omega_max]. The payload is a second rigid body:
/// mass, centre of mass and inertia of the whole change, momentum does not.
///
/// Deterministic and free of clocks; step() allocates nothing.
class Plant {
 public:
  /// Without `ground` nothing holds the vehicle up at z = 0.
  Plant(const Vehicle& vehicle, const State& start, std::vector<Box> walls = {},
        bool ground = true);

  /// Advances by `dt` seconds (> 0, about 1e-3) under commanded rotor speeds [rad/s], held over
  /// the step. A command entry that is not finite counts as 0, others are clamped. After a crash
  /// the rotors run down whatever is commanded.
  void step(const RotorArray& command, double dt) noexcept;

  /// Motion of the body frame B (base_link), not of the centre of mass.
  State state() const noexcept { return stateOf(motion_); }
  const RotorArray& rotorSpeeds() const noexcept { return speeds_; }
  /// What an accelerometer at the origin of B reads [m/s^2], in B, at the start of the last step.
  Eigen::Vector3d specificForce() const noexcept;
  /// Whether the ground z = 0 is there.
  bool hasGround() const noexcept { return contact_.hasGround(); }
  /// The longest step() [s] with which contact stays stable, of the vehicle as it was built.
  double longestStep() const noexcept { return contact_.longestStep(); }
  /// Whether anything touches the ground or a wall.
  bool touching() const noexcept { return touching_; }
  /// The first crash, or Crash::kNone.
  Crash crash() const noexcept { return crash_; }

  /// Fixes a payload, which moved with `velocity` in W [m/s] and did not spin until now, to the
  /// vehicle; total momentum is kept. Throws std::logic_error when one is attached already.
  void attach(const Payload& payload, const Eigen::Vector3d& velocity = Eigen::Vector3d::Zero());
  /// Lets go of the payload; the vehicle's own motion goes on. Throws std::logic_error without one.
  void detach();
  const std::optional<Payload>& payload() const noexcept { return payload_; }
  /// Mass [kg] and inertia (about its centre of mass, in B [kg m^2]) of the vehicle itself become
  /// others at once; its motion goes on. For models that describe a payload by such a change.
  void setBody(double mass, const Eigen::Matrix3d& inertia);
  /// What the vehicle carries beyond its own mass at the start: payload and setBody() [kg].
  double payloadMass() const noexcept;

  /// Velocity of the air in W [m/s].
  void setWind(const Eigen::Vector3d& wind) noexcept { wind_ = Plain3::from(wind); }
  Eigen::Vector3d wind() const noexcept { return wind_.eigen(); }
  /// A force in W [N] and a moment in B [N m] at the centre of mass, held until changed.
  void setDisturbance(const ForceMoment& disturbance) noexcept;
  const ForceMoment& disturbance() const noexcept { return disturbance_; }

  double mass() const noexcept { return mass_; }                            ///< total [kg]
  const Eigen::Vector3d& centreOfMass() const noexcept { return centre_; }  ///< in B [m]
  const Eigen::Matrix3d& inertia() const noexcept { return inertia_; }      ///< about it, in B
  /// Of the whole, in W [kg m/s].
  Eigen::Vector3d linearMomentum() const;
  /// Of the whole about `point` (W), in W [kg m^2/s].
  Eigen::Vector3d angularMomentum(const Eigen::Vector3d& point) const;

 private:
  // A rotor's part in RotorLoads.
  struct Hub {
    Pair arm;      // e_z x r_i, where r_i is from the centre of mass, in B [m]
    Pair tilting;  // roll and pitch moment / omega_i^2
    Pair about_z;  // yaw moment / omega_i^2 and |r_i|^2
  };
  // Everything that does not depend on the motion, at one instant.
  struct RotorLoads {
    Pair sums;     // sum omega_i^2 and sum |omega_i|
    Pair arm;      // sum |omega_i| e_z x r_i
    Pair tilting;  // roll and pitch moment of the thrusts and the disturbance about the centre
    Pair about_z;  // their yaw moment and sum |omega_i| |r_i|^2
  };
  // What RK4 integrates: motion of the centre of mass, or its change with time. The state of B
  // follows from it and is made only when asked for.
  struct Motion {
    Plain3 position;
    Plain3 velocity;
    PlainQuaternion attitude;
    Plain3 body_rate;

    Motion after(double time, const Motion& slope) const;
    Motion operator+(const Motion& other) const;
  };
  // What an accelerometer feels at one instant.
  struct Felt {
    PlainQuaternion attitude;
    Plain3 body_rate;
    Plain3 acceleration;  // of the centre of mass
    Plain3 angular_acceleration;
    Plain3 centre;
  };

  void updateMassProperties();
  State stateOf(const Motion& motion) const noexcept;
  void setState(const State& state) noexcept;
  RotorArray turnRotors(const RotorArray& command, double dt) noexcept;
  RotorLoads rotorLoads(const RotorArray& speeds) const noexcept;
  ForceMoment contactForce(Motion motion) const noexcept;
  Motion derivative(const Motion& motion, const RotorLoads& rotors) const noexcept;
  void judgeContact() noexcept;

  Vehicle vehicle_;
  double empty_mass_;  // of the vehicle at the start
  std::optional<Payload> payload_;
  Contact contact_;
  double mass_;
  double inverse_mass_;
  double lift_per_square_;  // acceleration by thrust / omega_i^2 [m]
  Eigen::Vector3d centre_;
  double centre_distance_;  // from the origin of B [m]
  Eigen::Matrix3d inertia_;
  Eigen::Matrix3d inverse_inertia_;
  Plain33 plain_inertia_;  // the same two, for the step
  Plain33 plain_inverse_inertia_;
  std::array<Hub, kMaxRotors> hubs_;

  Motion motion_;
  // At the start of the last step; before the first one it falls freely.
  Felt felt_ = {{}, {}, {Pair{0.0, 0.0}, both(-kGravity)}, {}, {}};
  RotorArray speeds_;
  RotorLoads loads_;  // of speeds_
  Plain3 wind_ = {};
  ForceMoment disturbance_;
  Plain3 steady_acceleration_;  // gravity's and the disturbance's
  bool near_contact_ = true;
  bool touching_ = false;
  Crash crash_ = Crash::kNone;
  double step_ = 0.0;                         // of the decay factors [s]
  std::array<double, 2> decay_ = {1.0, 1.0};  // exp(-dt / (2 tau)), down and up
};

}  // namespace aqc
