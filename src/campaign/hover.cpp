#include "campaign/hover.h"

namespace aqc {

Hover::Hover(const Vehicle& vehicle) : allocation_(vehicle), most_speed_(vehicle.max_rotor_speed) {}

bool Hover::isPossible(const std::vector<RotorCondition>& rotors, double voltage,
                       double load) const {
  Wrench lift;
  lift.thrust = load;
  const Allocation shares = allocation_.allocate(lift);
  if (shares.saturated) return false;
  const double most = voltage * voltage * most_speed_ * most_speed_;
  for (std::size_t i = 0; i < rotors.size(); ++i) {
    const double speed = shares.speeds[static_cast<Eigen::Index>(i)];
    if (rotors[i].stuck_at || speed * speed > rotors[i].effectiveness * most) return false;
  }
  return true;
}

}  // namespace aqc
