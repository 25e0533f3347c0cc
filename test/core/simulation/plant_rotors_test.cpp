#include <gtest/gtest.h>

#include <cmath>

#include "adaptive_quadrotor_control/simulation/rigid_plant.h"
#include "support/fixtures.h"

namespace aqc {
namespace {

constexpr double kStep = 1e-3;

/// A vehicle high up, level and so heavy to turn that it stays level, whose rotors turn at
/// `speed` [rad/s] from the first step on.
class PlantRotors : public testing::Test {
 protected:
  PlantRotors() : vehicle_(heavyToTurn()), plant_(vehicle_, highUp()) {}

  static Vehicle heavyToTurn() {
    Vehicle vehicle = test::pelican();
    vehicle.inertia *= 1e9;
    return vehicle;
  }
  static State highUp() {
    State state;
    state.position.z() = 1000.0;
    return state;
  }
  void fly(const RotorArray& command, double duration) {
    const auto steps = std::lround(duration / kStep);
    for (long i = 0; i < steps; ++i) plant_.step(command, kStep);
  }
  // The moment that changed the body rate over the last `duration` [N m].
  Eigen::Vector3d moment(const Eigen::Vector3d& rate_before, double duration) const {
    return vehicle_.inertia * (plant_.state().body_rate - rate_before) / duration;
  }

  const Vehicle vehicle_;
  RigidPlant plant_;
};

TEST_F(PlantRotors, OneOfEffectivenessEGivesThatShareOfThrustAndDragMoment) {
  const double speed = 600.0;
  for (const double share : {0.0, 0.35, 1.0}) {
    plant_.setRotor(1, {share, std::nullopt, 1.0});
    fly(RotorArray::Constant(4, speed), 1.0);  // far beyond the time constants
    const Eigen::Vector3d rate = plant_.state().body_rate;
    fly(RotorArray::Constant(4, speed), kStep);
    const double thrust = vehicle_.force_constant * speed * speed;
    // Level and without wind, the accelerometer reads the thrust alone.
    EXPECT_NEAR(plant_.specificForce().z(), (3.0 + share) * thrust / vehicle_.mass, 1e-6) << share;
    const Eigen::Vector3d moment = this->moment(rate, kStep);
    // Rotor 2 stands on the left (+y) and turns counter-clockwise: what it lacks rolls and yaws.
    EXPECT_NEAR(moment.x(), (share - 1.0) * thrust * 0.21, 2e-3) << share;
    EXPECT_NEAR(moment.y(), 0.0, 2e-3) << share;
    EXPECT_NEAR(moment.z(), (1.0 - share) * vehicle_.moment_constant * thrust, 2e-3) << share;
    EXPECT_NEAR(plant_.rotorSpeeds()[1], speed, 1e-9) << "it turns as the others do";
  }
}

TEST_F(PlantRotors, AStuckOneTurnsAtOneSpeedWhateverIsCommanded) {
  fly(RotorArray::Constant(4, 500.0), 0.1);
  plant_.setRotor(2, {1.0, 321.0, 1.0});
  for (const double command : {0.0, 500.0, 1e9}) {
    fly(RotorArray::Constant(4, command), 0.02);
    EXPECT_EQ(plant_.rotorSpeeds()[2], 321.0) << command;
  }
  plant_.setRotor(2, {1.0, 1e9, 1.0});
  fly(RotorArray::Zero(4), kStep);
  EXPECT_EQ(plant_.rotorSpeeds()[2], vehicle_.max_rotor_speed) << "clamped";
  plant_.setRotor(2, {});
  fly(RotorArray::Constant(4, 400.0), 1.0);
  EXPECT_NEAR(plant_.rotorSpeeds()[2], 400.0, 1e-9) << "sound again";
}

TEST_F(PlantRotors, ASlowOneRespondsToAStepWithItsLongerTimeConstants) {
  plant_.setRotor(0, {1.0, std::nullopt, 3.0});
  fly(RotorArray::Constant(4, 800.0), 0.02);
  const double up = 800.0 * (1.0 - std::exp(-0.02 / (3.0 * vehicle_.time_constant_up)));
  EXPECT_NEAR(plant_.rotorSpeeds()[0], up, 1e-9);
  EXPECT_NEAR(plant_.rotorSpeeds()[1], 800.0 * (1.0 - std::exp(-0.02 / vehicle_.time_constant_up)),
              1e-9);
  fly(RotorArray::Zero(4), 0.03);
  EXPECT_NEAR(plant_.rotorSpeeds()[0], up * std::exp(-0.03 / (3.0 * vehicle_.time_constant_down)),
              1e-9);
}

TEST_F(PlantRotors, ReachTheShareOfTheirSpeedThatTheBatteryAllows) {
  const double most = vehicle_.max_rotor_speed;
  fly(RotorArray::Constant(4, most), 1.0);
  plant_.setSpeedLimit(0.85);
  fly(RotorArray::Constant(4, most), 0.03);
  const double sinking = (0.85 + 0.15 * std::exp(-0.03 / vehicle_.time_constant_down)) * most;
  EXPECT_NEAR(plant_.rotorSpeeds()[0], sinking, 1e-9) << "with its lag";
  fly(RotorArray::Constant(4, 0.5 * most), 1.0);
  EXPECT_NEAR(plant_.rotorSpeeds()[0], 0.5 * most, 1e-9) << "what can be reached is";
  fly(RotorArray::Constant(4, most), 1.0);
  EXPECT_NEAR(plant_.rotorSpeeds()[0], 0.85 * most, 1e-9);
  plant_.setRotor(0, {1.0, std::nullopt, 2.0});
  fly(RotorArray::Constant(4, most), 1.0);
  EXPECT_NEAR(plant_.rotorSpeeds()[0], 0.85 * most, 1e-9) << "a slow one, too";
  plant_.setSpeedLimit(1.0);
  fly(RotorArray::Constant(4, most), 1.0);
  EXPECT_NEAR(plant_.rotorSpeeds()[0], most, 1e-6);
}

TEST_F(PlantRotors, RunDownAfterACrashEvenWhenStuck) {
  State low = highUp();
  low.position.z() = 1.0;
  low.velocity.z() = -10.0;
  RigidPlant plant(vehicle_, low);
  plant.setRotor(0, {1.0, 700.0, 1.0});
  for (int i = 0; i < 1000; ++i) plant.step(RotorArray::Constant(4, 700.0), kStep);
  ASSERT_NE(plant.crash(), Crash::kNone);
  EXPECT_LT(plant.rotorSpeeds().maxCoeff(), 1e-6);
}

TEST_F(PlantRotors, KeepTheirConditionWhenTheMassChanges) {
  plant_.setRotor(1, {0.0, std::nullopt, 1.0});
  plant_.attach(test::box(0.5));
  fly(RotorArray::Constant(4, 600.0), 0.5);
  const Eigen::Vector3d rate = plant_.state().body_rate;
  fly(RotorArray::Constant(4, 600.0), kStep);
  EXPECT_NEAR(moment(rate, kStep).x(), -vehicle_.force_constant * 600.0 * 600.0 * 0.21, 2e-3);
}

}  // namespace
}  // namespace aqc
