#pragma once

#include <Eigen/Core>

namespace aqc {

/// Force and moment about the centre of mass.
struct ForceMoment {
  Eigen::Vector3d force = Eigen::Vector3d::Zero();   ///< in W [N]
  Eigen::Vector3d moment = Eigen::Vector3d::Zero();  ///< in B [N m]
};

}  // namespace aqc
