#include "adaptive_quadrotor_control/law/bearable.h"

#include <algorithm>

#include "adaptive_quadrotor_control/math/constants.h"

namespace aqc {
namespace {

// Shares of full thrust times arm length, and of full thrust times drag moment per thrust.
constexpr double kTiltShare = 0.085;
constexpr double kYawShare = 0.45;
constexpr double kLeastPush = 1e-6;  // [N]: a vector is shortened to it without dividing by zero

}  // namespace

Bearable bearable(const Vehicle& vehicle) {
  double arm = 0.0;
  for (const Rotor& rotor : vehicle.rotors) arm = std::max(arm, rotor.arm_length);
  const double tilt = kTiltShare * vehicle.maxThrust() * arm;
  return {std::max(vehicle.maxThrust() - vehicle.mass * kGravity, kLeastPush),
          {tilt, tilt, kYawShare * vehicle.maxThrust() * vehicle.moment_constant}};
}

}  // namespace aqc
