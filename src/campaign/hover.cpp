#include "campaign/hover.h"

#include <Eigen/Dense>

namespace aqc {

bool canHover(const Vehicle& vehicle, const std::vector<RotorCondition>& rotors, double voltage,
              double load) {
  const auto count = static_cast<Eigen::Index>(vehicle.rotors.size());
  Eigen::Matrix4Xd wrenches(4, count);  // of 1 N of each rotor
  for (Eigen::Index i = 0; i < count; ++i) {
    const Rotor& rotor = vehicle.rotors[static_cast<std::size_t>(i)];
    const Eigen::Vector2d hub = rotor.position();
    wrenches.col(i) << 1.0, hub.y(), -hub.x(), -rotor.direction * vehicle.moment_constant;
  }
  const Eigen::VectorXd thrusts =
      wrenches.completeOrthogonalDecomposition().solve(Eigen::Vector4d(load, 0.0, 0.0, 0.0));
  const double speed = voltage * vehicle.max_rotor_speed;
  const double most = vehicle.force_constant * speed * speed;
  for (Eigen::Index i = 0; i < count; ++i) {
    const RotorCondition& rotor = rotors[static_cast<std::size_t>(i)];
    if (rotor.stuck_at || thrusts[i] > rotor.effectiveness * most) return false;
  }
  return true;
}

}  // namespace aqc
