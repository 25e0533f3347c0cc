#pragma once

#include <Eigen/Core>

namespace aqc {

class ParameterReader;

/// Reads `inertia`, of a vehicle or of what it carries, about the centre of mass, in B [kg m^2]:
/// xx, yy, zz, or xx, yy, zz, xy, xz, yz. Its principal moments are positive, at least `least`, and
/// no entry is beyond 1e5, a tonne 10 m away. No moment of a rigid body exceeds the other two
/// together; published ones do (RotorS's Firefly by 21 %), so that only what must be a typing
/// mistake, beyond 1.5 times, is refused. Throws ParameterError.
Eigen::Matrix3d readInertia(const ParameterReader& reader, double least = 0.0);

}  // namespace aqc
