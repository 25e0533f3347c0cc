#pragma once

#include "adaptive_quadrotor_control/law/cascaded_law.h"
#include "adaptive_quadrotor_control/model/vehicle.h"

namespace aqc {

/// Geometric tracking control on SE(3) (Lee, Leok and McClamroch 2010), the thesis's "PD" baseline.
/// It knows the empty vehicle's mass and inertia and has no integral action. Laws that add to it
/// derive from it.
class Geometric : public CascadedLaw {
 public:
  /// Names and meaning: config/controller/geometric.yaml. Throws ParameterError.
  Geometric(const ParameterReader& reader, const Vehicle& vehicle)
      : Geometric(reader, vehicle, BodyRate::kYaw) {}

  void adapt(const Achieved&, double) noexcept override {}
  void reset() noexcept override {}
  std::unique_ptr<ControlLaw> clone() const override { return std::make_unique<Geometric>(*this); }
  const char* name() const noexcept override { return kName; }
  static constexpr const char* kName = "geometric";

 protected:
  /// What omega_d is made of.
  enum class BodyRate {
    kYaw,   ///< the rate of the yaw alone, as in the thesis's flights
    kJerk,  ///< also the turn that the set point's jerk asks for, as in the paper
  };
  Geometric(const ParameterReader& reader, const Vehicle& vehicle, BodyRate follows);

  Eigen::Vector3d force(const PositionErrors& errors, const SetPoint& set_point) noexcept override;
  Eigen::Vector3d moment(const State& state, const AttitudeErrors& errors) noexcept override;

  double mass() const noexcept { return mass_; }                        ///< empty [kg]
  const Eigen::Matrix3d& inertia() const noexcept { return inertia_; }  ///< empty [kg m^2]

 private:
  double mass_;              // [kg]
  Eigen::Matrix3d inertia_;  // [kg m^2]
  bool follows_jerk_;
  Eigen::Vector3d position_gain_;  // k_x [N/m]
  Eigen::Vector3d velocity_gain_;  // k_v [N s/m]
  Eigen::Vector3d attitude_gain_;  // k_R [N m/rad]
  Eigen::Vector3d rate_gain_;      // k_omega [N m s/rad]
};

}  // namespace aqc
