#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "adaptive_quadrotor_control/simulation/rigid_plant.h"
#include "support/fixtures.h"

namespace aqc {
namespace {

constexpr double kStep = 1e-3;
constexpr double kFriction = 0.7;

RotorArray off() {
  return RotorArray::Zero(4);
}

void fly(RigidPlant& plant, const RotorArray& command, double duration) {
  for (long i = 0; i < std::lround(duration / kStep); ++i) plant.step(command, kStep);
}

State at(double altitude) {
  State state;
  state.position.z() = altitude;
  return state;
}

State tilted(double altitude, double roll) {
  State state = at(altitude);
  state.attitude = Eigen::AngleAxisd(roll, Eigen::Vector3d::UnitX());
  return state;
}

/// Falls until it crashes or two seconds have gone by.
Crash crashOf(RigidPlant& plant, const RotorArray& command = off()) {
  for (int i = 0; i < 2000 && plant.crash() == Crash::kNone; ++i) plant.step(command, kStep);
  return plant.crash();
}

TEST(PlantContact, StandsStillAtGearHeight) {
  for (const char* name : {"pelican_thesis", "pelican", "hummingbird", "firefly"}) {
    const Vehicle vehicle = test::vehicleNamed(name);
    RigidPlant plant(vehicle, at(vehicle.gear_height));
    fly(plant, RotorArray::Zero(static_cast<Eigen::Index>(vehicle.rotors.size())), 20.0);
    EXPECT_NEAR(plant.state().position.z(), vehicle.gear_height, 1e-9) << name;
    EXPECT_LT(plant.state().position.head<2>().norm(), 1e-9) << name;
    EXPECT_LT(plant.state().velocity.norm(), 1e-9) << name;
    EXPECT_TRUE(plant.touching()) << name;
    EXPECT_EQ(plant.crash(), Crash::kNone) << name;
  }
}

TEST(PlantContact, AccelerometerReadsGravityAtRest) {
  RigidPlant plant(test::pelican(), at(0.1));
  fly(plant, off(), 1.0);
  EXPECT_LT((plant.specificForce() - Eigen::Vector3d(0.0, 0.0, kGravity)).norm(), 1e-6);
}

TEST(PlantContact, SettlesAfterASoftLandingWithoutACrash) {
  const Vehicle vehicle = test::pelican();
  RigidPlant plant(vehicle, at(0.45));  // arrives with 2.6 m/s
  double deepest = 1.0;
  for (int i = 0; i < 5000; ++i) {
    plant.step(off(), kStep);
    deepest = std::min(deepest, plant.state().position.z());
  }
  EXPECT_GT(deepest, 0.0) << "the feet carry it";
  EXPECT_NEAR(plant.state().position.z(), 0.1, 1e-6);
  EXPECT_LT(plant.state().velocity.norm(), 1e-6);
  EXPECT_EQ(plant.crash(), Crash::kNone);
}

TEST(PlantContact, RocksToRestWithTheLeastInertiaThatTheStepAllows) {
  for (const char* name : {"pelican", "pelican_thesis", "hummingbird", "firefly"}) {
    Vehicle vehicle = test::vehicleNamed(name);
    ASSERT_GT(RigidPlant(vehicle, at(0.1)).longestStep(), 2.0 * kStep) << name;
    while (RigidPlant(vehicle, at(0.1)).longestStep() > 1.01 * kStep) vehicle.inertia *= 0.99;
    State start = at(vehicle.gear_height);
    start.body_rate = {0.5, -0.3, 0.2};
    RigidPlant plant(vehicle, start);
    for (int i = 0; i < 3000; ++i) plant.step(off(), kStep);
    EXPECT_LT(plant.state().body_rate.norm(), 1e-6) << name;
    EXPECT_LT(plant.state().velocity.norm(), 1e-6) << name;
    EXPECT_EQ(plant.crash(), Crash::kNone) << name;
  }
}

TEST(PlantContact, StaysOnTheGroundUnderThrustBelowItsWeight) {
  const Vehicle vehicle = test::pelican();
  RigidPlant plant(vehicle, at(0.1));
  fly(plant, 0.9 * test::hoverSpeeds(vehicle, vehicle.mass), 5.0);
  EXPECT_NEAR(plant.state().position.z(), 0.1, 1.1e-3);
  EXPECT_TRUE(plant.touching());
  fly(plant, 1.1 * test::hoverSpeeds(vehicle, vehicle.mass), 1.0);
  EXPECT_GT(plant.state().position.z(), 0.5);
  EXPECT_FALSE(plant.touching());
  EXPECT_EQ(plant.crash(), Crash::kNone);
}

TEST(PlantContact, SlidesToAStop) {
  State start = at(0.1);
  start.velocity.x() = 1.0;
  RigidPlant plant(test::pelican(), start);
  fly(plant, off(), 2.0);
  EXPECT_LT(plant.state().velocity.norm(), 1e-6);
  // Coulomb friction alone needs v^2 / (2 mu g) = 7.3 cm; its viscous part a little more.
  EXPECT_GT(plant.state().position.x(), 0.06);
  EXPECT_LT(plant.state().position.x(), 0.11);
  EXPECT_EQ(plant.crash(), Crash::kNone);
}

TEST(PlantContact, FrictionIsLimitedByTheNormalForce) {
  const Vehicle vehicle = test::pelican();
  const double weight = vehicle.mass * kGravity;
  RigidPlant pushed(vehicle, at(0.1));
  pushed.setDisturbance({{0.9 * kFriction * weight, 0.0, 0.0}, Eigen::Vector3d::Zero()});
  fly(pushed, off(), 1.0);
  EXPECT_LT(pushed.state().velocity.norm(), 0.1) << "no more than a slow creep";
  RigidPlant torn(vehicle, at(0.1));
  torn.setDisturbance({{weight, 0.0, 0.0}, Eigen::Vector3d::Zero()});
  fly(torn, off(), 0.5);
  EXPECT_NEAR(torn.state().velocity.x(), (1.0 - kFriction) * kGravity * 0.5, 0.1);
}

TEST(PlantContact, AFallFromAMetreIsAHardImpact) {
  RigidPlant plant(test::pelican(), at(1.0));
  EXPECT_EQ(crashOf(plant), Crash::kHardImpact);
  EXPECT_STREQ(toString(plant.crash()), "hard impact");
}

// The foot in front comes down faster or slower than the vehicle, as that pitches.
TEST(PlantContact, AnImpactIsThatOfTheFoot) {
  for (const bool down : {true, false}) {
    State start = tilted(0.0, 0.0);
    const Vehicle vehicle = test::pelican();
    const double pitch = 0.2;
    start.attitude = Eigen::AngleAxisd(pitch, Eigen::Vector3d::UnitY());
    double front = 0.0;
    for (const Eigen::Vector2d& foot : vehicle.feet()) front = std::max(front, foot.x());
    start.position.z() = vehicle.gear_height * std::cos(pitch) + front * std::sin(pitch);
    start.velocity.z() = -2.6;
    start.body_rate.y() = down ? 8.0 : -8.0;
    RigidPlant plant(vehicle, start);
    plant.step(off(), 1e-6);
    ASSERT_TRUE(plant.touching());
    EXPECT_EQ(plant.crash() == Crash::kHardImpact, down);
  }
}

TEST(PlantContact, ARotorOnTheGroundIsARotorStrike) {
  RigidPlant plant(test::pelican(), tilted(0.2, 1.2));
  EXPECT_EQ(crashOf(plant), Crash::kRotorStrike);
  EXPECT_STREQ(toString(plant.crash()), "rotor strike");
}

TEST(PlantContact, TouchingWhileTiltedIsACrash) {
  RigidPlant plant(test::pelican(), tilted(0.26, 0.9));
  Payload deep = test::box(0.5);
  deep.offset.z() = -0.25;
  plant.attach(deep);
  EXPECT_EQ(crashOf(plant), Crash::kTiltedContact);
  EXPECT_STREQ(toString(plant.crash()), "tilted contact");
}

TEST(PlantContact, ASlightlyTiltedSoftTouchIsNoCrash) {
  RigidPlant plant(test::pelican(), tilted(0.17, 0.3));
  fly(plant, off(), 2.0);
  EXPECT_EQ(plant.crash(), Crash::kNone);
  EXPECT_TRUE(plant.touching());
}

TEST(PlantContact, APayloadDraggedOverTheGroundTopplesTheVehicle) {
  const Vehicle vehicle = test::pelican();
  const RotorArray command = test::hoverSpeeds(vehicle, 2.45);
  for (const bool low : {true, false}) {
    State start = at(low ? 0.2 : 2.0);
    start.velocity.x() = 3.0;
    RigidPlant plant(vehicle, start);
    plant.attach(test::box(0.5), start.velocity);
    bool touched = false;
    for (int i = 0; i < 800; ++i) {
      plant.step(command, kStep);
      touched = touched || plant.touching();
    }
    EXPECT_EQ(touched, low);
    EXPECT_EQ(plant.crash() != Crash::kNone, low) << toString(plant.crash());
  }
}

TEST(PlantContact, FlyingIntoAWallIsAWallStrike) {
  const Box wall{{2.0, -1.0, 0.0}, {2.5, 1.0, 5.0}};
  for (const double y : {0.0, 1.5}) {
    State start = at(3.0);
    start.position.y() = y;
    start.velocity.x() = 6.0;
    RigidPlant plant(test::pelican(), start, {wall});
    int steps = 0;
    const RotorArray hover = test::hoverSpeeds(test::pelican(), 1.0);
    for (; steps < 600 && plant.crash() == Crash::kNone; ++steps) plant.step(hover, kStep);
    EXPECT_EQ(plant.crash() == Crash::kWallStrike, y == 0.0) << toString(plant.crash());
    EXPECT_GT(plant.state().position.x(), 1.5);
  }
}

TEST(PlantContact, RotorsRunDownAfterACrash) {
  const Vehicle vehicle = test::pelican();
  RigidPlant plant(vehicle, tilted(0.2, 1.2));
  const RotorArray hover = test::hoverSpeeds(vehicle, vehicle.mass);
  ASSERT_NE(crashOf(plant, hover), Crash::kNone);
  const double speed = plant.rotorSpeeds()[0];
  ASSERT_GT(speed, 1.0);
  fly(plant, hover, 0.05);
  EXPECT_NEAR(plant.rotorSpeeds()[0], speed * std::exp(-0.05 / vehicle.time_constant_down),
              1e-6 * speed);
}

TEST(PlantContact, TheFirstCrashIsKeptAndTheWreckComesToRest) {
  RigidPlant plant(test::pelican(), at(1.5));
  ASSERT_EQ(crashOf(plant), Crash::kHardImpact);
  fly(plant, off(), 10.0);
  EXPECT_EQ(plant.crash(), Crash::kHardImpact);
  EXPECT_TRUE(plant.state().valid());
  EXPECT_LT(plant.state().velocity.norm(), 0.01);
  EXPECT_GT(plant.state().position.z(), 0.0);
}

TEST(PlantContact, NothingTouchesInTheAir) {
  const Vehicle vehicle = test::pelican();
  RigidPlant plant(vehicle, at(0.102));
  plant.step(off(), 1e-6);
  EXPECT_FALSE(plant.touching());
  RigidPlant standing(vehicle, at(0.0999));
  standing.step(off(), 1e-6);
  EXPECT_TRUE(standing.touching());
}

}  // namespace
}  // namespace aqc
