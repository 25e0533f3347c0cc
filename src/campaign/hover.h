#pragma once

#include <vector>

#include "adaptive_quadrotor_control/model/rotor_allocation.h"
#include "adaptive_quadrotor_control/simulation/rotor_condition.h"

namespace aqc {

/// Tells whether a vehicle's rotors can hold up a load without turning it.
class Hover {
 public:
  explicit Hover(const Vehicle& vehicle);

  /// Whether each rotor can give its share of `load` [N], > 0 (the least-squares one, on a
  /// quadrotor the only one), with what is wrong with it and with the battery at `voltage` (share
  /// of the full one). A rotor that is stuck cannot. Where it is false physics leaves no choice but
  /// to come down. Asked in every step of a flight: allocates nothing.
  bool isPossible(const std::vector<RotorCondition>& rotors, double voltage, double load) const;

 private:
  RotorAllocation allocation_;
  double most_speed_;  // of a rotor [rad/s]
};

}  // namespace aqc
