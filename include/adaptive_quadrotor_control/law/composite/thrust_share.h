#pragma once

#include <Eigen/Core>

namespace aqc {

/// Who gets how much of a thrust that does not suffice for all: height first, but a part that is
/// kept for the sides; then the sides; then what is left for the height.
class ThrustShare {
 public:
  /// `most_thrust` T_lim [N]; `slope` is the tangent of the largest tilt.
  ThrustShare(double most_thrust, double slope) noexcept : most_(most_thrust), slope_(slope) {}

  struct Force {
    Eigen::Vector3d force;  ///< in W [N]
    bool clamped;           ///< it is not what was asked for
  };
  /// Of the force that is asked for in W [N], for a vehicle of `mass` [kg].
  Force share(const Eigen::Vector3d& asked, double mass) const noexcept;

  /// The acceleration to the side that is left beside F_1, the height's claim [m/s^2].
  double sideways(double mass) const noexcept;
  /// The acceleration upwards that is left in a hover [m/s^2]; < 0: it cannot hover.
  double upwards(double mass) const noexcept;

 private:
  double claim(double vertical, double mass) const noexcept;

  double most_;
  double slope_;
};

}  // namespace aqc
