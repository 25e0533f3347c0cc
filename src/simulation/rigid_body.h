#pragma once

#include <array>
#include <vector>

#include "adaptive_quadrotor_control/model/force_moment.h"
#include "adaptive_quadrotor_control/model/state.h"
#include "adaptive_quadrotor_control/model/vehicle.h"
#include "adaptive_quadrotor_control/simulation/crash.h"
#include "adaptive_quadrotor_control/simulation/rotor_condition.h"
#include "simulation/contact.h"
#include "simulation/plain_vector.h"

namespace aqc::kernel {

/// What RK4 integrates: motion of the centre of mass, or its change with time. The state of B
/// follows from it and is made only when asked for.
struct Motion {
  Plain3 position;
  Plain3 velocity;
  PlainQuaternion attitude;
  Plain3 body_rate;

  Motion after(double time, const Motion& slope) const;
  Motion operator+(const Motion& other) const;
};

// What a simulation can go on from.
constexpr double kMostSpeed = 1e4;     // [m/s], [rad/s]
constexpr double kMostDistance = 1e6;  // [m]
// RK4's at 2.4 rad a step. Made nearly unit, what has less is unit within 1e-3: a valid State.
constexpr double kMostNormError = 0.02;

/// Below 1 for a motion that a simulation can go on from: the squares of velocity, body rate,
/// distance and of half the error of the attitude's squared norm, each over its bound. The last one
/// says whether a step can follow the spin.
inline double absurdity(const Motion& motion, double half_norm_error) {
  constexpr double kPerSpeed = 1.0 / (kMostSpeed * kMostSpeed);
  constexpr double kPerDistance = 1.0 / (kMostDistance * kMostDistance);
  constexpr double kPerNormError = 1.0 / (kMostNormError * kMostNormError);
  const Plain3& v = motion.velocity;
  const Plain3& w = motion.body_rate;
  const Plain3& p = motion.position;
  const Pair across = kPerSpeed * (v.xy * v.xy + w.xy * w.xy) + kPerDistance * (p.xy * p.xy);
  const Pair along = kPerSpeed * (v.zz * v.zz + w.zz * w.zz) + kPerDistance * (p.zz * p.zz);
  return across[0] + across[1] + along[0] + kPerNormError * half_norm_error * half_norm_error;
}

class HangingLoad;

/// The vehicle at one instant, as it would move if nothing hung under it: what hangs there needs
/// it.
struct Carrier {
  Eigen::Vector3d position;  ///< of the centre of mass, in W [m]
  Eigen::Vector3d velocity;  ///< of the centre of mass, in W [m/s]
  Eigen::Quaterniond attitude;
  Eigen::Matrix3d rotation;              ///< R, of unit norm to rounding and RK4's order
  Eigen::Vector3d body_rate;             ///< [rad/s]
  Eigen::Vector3d acceleration;          ///< of the centre of mass, in W [m/s^2]
  Eigen::Vector3d angular_acceleration;  ///< in B [rad/s^2]
  double inverse_mass = 0.0;             ///< [1/kg]
  Eigen::Matrix3d inverse_inertia;       ///< about the centre of mass, in B [1/(kg m^2)]
};

/// All that a step of RigidPlant reads and writes: rotors, motion of the whole, contact.
class RigidBody {
 public:
  RigidBody(const Vehicle& vehicle, std::vector<Box> walls, bool ground);

  /// As Plant::step().
  void step(const RotorArray& command, double dt) noexcept;
  /// The same with a load that hangs under the vehicle, which moves on with it.
  void stepWith(HangingLoad& load, const RotorArray& command, double dt) noexcept;

  /// Mass, centre of mass in B and inertia about it of the whole, of which `payload` (may be null)
  /// is a part; leaves the motion of the centre of mass as it is. To be called before all others.
  void setMass(double mass, const Eigen::Vector3d& centre, const Eigen::Matrix3d& inertia,
               const Payload* payload);
  /// A state that is not finite or absurd makes it stand still where it was.
  void setState(const State& state) noexcept;
  void setWind(const Eigen::Vector3d& velocity) noexcept { wind_ = Plain3::from(velocity); }
  void setDisturbance(const ForceMoment& disturbance) noexcept;
  /// As Plant::setRotor().
  void setRotor(std::size_t index, const RotorCondition& condition) noexcept;
  /// As Plant::setSpeedLimit().
  void setSpeedLimit(double share) noexcept { speed_limit_ = share * vehicle_.max_rotor_speed; }

  /// Strikes the vehicle: an impulse in W [N s] at the centre of mass and one of moment in B [N m
  /// s].
  void strike(const ForceMoment& impulse) noexcept;
  /// Something has happened after which the rotors run down.
  void declare(Crash crash) noexcept {
    if (crash_ == Crash::kNone) crash_ = crash;
  }

  /// As of now.
  Carrier carrier() const noexcept;
  const std::vector<Box>& walls() const noexcept { return contact_.walls(); }
  State state() const noexcept { return stateOf(motion_); }
  const Motion& motion() const noexcept { return motion_; }
  const RotorArray& rotorSpeeds() const noexcept { return speeds_; }
  Eigen::Vector3d specificForce() const noexcept;
  const Contact& contact() const noexcept { return contact_; }
  bool touching() const noexcept { return touching_; }
  Crash crash() const noexcept { return crash_; }

 private:
  // A rotor's part in RotorLoads; thrust and drag moment with its effectiveness.
  struct Hub {
    Pair arm;      // e_z x r_i, where r_i is from the centre of mass, in B [m]
    Pair tilting;  // roll and pitch moment / omega_i^2
    Pair about_z;  // yaw moment / omega_i^2 and |r_i|^2
  };
  // Everything that does not depend on the motion, at one instant.
  struct RotorLoads {
    Pair sums;     // sum e_i omega_i^2 and sum |omega_i|
    Pair arm;      // sum |omega_i| e_z x r_i
    Pair tilting;  // roll and pitch moment of the thrusts and the disturbance about the centre
    Pair about_z;  // their yaw moment and sum |omega_i| |r_i|^2
  };
  // What an accelerometer feels at one instant.
  struct Felt {
    PlainQuaternion attitude;
    Plain3 body_rate;
    Plain3 acceleration;  // of the centre of mass
    Plain3 angular_acceleration;
    Plain3 centre;
  };

  // The loads of the rotors at the begin, halfway and at the end of a step.
  struct RotorStages {
    RotorLoads start;
    RotorLoads half;
    RotorLoads end;
  };

  struct Together;

  State stateOf(const Motion& motion) const noexcept;
  Together slopeWith(const HangingLoad& load, const Together& now,
                     const RotorLoads& rotors) const noexcept;
  Carrier carrierAt(const Motion& motion, const Motion& slope) const noexcept;
  void updateHub(std::size_t index) noexcept;
  double target(const RotorArray& command, Eigen::Index rotor) const noexcept;
  RotorArray turnRotors(const RotorArray& command, double dt) noexcept;
  RotorArray turnDamagedRotors(const RotorArray& command, double dt) noexcept;
  double givenSquares(const RotorArray& speeds) const noexcept;
  // A step with some rotor damaged or with none: who has only sound ones does not pay for the
  // others.
  template <bool damaged>
  void stepAny(const RotorArray& command, double dt) noexcept;
  void stepDamaged(const RotorArray& command, double dt) noexcept;
  template <bool damaged>
  RotorStages beginStep(const RotorArray& command, double dt) noexcept;
  void endStep(const Motion& start, const Motion& slope, const Motion& end) noexcept;
  template <bool damaged>
  RotorLoads rotorLoads(const RotorArray& speeds) const noexcept;
  ForceMoment contactForce(Motion motion) const noexcept;
  Motion derivative(const Motion& motion, const RotorLoads& rotors) const noexcept;
  void judgeContact() noexcept;
  // Diverged: from now on no motion is bearable, and each step ends where it began.
  void standStill(const Motion& last) noexcept;

  Vehicle vehicle_;  // but not its mass and inertia, which are those of the whole
  Contact contact_;
  double inverse_mass_ = 0.0;
  double lift_per_square_ = 0.0;                      // acceleration by thrust / omega_i^2 [m]
  Eigen::Vector3d centre_ = Eigen::Vector3d::Zero();  // of mass, in B [m]
  double centre_distance_ = 0.0;                      // from the origin of B [m]
  Plain33 inertia_ = {};
  Plain33 inverse_inertia_ = {};
  std::array<Hub, kMaxRotors> hubs_ = {};
  std::array<RotorCondition, kMaxRotors> conditions_ = {};
  bool damaged_ = false;  // some rotor is not sound
  double speed_limit_;    // that commands are clamped to [rad/s]

  Motion motion_ = {{}, {}, {Pair{0.0, 0.0}, Pair{0.0, 1.0}}, {}};
  // At the start of the last step; before the first one it falls freely.
  Felt felt_ = {{}, {}, {Pair{0.0, 0.0}, both(-kGravity)}, {}, {}};
  RotorArray speeds_;
  RotorLoads loads_ = {};  // of speeds_
  Plain3 wind_ = {};
  ForceMoment disturbance_;
  Plain3 steady_acceleration_ = {};  // gravity's and the disturbance's
  bool near_contact_ = true;
  bool touching_ = false;
  Crash crash_ = Crash::kNone;
  double bearable_ = 1.0;                     // absurdity() of a motion; 0 once it has diverged
  double step_ = 0.0;                         // of the decay factors [s]
  std::array<double, 2> decay_ = {1.0, 1.0};  // exp(-dt / (2 tau)), down and up
};

}  // namespace aqc::kernel
