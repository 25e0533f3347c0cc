#include "adaptive_quadrotor_control/model/rotor_lag.h"

#include <gtest/gtest.h>

#include <cmath>

#include "adaptive_quadrotor_control/simulation/rigid_plant.h"
#include "support/fixtures.h"

namespace aqc {
namespace {

TEST(RotorLag, FollowsItsCommandAsAFirstOrderLag) {
  Vehicle vehicle = test::pelican();
  vehicle.time_constant_up = 0.02;
  vehicle.time_constant_down = 0.05;
  RotorLag lag(vehicle);
  EXPECT_EQ(lag.speeds().norm(), 0.0);
  lag.turn(RotorArray::Constant(4, 500.0), 0.01);
  EXPECT_NEAR(lag.speeds()[0], 500.0 * (1.0 - std::exp(-0.5)), 1e-9);
  lag.turn(RotorArray::Constant(4, 500.0), 0.03);
  EXPECT_NEAR(lag.speeds()[3], 500.0 * (1.0 - std::exp(-2.0)), 1e-9);
  const double before = lag.speeds()[1];
  lag.turn(RotorArray::Zero(4), 0.05);
  EXPECT_NEAR(lag.speeds()[1], before * std::exp(-1.0), 1e-9);
}

TEST(RotorLag, WithoutTimeConstantsIsWhereItIsTold) {
  RotorLag lag(test::vehicleNamed("lifter"));
  RotorArray command(4);
  command << 1.0, 2.0, 3.0, 4.0;
  lag.turn(command, 1e-3);
  EXPECT_TRUE(test::sameBits(lag.speeds(), command));
}

TEST(RotorLag, IsThePlantsOwn) {
  const Vehicle vehicle = test::vehicleNamed("firefly");
  State start;
  start.position.z() = 100.0;
  RigidPlant plant(vehicle, start);
  RotorLag lag(vehicle);
  test::Dice dice(4);
  for (int i = 0; i < 100; ++i) {
    const RotorArray command = dice.speeds(vehicle);
    for (int k = 0; k < 4; ++k) plant.step(command, 1e-3);
    lag.turn(command, 4e-3);
    ASSERT_LT((plant.rotorSpeeds() - lag.speeds()).norm(), 1e-9);
  }
}

}  // namespace
}  // namespace aqc
