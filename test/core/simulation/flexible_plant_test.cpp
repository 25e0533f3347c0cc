#include "adaptive_quadrotor_control/simulation/flexible_plant.h"

#include <gtest/gtest.h>

#include <stdexcept>

#include "support/fixtures.h"

namespace aqc {
namespace {

Payload onCable(double mass, double length) {
  Payload payload = test::box(mass);
  payload.offset.setZero();
  payload.mount = Cable{length};
  return payload;
}

Payload onJoint(double mass, double frequency, double damping) {
  Payload payload = test::box(mass);
  payload.mount = Joint{frequency, damping};
  return payload;
}

State high() {
  State state;
  state.position.z() = 50.0;
  return state;
}

TEST(FlexiblePlant, IsTheRigidPlantToTheLastBitWithoutAndAfterAHangingLoad) {
  const Vehicle vehicle = test::pelican();
  test::Dice dice(1);
  const State start = dice.airborneState();
  RigidPlant rigid(vehicle, start);
  FlexiblePlant flexible(vehicle, start);
  const Payload fixed = dice.payload();
  const auto fly = [&](int steps) {
    for (int i = 0; i < steps; ++i) {
      const RotorArray command = dice.speeds(vehicle);
      rigid.step(command, 1e-3);
      flexible.step(command, 1e-3);
    }
    EXPECT_TRUE(test::sameBits(rigid.state(), flexible.state()));
    EXPECT_TRUE(test::sameBits(rigid.specificForce(), flexible.specificForce()));
  };
  fly(50);
  rigid.attach(fixed);
  flexible.attach(fixed);
  fly(50);
  rigid.detach();
  flexible.detach();
  for (const Payload& load : {onCable(0.4, 1.0), onJoint(0.4, 9.0, 0.1)}) {
    flexible.attach(load);
    EXPECT_EQ(flexible.payloadMass(), 0.4);
    flexible.detach();
    EXPECT_EQ(flexible.payloadMass(), 0.0);
    fly(50);
  }
}

TEST(FlexiblePlant, CarriesOneAtATimeAndTheRigidPlantNoneOfThese) {
  FlexiblePlant plant(test::pelican(), high());
  EXPECT_THROW(plant.detach(), std::logic_error);
  for (const Payload& load : {onCable(0.4, 1.0), onJoint(0.4, 9.0, 0.1), test::box(0.4)}) {
    plant.attach(load);
    EXPECT_THROW(plant.attach(onCable(0.4, 1.0)), std::logic_error);
    EXPECT_THROW(plant.attach(onJoint(0.4, 9.0, 0.1)), std::logic_error);
    EXPECT_THROW(plant.attach(test::box(0.4)), std::logic_error);
    EXPECT_THROW(plant.pickUp(onCable(0.4, 1.0), FreeMotion()), std::logic_error);
    plant.detach();
  }
  RigidPlant rigid(test::pelican(), high());
  EXPECT_THROW(rigid.attach(onCable(0.4, 1.0)), std::invalid_argument);
}

TEST(FlexiblePlant, DetachedLoadsGoOnAsTheyMoved) {
  for (const Payload& load : {onCable(0.4, 1.0), onJoint(0.4, 9.0, 0.1)}) {
    FlexiblePlant plant(test::pelican(), high());
    plant.attach(load, {1.0, 0.0, 0.0});
    for (int i = 0; i < 100; ++i) plant.step(RotorArray::Zero(4), 1e-3);
    const FreeMotion moved = plant.payloadMotion();
    const Eigen::Vector3d before = plant.linearMomentum();
    const FreeMotion freed = plant.detach();
    EXPECT_EQ((freed.position - moved.position).norm(), 0.0);
    EXPECT_LT((before - plant.linearMomentum() - 0.4 * freed.velocity).norm(), 1e-12);
  }
}

// In vacuum only gravity acts on the whole, whatever happens inside: tumbling, snatches, slack.
TEST(FlexiblePlant, KeepsMomentumInFreeFall) {
  Vehicle vehicle = test::pelican();
  test::Dice dice(2);
  for (int i = 0; i < 6; ++i) {
    Payload load = i % 2 == 0 ? onCable(0.4, 0.7) : onJoint(0.4, dice.between(2.0, 30.0), 0.1);
    load.offset += dice.vector(0.05);
    FlexiblePlant plant(vehicle, dice.airborneState(), {}, false);
    plant.attach(load, dice.vector(2.0));
    const Eigen::Vector3d origin = Eigen::Vector3d::Zero();
    const Eigen::Vector3d linear = plant.linearMomentum();
    const auto spin = [&]() -> Eigen::Vector3d {
      const double mass = vehicle.mass + 0.4;
      const Eigen::Vector3d centre =
          (vehicle.mass * plant.state().position + 0.4 * plant.payloadMotion().position) / mass;
      return plant.angularMomentum(origin) - centre.cross(plant.linearMomentum());
    };
    const Eigen::Vector3d spin_at_start = spin();
    for (int step = 0; step < 1000; ++step) plant.step(RotorArray::Zero(4), 1e-3);
    const Eigen::Vector3d fall(0.0, 0.0, -kGravity * (vehicle.mass + 0.4));
    EXPECT_LT((plant.linearMomentum() - linear - fall).norm(), 1e-9) << i;
    EXPECT_LT((spin() - spin_at_start).norm(), 1e-5 * spin_at_start.norm()) << i;
  }
}

// A turn of everything about the vertical turns the motion and changes nothing else.
TEST(FlexiblePlant, KnowsNoNorth) {
  const Vehicle vehicle = test::pelican();
  for (const Payload& load : {onCable(0.4, 1.0), onJoint(0.4, 5.0, 0.1)}) {
    const auto flown = [&](double yaw) {
      const Eigen::Quaterniond turn(Eigen::AngleAxisd(yaw, Eigen::Vector3d::UnitZ()));
      State start = high();
      start.attitude = turn * Eigen::AngleAxisd(0.2, Eigen::Vector3d::UnitX());
      FlexiblePlant plant(vehicle, start);
      plant.attach(load, turn * Eigen::Vector3d(0.5, 0.3, 0.0));
      for (int i = 0; i < 500; ++i) plant.step(test::hoverSpeeds(vehicle, 2.4), 1e-3);
      return Eigen::Vector3d(turn.conjugate() * plant.payloadMotion().position);
    };
    EXPECT_LT((flown(0.0) - flown(1.1)).norm(), 1e-9);
  }
}

TEST(FlexiblePlant, AbsurdMotionIsACrashAndStaysFinite) {
  for (const Payload& load : {onCable(0.4, 1.0), onJoint(0.4, 200.0, 0.1)}) {
    FlexiblePlant plant(test::pelican(), high());
    plant.attach(load, {9e3, 0.0, 0.0});
    plant.setDisturbance({{1e9, 0.0, 0.0}, {0.0, 1e6, 0.0}});
    for (int i = 0; i < 100; ++i) plant.step(RotorArray::Zero(4), 1e-3);
    EXPECT_EQ(plant.crash(), Crash::kDiverged);
    EXPECT_TRUE(plant.state().valid());
    EXPECT_TRUE(plant.payloadMotion().position.allFinite());
  }
}

}  // namespace
}  // namespace aqc
