#pragma once

#include <Eigen/Core>

namespace aqc {

/// An obstacle: a box with its edges along the axes of W.
struct Box {
  Eigen::Vector3d min = Eigen::Vector3d::Zero();  ///< lower corner [m]
  Eigen::Vector3d max = Eigen::Vector3d::Zero();  ///< upper corner [m], above `min` in every axis
};

/// How deep a point is in something solid and which way is out.
struct Penetration {
  double depth = 0.0;                                 ///< [m]; <= 0 outside
  Eigen::Vector3d normal = Eigen::Vector3d::UnitZ();  ///< outward, in W
};

/// Of a point at that height [m] into the ground, the half space z < 0.
inline Penetration penetrationIntoGround(double height) {
  return {-height, Eigen::Vector3d::UnitZ()};
}

/// Into a box, through its nearest face.
inline Penetration penetrationInto(const Box& box, const Eigen::Vector3d& point) {
  const Eigen::Vector3d from_min = point - box.min;
  const Eigen::Vector3d to_max = box.max - point;
  Eigen::Index min_axis = 0;
  Eigen::Index max_axis = 0;
  const double lower = from_min.minCoeff(&min_axis);
  const double upper = to_max.minCoeff(&max_axis);
  if (lower < upper) return {lower, -Eigen::Vector3d::Unit(min_axis)};
  return {upper, Eigen::Vector3d::Unit(max_axis)};
}

}  // namespace aqc
