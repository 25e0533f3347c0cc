#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cmath>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "adaptive_quadrotor_control/model/rotor_allocation.h"
#include "adaptive_quadrotor_control/model/state.h"
#include "adaptive_quadrotor_control/reference/set_point.h"

namespace aqc {

class SubsystemSwitch;

/// Most adaptive quantities one controller may report.
constexpr int kMaxAdaptive = 64;
using AdaptiveValues = Eigen::Matrix<double, Eigen::Dynamic, 1, Eigen::ColMajor, kMaxAdaptive, 1>;

/// What a control law saw and decided in its last step.
struct Telemetry {
  Eigen::Vector3d position_error = Eigen::Vector3d::Zero();    ///< e_p = p - p_d, in W [m]
  Eigen::Vector3d velocity_error = Eigen::Vector3d::Zero();    ///< de_p, in W [m/s]
  Eigen::Vector3d attitude_error = Eigen::Vector3d::Zero();    ///< e_q, in B [rad]
  Eigen::Vector3d rate_error = Eigen::Vector3d::Zero();        ///< de_q, in B [rad/s]
  Eigen::Vector3d sliding_position = Eigen::Vector3d::Zero();  ///< s_p [m/s]; 0 without a surface
  Eigen::Vector3d sliding_attitude = Eigen::Vector3d::Zero();  ///< s_q [rad/s]; 0 without a surface
  Eigen::Vector3d force = Eigen::Vector3d::Zero();             ///< tau_p, in W [N]
  Eigen::Quaterniond desired_attitude = Eigen::Quaterniond::Identity();  ///< R_d
  /// m-hat [kg]; not-a-number when the law estimates no mass.
  double mass_estimate = std::numeric_limits<double>::quiet_NaN();
  /// What the law weighs, however heavy it is [kg]: m-hat before it is bounded by what the rotors
  /// lift; not-a-number when it does not weigh.
  double weighed_mass = std::numeric_limits<double>::quiet_NaN();
  /// In the order of ControlLaw::adaptiveQuantities().
  AdaptiveValues adaptive;

  /// The mass [kg] that is estimated or, without an estimate, the one that the vertical force
  /// would hold up, which is the true one at rest.
  double liftedMass() const noexcept {
    return std::isfinite(mass_estimate) ? mass_estimate : force.z() / kGravity;
  }
  /// The mass [kg] that is weighed or, by a law that does not weigh, liftedMass().
  double carriedMass() const noexcept {
    return std::isfinite(weighed_mass) ? weighed_mass : liftedMass();
  }
};

/// How long ago the parts of Sensed were measured [s], >= 0.
struct Ages {
  double pose = 0.0;  ///< position, velocity and attitude
  double body_rate = 0.0;
  double specific_force = 0.0;
};

/// What is known of the vehicle when a command is due.
struct Sensed {
  State state = {};  ///< as it was measured, not predicted to now; its parts at times of their own
  /// What an accelerometer at the origin of B read, in B [m/s^2]: the force but gravity on a unit
  /// of mass. Nothing when there is none, or none that is young enough to be used.
  std::optional<Eigen::Vector3d> specific_force = std::nullopt;
  Ages ages = {};
  /// An accelerometer without a gyroscope: the body rate is odometry's, which may be older than it
  /// says.
  bool rate_of_odometry = false;
};

/// What became of a command.
struct Achieved {
  const Allocation& allocation;  ///< what was asked for, what the rotors are told, what that gives
  const RotorArray& rotor_speeds;  ///< where they are predicted to be when the command ends [rad/s]
};

/// One of the numbers that a law adapts.
struct AdaptiveQuantity {
  std::string name;  ///< with its symbol, e.g. "K_p0"
  /// E.g. "N"; empty for a count, and where a record does not tell. ||xi|| is the norm of the error
  /// and its rate together, a mixture of m and m/s or of rad and rad/s: docs/tuning.md and
  /// docs/switched_control.md.
  std::string unit;
};
inline bool operator==(const AdaptiveQuantity& a, const AdaptiveQuantity& b) {
  return a.name == b.name && a.unit == b.unit;
}
inline bool operator!=(const AdaptiveQuantity& a, const AdaptiveQuantity& b) {
  return !(a == b);
}

/// What is known of the vehicle that no estimate of a law can be beyond.
struct EstimateBounds {
  /// Of the carried mass with the vehicle's own [kg], >= 0; the least is 0.
  double most_mass = std::numeric_limits<double>::infinity();
};

/// A control law: from where the vehicle is and should be to what the rotors should do together.
///
/// Value-like: all state is inside, time comes in as `dt`, the same calls give the same bits.
/// command(), observe(), adapt(), reset(), adopt(), bound() and finite() neither allocate, block,
/// log nor throw.
class ControlLaw {
 public:
  virtual ~ControlLaw() = default;

  /// The wrench to hold for the next `dt` seconds (> 0). `sensed.state` and `set_point` must be
  /// valid(). Every command is followed by adapt() before the next one, or by none while
  /// adaptation rests: what was learned then stays as it is, and telemetry() tells of the command.
  virtual Wrench command(const Sensed& sensed, const SetPoint& set_point, double dt) noexcept = 0;

  /// What the rotors are predicted to give at the end of a step of `dt` seconds (> 0), told after
  /// every step, with a set point or without one, and before adapt(). Outlives reset(): rotors do
  /// not stand still because a law forgets. Laws that do not want to know have nothing to do.
  virtual void observe(const Wrench& given, double dt) noexcept {
    static_cast<void>(given);
    static_cast<void>(dt);
  }

  /// Learns from the last command over the `dt` seconds for which it holds, knowing what the rotors
  /// could give of it.
  virtual void adapt(const Achieved& achieved, double dt) noexcept = 0;

  /// Adaptive quantities back to their initial values.
  virtual void reset() noexcept = 0;

  /// Takes over in flight from `old`, which made the last step; called instead of reset(), between
  /// two steps (bumpless transfer). A law of the same kind carries its adaptive quantities on;
  /// another one starts from what the old law's command tells it (a law that adapts a mass: the one
  /// it carries now). Laws that adapt nothing have nothing to do.
  virtual void adopt(const ControlLaw& old) noexcept { static_cast<void>(old); }

  /// From here on no estimate leaves `bounds`, whatever is sensed; until then only the law's own
  /// parameters bound it. A clone keeps the bounds; adopt() does not take them over.
  virtual void bound(const EstimateBounds& bounds) noexcept { static_cast<void>(bounds); }

  /// Whether all that it has learned is finite. If not, no command will ever be of use again, until
  /// reset(). A valid but absurd state, whose square is beyond a double, can do that.
  virtual bool finite() const noexcept { return true; }

  /// A law of its own in the same state; allocates.
  virtual std::unique_ptr<ControlLaw> clone() const = 0;

  /// The name under which the factory makes it: the parameter `law`.
  virtual const char* name() const noexcept = 0;

  /// Whether the law makes use of Sensed::specific_force. Every law must do without.
  virtual bool usesSpecificForce() const noexcept { return false; }

  /// Whether, of a law that usesSpecificForce(), Sensed::state is to have the body rate of the
  /// IMU's gyroscope, which is younger than that of late odometry; Ages tells how old it is.
  virtual bool usesGyroscope() const noexcept { return false; }

  /// Whether observe() is to be called.
  virtual bool observesRotors() const noexcept { return false; }

  /// How far the rotors are to be told to go, in units of where they are to be: see
  /// RotorLag::lead(). 1: just there.
  virtual double rotorLead() const noexcept { return 1.0; }

  /// The switching signal of a law with several subsystems, owned by the law; null for others.
  virtual SubsystemSwitch* subsystems() noexcept { return nullptr; }
  const SubsystemSwitch* subsystems() const noexcept {
    return const_cast<ControlLaw*>(this)->subsystems();  // to look at
  }

  /// Of the last command() and adapt().
  virtual const Telemetry& telemetry() const noexcept = 0;

  /// What stands in Telemetry::adaptive; may allocate.
  virtual std::vector<AdaptiveQuantity> adaptiveQuantities() const { return {}; }
};

}  // namespace aqc
