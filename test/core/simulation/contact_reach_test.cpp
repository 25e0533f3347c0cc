#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <vector>

#include "adaptive_quadrotor_control/simulation/rigid_plant.h"
#include "adaptive_quadrotor_control/simulation/timed_plant.h"
#include "support/fixtures.h"

// When contact is looked for at all, and how stiff it is.
namespace aqc {
namespace {

constexpr double kStep = 1e-3;

RotorArray off() {
  return RotorArray::Zero(4);
}

State at(double altitude) {
  State state;
  state.position.z() = altitude;
  return state;
}

/// As heavy as the vehicle and 1.2 m high: its centre is 0.3 m above the origin of B, its lower
/// corners 0.3 m below, and the common centre of mass 0.15 m above.
Payload tower() {
  Payload payload = test::box(test::pelican().mass);
  payload.size = {0.01, 0.01, 1.2};
  payload.offset = {0.0, 0.0, 0.3};
  payload.inertia = boxInertia(payload.mass, payload.size);
  return payload;
}

TEST(ContactReach, IsThatOfTheFarthestPoint) {
  RigidPlant plant(test::pelican(), at(0.1));
  Payload small = test::box(0.1, 0.01);
  small.offset.setZero();
  plant.attach(small);
  for (int i = 0; i < 1000; ++i) plant.step(off(), kStep);
  EXPECT_TRUE(plant.touching());
  EXPECT_NEAR(plant.state().position.z(), 0.1, 1e-3) << "stands on its feet";
}

TEST(ContactReach, CountsFromTheOriginNotTheCentreOfMass) {
  RigidPlant plant(test::pelican(), at(0.2999));
  plant.attach(tower());
  ASSERT_NEAR(plant.centreOfMass().z(), 0.15, 1e-12);
  plant.step(off(), 1e-6);
  EXPECT_TRUE(plant.touching());
}

TEST(ContactReach, SeesAFastStrikeInItsStep) {
  State start = at(0.34);
  start.velocity.z() = -60.0;
  RigidPlant plant(test::pelican(), start);
  plant.attach(tower(), start.velocity);
  plant.step(off(), kStep);
  ASSERT_LT(plant.state().position.z(), 0.3);
  EXPECT_EQ(plant.crash(), Crash::kHardImpact);
}

// Four springs carry the vehicle 1 mm deep and let it bounce with half the critical damping; RK4
// lets it rock on them with a step of 2.5 / (sqrt(k r^2 / J) + d (r^2 + h^2) / J), where r^2 sums
// over the feet.
TEST(ContactReach, LongestStepInClosedForm) {
  const Vehicle vehicle = test::pelican();
  const double k = vehicle.mass * kGravity / 4e-3;
  const double d = std::sqrt(k * vehicle.mass / 4.0);
  const double r = 2.0 * vehicle.gear_radius * vehicle.gear_radius;
  const double h = 4.0 * vehicle.gear_height * vehicle.gear_height;
  const double J = vehicle.inertia.diagonal().minCoeff();
  EXPECT_NEAR(RigidPlant(vehicle, at(0.1)).longestStep(),
              2.5 / (std::sqrt(k * r / J) + d * (r + h) / J), 1e-12);
  EXPECT_TRUE(std::isinf(RigidPlant(vehicle, at(0.1), {}, false).longestStep()));
}

TimedPlant plantWith(const std::vector<Cargo>& cargo, double altitude) {
  return TimedPlant(std::make_unique<RigidPlant>(test::pelican(), at(altitude)), cargo, 1'000'000);
}

Cargo lying(const std::string& name, double x) {
  return {name, test::box(0.5), {x, 0.0, 0.05}, Eigen::Vector3d::Zero()};
}

TEST(Reach, IsHalfAMetre) {
  // Under the vehicle the boxes would hang where they lie, but for x.
  const TimedPlant plant = plantWith({lying("near", 0.49), lying("far", 0.6)}, 0.2);
  EXPECT_EQ(plant.obstacle({"near", {}}), "");
  EXPECT_EQ(plant.obstacle({"far", {}}), "far is 0.60 m away; it can be picked up within 0.50 m");
}

TEST(Reach, KnowsWhatLiesAndWhatHangs) {
  TimedPlant plant = plantWith({lying("box", 0.0)}, 10.0);
  EXPECT_TRUE(plant.knows("box"));
  EXPECT_FALSE(plant.knows("crate"));
  EXPECT_FALSE(plant.knows(""));
  plant.schedule({0, AttachPayload{"crate", test::box(0.5)}});
  plant.advance(off(), 1'000'000);
  EXPECT_TRUE(plant.knows("box"));
  EXPECT_TRUE(plant.knows("crate"));
  EXPECT_FALSE(plant.knows("rod"));
}

TEST(DroppedCargo, FallsAsAStoneDoes) {
  Cargo cargo = lying("box", 0.0);
  cargo.position.z() = 10.0;
  cargo.fall(1.0, true);
  EXPECT_NEAR(cargo.position.z(), 10.0 - 0.5 * kGravity, 1e-9);
  EXPECT_NEAR(cargo.velocity.z(), -kGravity, 1e-9);
}

TEST(DroppedCargo, LiesOnItsLowerFace) {
  Cargo cargo = lying("box", 0.0);
  cargo.position.z() = 1.0;
  cargo.velocity.x() = 2.0;
  double time = 0.0;
  for (; cargo.velocity.x() > 0.0 && time < 2.0; time += kStep) cargo.fall(kStep, true);
  EXPECT_NEAR(time, std::sqrt(2.0 * 0.95 / kGravity), kStep);
  EXPECT_NEAR(cargo.position.x(), 2.0 * time, 1e-9);
  EXPECT_EQ(cargo.position.z(), 0.05);
  EXPECT_EQ(cargo.velocity.norm(), 0.0);
}

}  // namespace
}  // namespace aqc
