#include <gtest/gtest.h>

#include <stdexcept>

#include "adaptive_quadrotor_control/simulation/rigid_plant.h"
#include "support/fixtures.h"

namespace aqc {
namespace {

struct Momentum {
  Eigen::Vector3d linear;
  Eigen::Vector3d angular;  // about the origin of W
};

/// Of two bodies that move together, added up one by one.
Momentum momentumOf(const Vehicle& vehicle, const Payload* payload, const State& state) {
  const Eigen::Matrix3d R = state.attitude.toRotationMatrix();
  Momentum sum;
  sum.linear = vehicle.mass * state.velocity;
  sum.angular = state.position.cross(sum.linear) + R * vehicle.inertia * state.body_rate;
  if (payload != nullptr) {
    const Eigen::Vector3d where = state.position + R * payload->offset;
    const Eigen::Vector3d speed = state.velocity + R * state.body_rate.cross(payload->offset);
    sum.linear += payload->mass * speed;
    sum.angular += where.cross(payload->mass * speed) + R * payload->inertia * state.body_rate;
  }
  return sum;
}

TEST(PlantPayload, MassCentreAndInertiaFollowFromParallelAxes) {
  const Vehicle vehicle = test::pelican();
  test::Dice dice(1);
  for (int i = 0; i < 50; ++i) {
    const Payload payload = dice.payload();
    RigidPlant plant(vehicle, dice.airborneState());
    plant.attach(payload);
    const double mass = vehicle.mass + payload.mass;
    const Eigen::Vector3d centre = payload.mass * payload.offset / mass;
    const auto shift = [](double m, const Eigen::Vector3d& d) -> Eigen::Matrix3d {
      Eigen::Matrix3d cross;
      cross << 0.0, -d.z(), d.y(), d.z(), 0.0, -d.x(), -d.y(), d.x(), 0.0;
      return -m * cross * cross;
    };
    // About the origin of B first, then back to the common centre of mass.
    const Eigen::Matrix3d inertia = vehicle.inertia + payload.inertia +
                                    shift(payload.mass, payload.offset) - shift(mass, centre);
    EXPECT_NEAR(plant.mass(), mass, 1e-12);
    EXPECT_LT((plant.centreOfMass() - centre).norm(), 1e-12);
    EXPECT_LT((plant.inertia() - inertia).norm(), 1e-12);
  }
}

TEST(PlantPayload, HangingBoxWorkedByHand) {
  // 2 kg and 0.5 kg at z = -0.15: the centre lies at -0.03. Both about it:
  // 2 * 0.03^2 + 0.5 * 0.12^2 = 0.009, and the box itself 0.5 (0.01 + 0.01) / 12 = 1/1200.
  RigidPlant plant(test::pelican(), State());
  plant.attach(test::box(0.5));
  EXPECT_NEAR(plant.mass(), 2.5, 1e-15);
  EXPECT_NEAR(plant.centreOfMass().z(), -0.03, 1e-15);
  EXPECT_NEAR(plant.inertia()(0, 0), 0.01 + 0.009 + 1.0 / 1200.0, 1e-15);
  EXPECT_NEAR(plant.inertia()(1, 1), 0.01 + 0.009 + 1.0 / 1200.0, 1e-15);
  EXPECT_NEAR(plant.inertia()(2, 2), 0.02 + 1.0 / 1200.0, 1e-15);
}

TEST(PlantPayload, AttachingKeepsMomentumOfVehicleAndRestingPayload) {
  const Vehicle vehicle = test::pelican();
  test::Dice dice(2);
  for (int i = 0; i < 50; ++i) {
    const Payload payload = dice.payload();
    const State start = dice.airborneState();
    RigidPlant plant(vehicle, start);
    plant.attach(payload);
    const Momentum before = momentumOf(vehicle, nullptr, start);
    const Momentum after = momentumOf(vehicle, &payload, plant.state());
    EXPECT_LT((after.linear - before.linear).norm(), 1e-12 * before.linear.norm());
    EXPECT_LT((after.angular - before.angular).norm(), 1e-11 * before.angular.norm());
    EXPECT_LT((plant.state().position - start.position).norm(), 1e-12);
    EXPECT_LT(test::angleBetween(plant.state().attitude, start.attitude), 1e-7);
    EXPECT_LT((plant.linearMomentum() - before.linear).norm(), 1e-11);
    EXPECT_LT((plant.angularMomentum(Eigen::Vector3d::Zero()) - before.angular).norm(), 1e-9);
  }
}

TEST(PlantPayload, AttachingAPayloadThatMovesAlongChangesNothing) {
  const Vehicle vehicle = test::pelican();
  State start;
  start.position.z() = 50.0;
  start.velocity = {3.0, -1.0, 2.0};
  RigidPlant plant(vehicle, start);
  plant.attach(test::box(0.5), start.velocity);
  EXPECT_LT((plant.state().velocity - start.velocity).norm(), 1e-12);
  EXPECT_LT(plant.state().body_rate.norm(), 1e-12);
}

TEST(PlantPayload, AngularMomentumRefersToTheGivenPoint) {
  test::Dice dice(3);
  RigidPlant plant(test::pelican(), dice.airborneState());
  plant.attach(dice.payload());
  const Eigen::Vector3d point = dice.vector(10.0);
  const Eigen::Vector3d shifted =
      plant.angularMomentum(Eigen::Vector3d::Zero()) - point.cross(plant.linearMomentum());
  EXPECT_LT((plant.angularMomentum(point) - shifted).norm(), 1e-9);
}

TEST(PlantPayload, DetachingLeavesTheVehiclesMotionAlone) {
  const Vehicle vehicle = test::pelican();
  test::Dice dice(4);
  for (int i = 0; i < 20; ++i) {
    RigidPlant plant(vehicle, dice.airborneState());
    plant.attach(dice.payload());
    for (int step = 0; step < 20; ++step) plant.step(dice.speeds(vehicle), 1e-3);
    const State before = plant.state();
    plant.detach();
    EXPECT_TRUE(test::sameBits(plant.state(), before));
    EXPECT_EQ(plant.mass(), vehicle.mass);
    EXPECT_EQ(plant.centreOfMass().norm(), 0.0);
    EXPECT_TRUE(plant.inertia().isApprox(vehicle.inertia, 1e-15));
    EXPECT_FALSE(plant.payload().has_value());
  }
}

TEST(PlantPayload, FliesLikeAFreshVehicleAfterDetaching) {
  const Vehicle vehicle = test::pelican();
  const RotorArray hover = test::hoverSpeeds(vehicle, vehicle.mass);
  State start;
  start.position.z() = 50.0;
  RigidPlant plant(vehicle, start);
  plant.attach(test::box(0.7));
  plant.detach();
  RigidPlant fresh(vehicle, start);
  for (int i = 0; i < 300; ++i) {
    plant.step(hover, 1e-3);
    fresh.step(hover, 1e-3);
  }
  EXPECT_TRUE(test::sameBits(plant.state(), fresh.state()));
}

TEST(PlantPayload, TumblesTogetherKeepingItsMomentum) {
  const Vehicle vehicle = test::pelican();
  test::Dice dice(5);
  const Payload payload = dice.payload();
  State start = dice.airborneState();
  start.position.z() = 1000.0;
  RigidPlant plant(vehicle, start);
  plant.attach(payload);
  const auto spin = [&]() -> Eigen::Vector3d {
    return plant.angularMomentum(plant.state().position +
                                 plant.state().attitude * plant.centreOfMass());
  };
  const Eigen::Vector3d spin_at_start = spin();
  const Eigen::Vector3d linear_at_start = plant.linearMomentum();
  for (int i = 0; i < 2000; ++i) plant.step(RotorArray::Zero(4), 1e-3);
  EXPECT_LT((spin() - spin_at_start).norm(), 1e-8 * spin_at_start.norm());
  const Eigen::Vector3d fall(0.0, 0.0, -2.0 * kGravity * plant.mass());
  EXPECT_LT((plant.linearMomentum() - linear_at_start - fall).norm(), 1e-8);
}

TEST(PlantPayload, OnlyOneAtATime) {
  RigidPlant plant(test::pelican(), State());
  EXPECT_THROW(plant.detach(), std::logic_error);
  plant.attach(test::box(0.5));
  EXPECT_THROW(plant.attach(test::box(0.5)), std::logic_error);
  plant.detach();
  EXPECT_THROW(plant.detach(), std::logic_error);
}

TEST(BoxInertia, MatchesTheFormulaOfASolidBox) {
  const Eigen::Matrix3d inertia = boxInertia(12.0, {1.0, 2.0, 3.0});
  EXPECT_LT((inertia.diagonal() - Eigen::Vector3d(13.0, 10.0, 5.0)).norm(), 1e-15);
  EXPECT_EQ(inertia(0, 1), 0.0);
}

}  // namespace
}  // namespace aqc
