#pragma once

#include <Eigen/Core>
#include <limits>

#include "adaptive_quadrotor_control/math/constants.h"
#include "adaptive_quadrotor_control/model/rotor_allocation.h"
#include "adaptive_quadrotor_control/model/vehicle.h"

namespace aqc {

/// What the vehicle is, with all that it carries, against what its rotors can hold up.
struct Load {
  double carried = 0.0;  ///< with the vehicle's own mass [kg]
  /// By the thrust that the rotors have left beside the roll and pitch moments that they give [kg].
  double liftable = std::numeric_limits<double>::infinity();

  double share() const noexcept { return carried / liftable; }
};

/// Compares the two in every step: the one place that knows of overload. Who acts on it or tells of
/// it has a share and a time of its own.
class LoadWatch {
 public:
  explicit LoadWatch(const Vehicle& vehicle)
      : rotors_(vehicle), load_{vehicle.mass, vehicle.maxThrust() / kGravity} {}

  /// After a step of `dt` [s] that ended with the moment that the rotors are predicted to give in B
  /// [N m]; `carried` [kg].
  void update(double carried, const Eigen::Vector3d& moment, double dt) noexcept;
  const Load& load() const noexcept { return load_; }

 private:
  RotorAllocation rotors_;
  Eigen::Vector3d moment_ = Eigen::Vector3d::Zero();  // smoothed: that of a manoeuvre soon is over
  Load load_;
};

}  // namespace aqc
