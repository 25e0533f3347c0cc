#pragma once

#include <Eigen/Core>
#include <algorithm>

namespace aqc {

/// sat(s, varpi) of the thesis: s / ||s|| outside the boundary layer, s / varpi inside it.
/// `boundary_layer` > 0.
inline Eigen::Vector3d saturate(const Eigen::Vector3d& s, double boundary_layer) {
  return s / std::max(s.norm(), boundary_layer);
}

/// The same for every axis by itself: each entry in [-1, 1].
inline Eigen::Vector3d saturatePerAxis(const Eigen::Vector3d& s, double boundary_layer) {
  return (s / boundary_layer).cwiseMax(-1.0).cwiseMin(1.0);
}

}  // namespace aqc
