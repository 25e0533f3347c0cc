#pragma once

#include <Eigen/Core>

namespace aqc {

class ParameterReader;

/// A box that can be fixed rigidly under a vehicle.
struct Payload {
  double mass = 0.0;                               ///< [kg], > 0
  Eigen::Vector3d size = Eigen::Vector3d::Zero();  ///< edge lengths along the axes of B [m], > 0
  Eigen::Vector3d offset =
      Eigen::Vector3d::Zero();  ///< of its centre of mass from the origin of B, in B [m]
  Eigen::Matrix3d inertia = Eigen::Matrix3d::Zero();  ///< about its centre of mass, in B [kg m^2]
};

/// Inertia of a solid box of even density about its centre [kg m^2].
Eigen::Matrix3d boxInertia(double mass, const Eigen::Vector3d& size);

/// Reads `mass`, up to a tonne, `size` and `offset`, up to 10 m in each axis, and, if not that of a
/// solid box, `inertia` (readInertia()). Throws ParameterError.
Payload readPayload(const ParameterReader& reader);

}  // namespace aqc
