#pragma once

#include <Eigen/Core>

namespace aqc {

/// How fast the error may be made to vanish: a slope near zero and, further away, no faster than
/// `braking` stops, at most `speed`.
struct Approach {
  double slope;    ///< Phi [1/s], > 0
  double braking;  ///< a [m/s^2], > 0
  double speed;    ///< at most [m/s], > 0
};

/// The sliding surface s = de + phi(e), where phi(r) = Phi r up to r = l = a / Phi^2 and
/// sqrt(a (2 r - l)) beyond, at most the speed. On s = 0 the vehicle brakes with a. Horizontally r
/// is the distance, so that the approach is straight.
class BoundedSurface {
 public:
  /// At the error e in W [m].
  BoundedSurface(const Eigen::Vector3d& error, const Approach& sideways,
                 const Approach& vertical) noexcept;

  /// phi(e) [m/s].
  const Eigen::Vector3d& value() const noexcept { return value_; }
  /// phi'(e) times a vector.
  Eigen::Vector3d slopeTimes(const Eigen::Vector3d& vector) const noexcept;
  /// Whether e is where phi = Phi e.
  bool linearSideways() const noexcept { return linear_sideways_; }
  bool linearVertically() const noexcept { return linear_vertically_; }

 private:
  Eigen::Vector3d value_;
  Eigen::Vector2d direction_;  // of the horizontal error
  double radial_;              // slope along it [1/s]
  double tangential_;          // and across
  double vertical_;
  bool linear_sideways_;
  bool linear_vertically_;
};

}  // namespace aqc
