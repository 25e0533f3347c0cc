#pragma once

#include <Eigen/Core>
#include <limits>

#include "adaptive_quadrotor_control/law/low_pass.h"
#include "adaptive_quadrotor_control/model/vehicle.h"

namespace aqc {

class ParameterReader;

/// How heavy the vehicle is with what it carries, and what pushes it beside its rotors: by the
/// accelerometer, m = T / f_z, which holds in any motion and for any wrong force constant, or,
/// without one, by an observer of the velocity.
///
/// Every update starts from what was learned so far; keep() makes it so.
class MassEstimate {
 public:
  /// Reads mass_time, force_time, velocity_bandwidth and acceleration_time. Throws ParameterError.
  MassEstimate(const ParameterReader& reader, const Vehicle& vehicle);

  /// By an accelerometer's sample `felt` in B [m/s^2], `thrust` [N] of the same moment, and the
  /// attitude R, over `dt` [s].
  void feel(const Eigen::Vector3d& felt, double thrust, const Eigen::Matrix3d& attitude,
            double dt) noexcept;
  /// By a velocity in W, z of B in W at that time, and the mean thrust [N] of the `elapsed` seconds
  /// since the velocity before it; 0: it is the same one.
  void see(const Eigen::Vector3d& velocity, const Eigen::Vector3d& z_body, double thrust,
           double elapsed) noexcept;
  /// Nothing to compare with: the motion is observed anew, what was learned stays.
  void restart() noexcept;
  /// The last update is learned.
  void keep() noexcept { learned_ = values_; }

  /// m-hat [kg].
  double mass() const noexcept { return values_.mass; }
  double learnedMass() const noexcept { return learned_.mass; }
  /// The same, but for the bound of what the rotors lift [kg].
  double weighed() const noexcept { return learned_.weighed; }
  /// d_f in W [m/s^2]: on a unit of mass, what neither rotors nor gravity explain.
  const Eigen::Vector3d& force() const noexcept { return values_.force; }
  /// Specific force in B [m/s^2], smoothed; its z is T / m-hat. `thrust` is of now [N].
  Eigen::Vector3d specificForce(double thrust) const noexcept;
  /// Whether d_f is not in specificForce() already.
  bool seesOnly() const noexcept { return !values_.feels; }
  /// Whether the rotors have carried the vehicle since reset().
  bool lifted() const noexcept { return values_.lifted; }

  void reset() noexcept;
  /// In flight, from what another law knows [kg].
  void adopt(double mass) noexcept;
  void adopt(const MassEstimate& old) noexcept;
  /// m-hat <= most [kg], too.
  void bound(double most) noexcept;
  bool finite() const noexcept;

 private:
  struct Values {
    double mass;
    double weighed;
    Eigen::Vector3d force = Eigen::Vector3d::Zero();
    double thrust = 0.0;                                 // T_f, smoothed as f is
    Eigen::Vector3d felt = Eigen::Vector3d::Zero();      // f, for the mass
    Eigen::Vector3d smooth = Eigen::Vector3d::Zero();    // f, for the motion
    Eigen::Vector3d velocity = Eigen::Vector3d::Zero();  // v-hat
    bool feels = false;
    bool sees = false;  // v-hat is of this flight
    bool lifted = false;
  };
  void watchLift(double thrust, double lift) noexcept;
  void weigh(double mass, double share, double dt) noexcept;
  double within(double mass) const noexcept;

  double empty_mass_;
  double liftable_;  // by the rotors [kg]
  double most_;
  LowPass sample_;  // of thrust and specific force
  LowPass mass_lag_;
  LowPass force_lag_;
  LowPass motion_lag_;
  LowPass velocity_lag_;
  LowPass shift_lag_;  // from d_f along the thrust into the mass
  Values learned_;
  Values values_;
};

}  // namespace aqc
