#pragma once

#include "adaptive_quadrotor_control/law/attitude.h"
#include "adaptive_quadrotor_control/law/control_law.h"

namespace aqc {

class ParameterReader;

/// The outer/inner structure of thesis chapter 2, shared by every law built on it: a position law
/// gives the force tau_p; its direction and the yaw give the desired attitude R_d; an attitude law
/// gives the moment tau_q; the thrust is the part of tau_p along the body's z axis.
class CascadedLaw : public ControlLaw {
 public:
  Wrench update(const State& state, const SetPoint& set_point, double dt) noexcept final;
  const Telemetry& telemetry() const noexcept final { return telemetry_; }

 protected:
  /// Reads `max_tilt_deg`, in (0, 89], and `min_lift` [N], > 0.
  explicit CascadedLaw(const ParameterReader& reader);

  /// tau_p in W [N] from e_p, de_p (in telemetry_) and the set point.
  virtual Eigen::Vector3d force(const SetPoint& set_point, double dt) noexcept = 0;
  /// tau_q in B [N m] from the attitude errors.
  virtual Eigen::Vector3d moment(const State& state, const AttitudeErrors& errors,
                                 double dt) noexcept = 0;
  /// Writes Telemetry::adaptive and mass_estimate; called at the end of every update().
  virtual void report(Telemetry& telemetry) const noexcept = 0;

  /// e_p, de_p of this step; laws add their sliding variables.
  Telemetry telemetry_;

 private:
  TiltLimits limits_;
};

}  // namespace aqc
