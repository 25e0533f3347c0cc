#pragma once

#include "adaptive_quadrotor_control/law/cascaded_law.h"
#include "adaptive_quadrotor_control/model/vehicle.h"

namespace aqc {

/// Geometric tracking control on SE(3) (Lee, Leok and McClamroch 2010), the thesis's "PD" baseline.
/// It knows the empty vehicle's mass and inertia and has no integral action.
class Geometric final : public CascadedLaw {
 public:
  /// Names and meaning: config/controller/geometric.yaml. Throws ParameterError.
  Geometric(const ParameterReader& reader, const Vehicle& vehicle);

  void reset() noexcept override {}
  std::vector<std::string> adaptiveNames() const override { return {}; }

 private:
  Eigen::Vector3d force(const SetPoint& set_point, double dt) noexcept override;
  Eigen::Vector3d moment(const State& state, const AttitudeErrors& errors,
                         double dt) noexcept override;
  void report(Telemetry&) const noexcept override {}

  double mass_;                    // [kg]
  Eigen::Matrix3d inertia_;        // [kg m^2]
  Eigen::Vector3d position_gain_;  // k_x [N/m]
  Eigen::Vector3d velocity_gain_;  // k_v [N s/m]
  Eigen::Vector3d attitude_gain_;  // k_R [N m/rad]
  Eigen::Vector3d rate_gain_;      // k_omega [N m s/rad]
};

}  // namespace aqc
