#pragma once

#include <Eigen/Core>

#include "adaptive_quadrotor_control/math/time.h"
#include "adaptive_quadrotor_control/simulation/plant_action.h"
#include "adaptive_quadrotor_control/simulation/random.h"

namespace aqc {

/// Turbulence in the form of Dryden (MIL-F-8785C, 1980): of standard deviation sigma on each axis,
/// of length L, met at the speed V, it has over the spatial frequency Omega the spectra
///
///     sigma^2 2 L / pi / (1 + (L Omega)^2)                            along the way (x of W)
///     sigma^2 L / pi (1 + 3 (L Omega)^2) / (1 + (L Omega)^2)^2        across it (y and z)
///
/// and, with a = V / L, the autocorrelations sigma^2 exp(-a t) and sigma^2 exp(-a t) (1 - a t / 2).
///
/// Simpler than the standard: one L for all axes, and V does not follow the vehicle. White noise
/// through a linear filter for each axis, discretised exactly: what it tells at whole steps has
/// these correlations whatever the step is, from the first one on. A seed gives the same gusts
/// again.
class Gust {
 public:
  /// `step` [ns] is that of advance(), > 0.
  Gust(const SetGust& shape, Nanoseconds step);

  /// Of the air against the mean wind, in W [m/s].
  Eigen::Vector3d velocity() const noexcept;
  /// A step passes.
  void advance();

 private:
  // L of a symmetric 2 x 2 matrix L L'.
  struct Root {
    double first;
    double cross;
    double second;
  };
  static Root rootOf(double first, double cross, double second) noexcept;

  Eigen::Vector3d intensity_;
  double decay_;  // exp(-h), where h is a times the step
  double carry_;  // h exp(-h)
  Root noise_;    // that a step adds
  Random random_;
  // State of the filters x' = -x + n, y' = -y + x in the time a t, one for each axis.
  Eigen::Vector3d first_;
  Eigen::Vector3d second_;
};

}  // namespace aqc
