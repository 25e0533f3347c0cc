#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "adaptive_quadrotor_control/simulation/flexible_plant.h"
#include "support/fixtures.h"

namespace aqc {
namespace {

Vehicle smooth() {
  Vehicle vehicle = test::vehicleNamed("pelican");
  vehicle.drag_coefficient = vehicle.rolling_moment_coefficient = 0.0;
  return vehicle;
}

Payload onJoint(double frequency, double damping) {
  Payload payload = test::box(0.4);
  payload.offset.x() = 0.03;
  payload.mount = Joint{frequency, damping};
  return payload;
}

State high() {
  State state;
  state.position.z() = 500.0;
  return state;
}

/// Where the load is against its place, in B [m].
Eigen::Vector3d displacement(const FlexiblePlant& plant) {
  const State state = plant.state();
  return state.attitude.conjugate() * (plant.payloadMotion().position - state.position) -
         plant.payload()->offset;
}

// Pushed a little in free fall, each direction is A exp(-d w t) sin(w sqrt(1 - d^2) t).
TEST(JointLoad, SwingsFreelyWithTheFrequencyAndDampingThatItSays) {
  const Vehicle vehicle = smooth();
  for (const double frequency : {1.0, 9.0, 40.0}) {
    for (const double damping : {0.0, 0.1, 0.3}) {
      for (int axis = 0; axis < 3; ++axis) {
        FlexiblePlant plant(vehicle, high());
        const double speed = 1e-4;
        plant.attach(onJoint(frequency, damping), speed * Eigen::Vector3d::Unit(axis));
        const double omega = 2.0 * M_PI * frequency;
        const double swinging = omega * std::sqrt(1.0 - damping * damping);
        const double step = 0.25e-1 / frequency;
        for (int i = 1; i <= 60; ++i) {
          for (int part = 0; part < 10; ++part) plant.step(RotorArray::Zero(4), 0.1 * step);
          const double time = i * step;
          const double expected =
              speed / swinging * std::exp(-damping * omega * time) * std::sin(swinging * time);
          ASSERT_NEAR(displacement(plant)[axis], expected, 2e-3 * speed / swinging)
              << frequency << " Hz, " << damping << ", axis " << axis;
        }
      }
    }
  }
}

TEST(JointLoad, KeepsItsEnergyWithoutADamperAndLosesSomeWithOne) {
  const Vehicle vehicle = smooth();
  for (const double damping : {0.0, 0.1}) {
    State start = high();
    start.body_rate = {1.0, -0.5, 2.0};
    FlexiblePlant plant(vehicle, start, {}, false);
    plant.attach(onJoint(5.0, damping), {0.5, 0.2, 0.3});
    const double height = kGravity * 500.0 * 1.4;
    const double energy = plant.energy() - height;
    for (int i = 0; i < 2000; ++i) plant.step(RotorArray::Zero(4), 1e-3);
    if (damping == 0.0) {
      EXPECT_NEAR(plant.energy() - height, energy, 1e-3);
    } else {
      EXPECT_LT(plant.energy() - height, energy - 0.01);
    }
  }
}

TEST(JointLoad, AStiffOneIsAsGoodAsRigid) {
  const Vehicle vehicle = test::vehicleNamed("pelican");
  test::Dice dice(3);
  Payload fixed = onJoint(1.0, 0.0);
  fixed.mount = RigidMount();
  FlexiblePlant rigid(vehicle, high());
  rigid.attach(fixed);
  const RotorArray command = test::hoverSpeeds(vehicle, 1.4);
  for (int i = 0; i < 500; ++i) rigid.step(command, 1e-3);
  double last = 1.0;
  for (const double frequency : {25.0, 50.0, 100.0, 200.0}) {
    FlexiblePlant joint(vehicle, high());
    joint.attach(onJoint(frequency, 1.0));
    for (int i = 0; i < 500; ++i) joint.step(command, 1e-3);
    const double far = (joint.state().position - rigid.state().position).norm() +
                       joint.state().attitude.angularDistance(rigid.state().attitude);
    EXPECT_LT(far, 0.7 * last) << frequency;
    last = far;
  }
  EXPECT_LT(last, 5e-3);
}

TEST(JointLoad, StandsOnTheGround) {
  State start;
  start.position.z() = 0.25;
  Payload load = onJoint(20.0, 0.5);
  load.offset = {0.0, 0.0, -0.05};
  FlexiblePlant plant(test::vehicleNamed("pelican"), start);
  plant.attach(load);
  for (int i = 0; i < 3000; ++i) plant.step(RotorArray::Zero(4), 1e-3);
  EXPECT_TRUE(plant.touching());
  EXPECT_LT(plant.state().velocity.norm(), 1e-3);
  EXPECT_LT(plant.payloadMotion().velocity.norm(), 1e-3);
}

}  // namespace
}  // namespace aqc
