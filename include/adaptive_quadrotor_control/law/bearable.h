#pragma once

#include <Eigen/Core>

#include "adaptive_quadrotor_control/model/vehicle.h"

namespace aqc {

/// What may push a vehicle beside its rotors so that these, just, still hold it: no estimate of
/// such a push need be larger.
struct Bearable {
  double force;            ///< full thrust less the empty vehicle's weight [N], >= 0
  Eigen::Vector3d moment;  ///< about each axis of B while it is carried [N m]
};

Bearable bearable(const Vehicle& vehicle);

}  // namespace aqc
