#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

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
  /// In the order of ControlLaw::adaptiveNames().
  AdaptiveValues adaptive;

  /// The mass [kg] that is estimated or, without an estimate, the one that the vertical force
  /// would hold up, which is the true one at rest.
  double liftedMass() const noexcept {
    return std::isfinite(mass_estimate) ? mass_estimate : force.z() / kGravity;
  }
};

/// A control law: from where the vehicle is and should be to what the rotors should do together.
///
/// Value-like: all state is inside, time comes in as `dt`, the same calls give the same bits.
/// update() and reset() neither allocate, block, log nor throw.
class ControlLaw {
 public:
  virtual ~ControlLaw() = default;

  /// One step of `dt` seconds (> 0): the wrench to hold until the next step. `state` and
  /// `set_point` must be valid().
  virtual Wrench update(const State& state, const SetPoint& set_point, double dt) noexcept = 0;

  /// Adaptive quantities back to their initial values.
  virtual void reset() noexcept = 0;

  /// Takes over in flight from `old`, which made the last step; called instead of reset(), between
  /// two steps. A law of the same kind carries its adaptive quantities on; another one starts from
  /// what the old law's command tells it (a law that adapts a mass: the one it carries now). Laws
  /// that adapt nothing have nothing to do.
  virtual void adopt(const ControlLaw& old) noexcept { static_cast<void>(old); }

  /// What an accelerometer at the origin of B read last, in B [m/s^2]: the force but gravity on a
  /// unit of mass. Laws that use none ignore it; those that do hold it until the next one comes and
  /// do without until the first. Whoever feeds it watches its age: see forgetSpecificForce().
  virtual void senseSpecificForce(const Eigen::Vector3d& specific_force) noexcept {
    static_cast<void>(specific_force);
  }
  /// The accelerometer has fallen silent: the sample that is held must not be used any more.
  virtual void forgetSpecificForce() noexcept {}
  /// Whether the law is meant to be fed by senseSpecificForce().
  virtual bool needsImu() const noexcept { return false; }

  /// The switching signal of a law with several subsystems, owned by the law; null for others.
  virtual SubsystemSwitch* subsystems() noexcept { return nullptr; }

  /// Of the last update().
  virtual const Telemetry& telemetry() const noexcept = 0;

  /// Names of Telemetry::adaptive with their symbols, e.g. "K_p0"; may allocate.
  virtual std::vector<std::string> adaptiveNames() const = 0;
};

}  // namespace aqc
