#pragma once

#include <Eigen/Core>

#include "adaptive_quadrotor_control/law/low_pass.h"
#include "adaptive_quadrotor_control/model/vehicle.h"

namespace aqc {

class ParameterReader;

/// The moments of inertia about the axes of B: least squares between band-passed moments and the
/// band-passed angular acceleration, forgetting, around a prior that grows with the carried mass.
class InertiaEstimate {
 public:
  /// Reads prior_slope. Throws ParameterError.
  InertiaEstimate(const ParameterReader& reader, const Vehicle& vehicle);

  /// By a body rate and the mean moment of the rotors over the last `dt` seconds; `mass` is m-hat.
  void update(const Eigen::Vector3d& body_rate, const Eigen::Vector3d& moment, double mass,
              double dt) noexcept;
  /// The filters begin anew; what was learned stays.
  void restart() noexcept { fresh_ = true; }

  /// J-hat about x, y and z of B [kg m^2].
  const Eigen::Vector3d& value() const noexcept { return value_; }

  void reset() noexcept;
  /// In flight, for a vehicle of the mass m-hat: the prior.
  void adopt(double mass) noexcept;
  void adopt(const InertiaEstimate& old) noexcept;
  bool finite() const noexcept { return value_.allFinite(); }

 private:
  void filter(const Eigen::Vector3d& body_rate, const Eigen::Vector3d& moment, double dt) noexcept;
  // In the fit, 0 to 1 for each axis.
  Eigen::Vector3d trust() const noexcept;
  Eigen::Vector3d prior(double mass) const noexcept;

  // tw s / ((tl s + 1) (tw s + 1)^2): neither an offset nor what is fast comes through.
  struct BandPass {
    Eigen::Vector3d low, slow, offset;
    void start(const Eigen::Vector3d& input) noexcept;
  };

  Eigen::Vector3d empty_;  // J0
  double empty_mass_;
  Eigen::Vector3d slope_;   // of the prior over the carried mass [m^2]
  Eigen::Vector3d weight_;  // of the prior: c
  LowPass low_lag_;
  LowPass wide_lag_;
  LowPass forgetting_;
  LowPass rise_;
  BandPass rate_;
  BandPass moment_;
  Eigen::Vector3d moment_squares_ = Eigen::Vector3d::Zero();  // S_tt
  Eigen::Vector3d products_ = Eigen::Vector3d::Zero();        // S_ta
  Eigen::Vector3d acceleration_squares_ = Eigen::Vector3d::Zero();
  Eigen::Vector3d value_;
  double mass_;  // of the last update
  bool fresh_ = true;
};

}  // namespace aqc
