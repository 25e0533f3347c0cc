#pragma once

#include "adaptive_quadrotor_control/law/control_law.h"
#include "adaptive_quadrotor_control/law/max_subsystems.h"
#include "adaptive_quadrotor_control/law/switched/subsystem_switch.h"
#include "adaptive_quadrotor_control/law/switched/switched_law.h"
#include "adaptive_quadrotor_control/math/constants.h"
#include "adaptive_quadrotor_control/math/filtered_derivative.h"
#include "adaptive_quadrotor_control/model/vehicle.h"

namespace aqc {

class ParameterReader;

/// The switched adaptive controller of thesis chapter 3 for vertical operations: height and
/// attitude are tracked, the law knows neither mass nor inertia, and it changes its gains with the
/// phase of the operation (docs/switched_control.md).
///
/// Desired are z, its derivatives, roll = pitch = 0 and yaw with its rate; x and y are not
/// controlled, as in the thesis. Roll, pitch, yaw and their rates are Z-Y-X Euler angles and their
/// derivatives; from kSteepest on the pitch's cosine is held there, so that they stay finite.
///
/// The acceleration in the law is that of the samples before the command: linear from
/// the specific force as R f - g e_3, angular the filtered derivative of the body rate turned into
/// Euler axes, without the product of rates that is of second order. Without a specific force,
/// linear is the filtered derivative of the velocity.
class Switched final : public ControlLaw {
 public:
  static constexpr double kSteepest = 85.0 * kDegree;  ///< pitch [rad]

  /// Names and meaning: config/controller/switched.yaml. Of `vehicle` the law uses the arm length l
  /// of its first rotor. Throws ParameterError.
  Switched(const ParameterReader& reader, const Vehicle& vehicle);

  Wrench command(const Sensed& sensed, const SetPoint& set_point, double dt) noexcept override;
  void adapt(const Achieved& achieved, double dt) noexcept override;
  /// Gains to their initial values and filters emptied. The active subsystem and the memory of past
  /// switches stay: they belong to the payload, not to the law. For those: subsystems()->restart().
  void reset() noexcept override;
  /// From a switched law of as many subsystems everything that is not a parameter: gains, filters,
  /// active subsystem, memory of switches. From another law nothing: this one has no integral of
  /// the weight, so it lets the vehicle sink until its error gain holds it.
  void adopt(const ControlLaw& old) noexcept override;
  bool finite() const noexcept override;
  std::unique_ptr<ControlLaw> clone() const override { return std::make_unique<Switched>(*this); }
  const char* name() const noexcept override { return kName; }
  static constexpr const char* kName = "switched";
  bool usesSpecificForce() const noexcept override { return true; }
  SubsystemSwitch* subsystems() noexcept override { return &switch_; }

  /// position_error and velocity_error in all three axes, though x and y are not controlled;
  /// attitude_error and rate_error in Euler angles; r as sliding_position.z [m/s] and
  /// sliding_attitude [rad/s]; force is the thrust, in W.
  const Telemetry& telemetry() const noexcept override { return telemetry_; }
  /// "theta_0[1]" .. "theta_3[1]", "zeta[1]", "gamma[1]", the same for every further subsystem,
  /// then "active_subsystem" and "rho".
  std::vector<AdaptiveQuantity> adaptiveQuantities() const override;

  const SwitchedLaw& law() const noexcept { return law_; }

 private:
  void sense(const Sensed& sensed, const SetPoint& set_point, double dt) noexcept;
  void report() noexcept;

  double arm_length_;  // l [m]
  SwitchedLaw law_;
  SubsystemSwitch switch_;
  FilteredDerivative velocity_slope_;
  FilteredDerivative rate_slope_;
  // Of the last command(), for adapt().
  SwitchedInput in_;
  SwitchedOutput out_;
  Telemetry telemetry_;
};

}  // namespace aqc
