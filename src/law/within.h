#pragma once

#include <Eigen/Core>
#include <algorithm>

namespace aqc {

/// `vector`, shortened to the length `most` where it is longer; its direction stays, so that no law
/// prefers an axis of the world. Finite for every finite vector.
inline Eigen::Vector3d within(const Eigen::Vector3d& vector, double most) noexcept {
  constexpr double kSquareable = 1e100;
  const Eigen::Vector3d safe = vector.cwiseMax(-kSquareable).cwiseMin(kSquareable);
  return safe * (most / std::max(safe.norm(), most));
}

}  // namespace aqc
