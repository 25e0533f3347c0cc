#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cstdint>

#include "adaptive_quadrotor_control/simulation/random.h"

namespace aqc {

constexpr double kFlatBox = 0.05;  ///< height of a drawn payload: it lies between the feet [m]

/// Even numbers of a seed.
class Dice {
 public:
  explicit Dice(std::uint64_t seed) : random_(seed) {}

  double between(double low, double high) { return low + (high - low) * random_.uniform(); }
  /// Both ends may come.
  int count(int low, int high) {
    return std::min(high, static_cast<int>(between(low, high + 1.0)));
  }
  bool chance(double share) { return random_.chance(share); }
  /// Of length 1.
  Eigen::Vector3d direction() {
    Eigen::Vector3d vector = random_.normal3();
    while (vector.norm() < 1e-3) vector = random_.normal3();
    return vector.normalized();
  }

 private:
  Random random_;
};

}  // namespace aqc
