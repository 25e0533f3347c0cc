#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>

#include "adaptive_quadrotor_control/model/rotor_allocation.h"
#include "support/fixtures.h"

namespace aqc {
namespace {

double anyReal(double low, double high) {
  constexpr int kSteps = 1000000;
  return low + (high - low) * *rc::gen::inRange(0, kSteps + 1) / kSteps;
}

/// Four to sixteen rotors about evenly around the vehicle, on arms of unequal length, spinning
/// alternately.
Vehicle anyVehicle() {
  Vehicle vehicle = test::pelican();
  vehicle.rotors.clear();
  const int count = *rc::gen::inRange(4, kMaxRotors + 1);
  const double first = anyReal(-3.0, 3.0);
  for (int i = 0; i < count; ++i) {
    const double slot = 2.0 * M_PI / count;
    vehicle.rotors.push_back(
        {first + slot * (i + anyReal(-0.2, 0.2)), anyReal(0.15, 0.3), i % 2 == 0 ? 1 : -1});
  }
  vehicle.force_constant = std::pow(10.0, anyReal(-6.0, -4.0));
  vehicle.max_rotor_speed = anyReal(300.0, 2000.0);
  return vehicle;
}

Wrench anyRequest(const Vehicle& vehicle) {
  const double size = vehicle.maxThrust() * std::pow(10.0, anyReal(-3.0, 3.0));
  return {anyReal(-size, size),
          {anyReal(-0.2 * size, 0.2 * size), anyReal(-0.2 * size, 0.2 * size),
           anyReal(-0.2 * size, 0.2 * size)}};
}

Eigen::Vector4d numbers(const Wrench& wrench) {
  return {wrench.thrust, wrench.moment.x(), wrench.moment.y(), wrench.moment.z()};
}

RC_GTEST_PROP(RotorAllocations, AreWithinLimitsAndTruthful, ()) {
  const Vehicle vehicle = anyVehicle();
  const RotorAllocation rotors(vehicle);
  RC_PRE(rotors.wellPosed());
  const Wrench request = anyRequest(vehicle);
  const Allocation allocation = rotors.allocate(request);
  RC_ASSERT(allocation.speeds.minCoeff() >= 0.0);
  RC_ASSERT(allocation.speeds.maxCoeff() <= vehicle.max_rotor_speed * (1.0 + 1e-12));
  const double scale = vehicle.maxThrust();
  RC_ASSERT((numbers(allocation.achieved) - numbers(rotors.wrench(allocation.speeds))).norm() <
            1e-9 * scale);
  RC_ASSERT(allocation.saturated ||
            (numbers(allocation.achieved) - numbers(request)).norm() < 1e-9 * scale);
}

RC_GTEST_PROP(RotorAllocations, KeepThePriority, ()) {
  const Vehicle vehicle = anyVehicle();
  const RotorAllocation rotors(vehicle);
  RC_PRE(rotors.wellPosed());
  const Wrench request = anyRequest(vehicle);
  const Allocation allocation = rotors.allocate(request);
  const double scale = vehicle.maxThrust();
  const Eigen::Vector2d tilt = request.moment.head<2>();
  const Eigen::Vector2d achieved = allocation.achieved.moment.head<2>();
  const bool is_tilt_met = (achieved - tilt).norm() < 1e-6 * scale;
  const bool is_thrust_met = std::abs(allocation.achieved.thrust - request.thrust) < 1e-6 * scale;
  const bool is_yaw_met =
      std::abs(allocation.achieved.moment.z() - request.moment.z()) < 1e-6 * scale;
  // Whoever stands later in the order is met only if everyone before is: roll and pitch, thrust,
  // yaw. A yaw moment that gave way is the request's share, or none where thrust gave way, too.
  if (!is_tilt_met) {
    RC_ASSERT(achieved.norm() <= tilt.norm());
    const Eigen::Vector2d direction = tilt.normalized();
    RC_ASSERT(achieved.dot(direction) > 0.0);
    RC_ASSERT((achieved - achieved.dot(direction) * direction).norm() < 1e-6 * scale);
  }
  if (!is_thrust_met) RC_ASSERT(std::abs(allocation.achieved.moment.z()) < 1e-6 * scale);
  if (is_thrust_met && is_tilt_met && !is_yaw_met) {
    const double share = allocation.achieved.moment.z() / request.moment.z();
    RC_ASSERT(share > -1e-6);
    RC_ASSERT(share < 1.0);
  }
}

RC_GTEST_PROP(RotorAllocations, UndoTheWrenchOfFeasibleRequests, ()) {
  const Vehicle vehicle = anyVehicle();
  const RotorAllocation rotors(vehicle);
  RC_PRE(rotors.wellPosed());
  // What the rotors give at speeds near the middle can always be asked for.
  RotorArray speeds(static_cast<Eigen::Index>(vehicle.rotors.size()));
  for (double& speed : speeds) speed = vehicle.max_rotor_speed * anyReal(0.69, 0.71);
  const Wrench request = rotors.wrench(speeds);
  const Allocation allocation = rotors.allocate(request);
  RC_PRE(!allocation.saturated);
  RC_ASSERT((numbers(rotors.wrench(allocation.speeds)) - numbers(request)).norm() <
            1e-9 * vehicle.maxThrust());
}

}  // namespace
}  // namespace aqc
