#pragma once

#include "adaptive_quadrotor_control/law/attitude.h"
#include "adaptive_quadrotor_control/law/control_law.h"

namespace aqc {

class ParameterReader;

struct PositionErrors {
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  ///< e_p = p - p_d, in W [m]
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero();  ///< de_p, in W [m/s]
};

/// The outer/inner structure of thesis chapter 2, shared by every law built on it: a position law
/// gives the force tau_p; its direction and the yaw give the desired attitude R_d; an attitude law
/// gives the moment tau_q; the thrust is the part of tau_p along the body's z axis.
class CascadedLaw : public ControlLaw {
 public:
  Wrench command(const Sensed& sensed, const SetPoint& set_point, double dt) noexcept override;
  const Telemetry& telemetry() const noexcept final { return telemetry_; }

 protected:
  /// Reads `max_tilt_deg`, in (0, 89], `min_lift` [N], > 0, and, if it is there, `attitude_error`:
  /// thesis (as without it) or quaternion, see AttitudeErrorKind.
  explicit CascadedLaw(const ParameterReader& reader);

  /// tau_p in W [N]. Laws with a sliding surface report their s_p.
  virtual Eigen::Vector3d force(const PositionErrors& errors,
                                const SetPoint& set_point) noexcept = 0;
  /// tau_q in B [N m]. Laws with a sliding surface report their s_q.
  virtual Eigen::Vector3d moment(const State& state, const AttitudeErrors& errors) noexcept = 0;

  /// To write into, never to read from.
  Telemetry telemetry_;
  /// For force() to set, of laws that follow it: how R_d is about to turn, beside the yaw, in W
  /// [rad/s]. It is part of omega_d then.
  std::optional<Eigen::Vector3d> turn_;

 private:
  TiltLimits limits_;
  AttitudeErrorKind error_kind_;
};

}  // namespace aqc
