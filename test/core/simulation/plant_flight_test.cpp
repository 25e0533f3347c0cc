#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "adaptive_quadrotor_control/simulation/rigid_plant.h"
#include "support/fixtures.h"

namespace aqc {
namespace {

constexpr double kStep = 1e-3;
const Eigen::Vector3d kUp = Eigen::Vector3d::UnitZ();

State highUp() {
  State state;
  state.position.z() = 1000.0;
  return state;
}

void fly(RigidPlant& plant, const RotorArray& command, double duration) {
  const auto steps = std::lround(duration / kStep);
  for (long i = 0; i < steps; ++i) plant.step(command, kStep);
}

RotorArray off(const Vehicle& vehicle) {
  return 0.0 * test::hoverSpeeds(vehicle, 1.0);
}

TEST(Plant, FallsFreelyWithoutRotors) {
  const Vehicle vehicle = test::pelican();
  State start = highUp();
  start.velocity = {1.0, -2.0, 3.0};
  start.attitude = test::Dice(1).attitude();
  RigidPlant plant(vehicle, start);
  fly(plant, off(vehicle), 2.0);
  // RK4 is exact for a parabola.
  const Eigen::Vector3d expected =
      start.position + 2.0 * start.velocity - 0.5 * kGravity * 4.0 * kUp;
  EXPECT_LT((plant.state().position - expected).norm(), 1e-9);
  EXPECT_LT((plant.state().velocity - (start.velocity - 2.0 * kGravity * kUp)).norm(), 1e-10);
  EXPECT_LT(test::angleBetween(plant.state().attitude, start.attitude), 1e-7);
  EXPECT_FALSE(plant.touching());
}

TEST(Plant, KeepsItsVelocityWhenThrustEqualsWeight) {
  for (const char* name : {"pelican_thesis", "pelican", "hummingbird", "firefly"}) {
    const Vehicle vehicle = test::vehicleNamed(name);
    RigidPlant plant(vehicle, highUp());
    const RotorArray hover = test::hoverSpeeds(vehicle, vehicle.mass);
    fly(plant, hover, 1.0);
    // While the rotors speed up, thrust / weight is (1 - exp(-t / tau))^2, whose shortfall adds up
    // to 3/2 tau.
    const double sink = -1.5 * kGravity * vehicle.time_constant_up;
    EXPECT_NEAR(plant.state().velocity.z(), sink, 1e-7) << name;
    const State then = plant.state();
    fly(plant, hover, 1.0);
    EXPECT_LT((plant.state().velocity - then.velocity).norm(), 1e-9) << name;
    EXPECT_LT(plant.state().body_rate.norm(), 1e-9) << name;
    EXPECT_LT(test::angleBetween(plant.state().attitude, then.attitude), 1e-7) << name;
  }
}

TEST(Plant, AttitudeStaysOfUnitNormInAFastSpin) {
  State start = highUp();
  start.body_rate = {60.0, -50.0, 40.0};  // 88 rad/s, 0.09 rad a step
  RigidPlant plant(test::pelican(), start);
  for (int i = 0; i < 2000; ++i) {
    plant.step(RotorArray::Zero(4), 1e-3);
    ASSERT_NEAR(plant.state().attitude.norm(), 1.0, 1e-12) << "step " << i;
  }
}

TEST(Plant, ACopyFliesOnByItself) {
  const Vehicle vehicle = test::pelican();
  RigidPlant plant(vehicle, highUp());
  plant.attach(test::box(0.5));
  const RigidPlant before = plant;
  RigidPlant assigned(vehicle, State());
  assigned = plant;
  const RotorArray command = test::hoverSpeeds(vehicle, 3.0);
  for (int i = 0; i < 100; ++i) plant.step(command, 1e-3);
  EXPECT_TRUE(test::sameBits(before.state(), assigned.state()));
  EXPECT_NE(before.state().velocity.z(), plant.state().velocity.z());
  for (int i = 0; i < 100; ++i) assigned.step(command, 1e-3);
  EXPECT_TRUE(test::sameBits(assigned.state(), plant.state()));
  EXPECT_EQ(assigned.payloadMass(), 0.5);
}

TEST(Plant, DriftsTowardsTheWindExponentially) {
  Vehicle vehicle = test::pelican();
  vehicle.inertia *= 1e12;  // holds its attitude
  RigidPlant plant(vehicle, highUp());
  const RotorArray hover = test::hoverSpeeds(vehicle, vehicle.mass);
  fly(plant, hover, 1.0);
  const double sink = plant.state().velocity.z();
  const Eigen::Vector3d wind(3.0, -2.0, 5.0);
  plant.setWind(wind);
  const double rate = vehicle.drag_coefficient * hover.sum() / vehicle.mass;
  for (int second = 1; second <= 5; ++second) {
    fly(plant, hover, 1.0);
    const double share = 1.0 - std::exp(-rate * second);
    EXPECT_NEAR(plant.state().velocity.x(), share * wind.x(), 1e-9);
    EXPECT_NEAR(plant.state().velocity.y(), share * wind.y(), 1e-9);
    EXPECT_NEAR(plant.state().velocity.z(), sink, 1e-9) << "no drag along the rotors' axes";
  }
}

TEST(Plant, RollingMomentAndDragTurnItAboutTheCentreOfMass) {
  // With a payload the rotors' plane lies h = mp |z| / (m + mp) above the centre of mass, so that
  // drag D at the rotors pitches the nose up (-y) by h D when the air comes from the front.
  Vehicle vehicle = test::pelican();
  vehicle.inertia *= 1e6;
  RigidPlant plant(vehicle, highUp());
  plant.attach(test::box(0.5));
  const RotorArray hover = test::hoverSpeeds(vehicle, plant.mass());
  fly(plant, hover, 1.0);
  plant.setWind({-4.0, 0.0, 0.0});
  const double before = plant.state().body_rate.y();
  fly(plant, hover, 1e-3);
  const double height = 0.5 * 0.15 / 2.5;
  const double speed_sum = hover.sum();
  const double moment = -height * vehicle.drag_coefficient * speed_sum * 4.0;
  const double rolling = -vehicle.rolling_moment_coefficient * speed_sum * 4.0;
  EXPECT_NEAR((plant.state().body_rate.y() - before) / 1e-3 * plant.inertia()(1, 1), moment, 1e-4);
  EXPECT_NEAR((plant.state().body_rate.x()) / 1e-3 * plant.inertia()(0, 0), rolling, 1e-4);
}

TEST(Plant, YawsAgainstTheRotorsThatSpinFaster) {
  const Vehicle vehicle = test::pelican();
  RigidPlant plant(vehicle, highUp());
  RotorArray command = test::hoverSpeeds(vehicle, vehicle.mass);
  for (Eigen::Index i = 0; i < 4; ++i) {
    command[i] *= vehicle.rotors[static_cast<std::size_t>(i)].direction > 0 ? 1.05 : 0.95;
  }
  fly(plant, command, 0.1);
  EXPECT_LT(plant.state().body_rate.z(), -0.01);
}

TEST(Plant, RotorsFollowTheirCommandWithTwoTimeConstants) {
  const Vehicle vehicle = test::pelican();
  RigidPlant plant(vehicle, highUp());
  const RotorArray high = RotorArray::Constant(4, 800.0);
  const RotorArray low = RotorArray::Constant(4, 300.0);
  fly(plant, high, 0.02);
  const double up = 800.0 * (1.0 - std::exp(-0.02 / vehicle.time_constant_up));
  EXPECT_LT((plant.rotorSpeeds() - RotorArray::Constant(4, up)).norm(), 1e-9);
  fly(plant, low, 0.03);
  const double down = 300.0 + (up - 300.0) * std::exp(-0.03 / vehicle.time_constant_down);
  EXPECT_LT((plant.rotorSpeeds() - RotorArray::Constant(4, down)).norm(), 1e-9);
}

TEST(Plant, RotorsStayWithinTheirLimits) {
  const Vehicle vehicle = test::pelican();
  RigidPlant plant(vehicle, highUp());
  RotorArray command(4);
  command << 1e9, -1e9, 500.0, vehicle.max_rotor_speed;
  for (int i = 0; i < 500; ++i) {
    plant.step(command, kStep);
    ASSERT_GE(plant.rotorSpeeds().minCoeff(), 0.0);
    ASSERT_LE(plant.rotorSpeeds().maxCoeff(), vehicle.max_rotor_speed);
  }
  EXPECT_NEAR(plant.rotorSpeeds()[0], vehicle.max_rotor_speed, 1e-6);
  EXPECT_EQ(plant.rotorSpeeds()[1], 0.0);
  EXPECT_NEAR(plant.rotorSpeeds()[2], 500.0, 1e-6);
}

TEST(Plant, CommandsThatAreNotFiniteOrMissingCountAsZero) {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  constexpr double kInf = std::numeric_limits<double>::infinity();
  const Vehicle vehicle = test::pelican();
  RigidPlant plant(vehicle, highUp());
  RigidPlant other(vehicle, highUp());
  RotorArray bad(4);
  bad << kNan, kInf, -kInf, 600.0;
  RotorArray good(4);
  good << 0.0, 0.0, 0.0, 600.0;
  fly(plant, bad, 0.05);
  fly(other, good, 0.05);
  EXPECT_TRUE(test::sameBits(plant.state(), other.state()));
  fly(plant, RotorArray::Constant(2, 100.0), 1.0);
  EXPECT_NEAR(plant.rotorSpeeds()[1], 100.0, 1e-9);
  EXPECT_NEAR(plant.rotorSpeeds()[3], 0.0, 1e-9);
  EXPECT_TRUE(plant.state().valid());
}

TEST(Plant, TumblesWithoutTorqueKeepingEnergyAndAngularMomentum) {
  Vehicle vehicle = test::pelican();
  vehicle.inertia = Eigen::Vector3d(0.01, 0.02, 0.025).asDiagonal();
  vehicle.inertia(0, 1) = vehicle.inertia(1, 0) = 0.002;
  State start = highUp();
  start.attitude = test::Dice(2).attitude();
  start.body_rate = {0.1, 9.0, -0.2};  // about the middle axis: it flips over and over
  RigidPlant plant(vehicle, start);
  const auto energy = [&] {
    return 0.5 * plant.state().body_rate.dot(vehicle.inertia * plant.state().body_rate);
  };
  const auto momentum = [&]() -> Eigen::Vector3d {
    return plant.state().attitude * (vehicle.inertia * plant.state().body_rate);
  };
  const double energy_at_start = energy();
  const Eigen::Vector3d momentum_at_start = momentum();
  double most = 0.0;
  for (int i = 0; i < 5000; ++i) {
    plant.step(off(vehicle), kStep);
    most = std::max(most, std::abs(plant.state().body_rate.x()));
  }
  EXPECT_GT(most, 2.0) << "the body does tumble";
  // A step of RK4 errs by about (|omega| h)^5 / 120 = 5e-13; 5000 of them.
  EXPECT_NEAR(energy() / energy_at_start, 1.0, 1e-8);
  EXPECT_LT((momentum() - momentum_at_start).norm(), 1e-8 * momentum_at_start.norm());
  EXPECT_NEAR(plant.state().attitude.norm(), 1.0, 1e-15);
}

TEST(Plant, DisturbancesActOnTheCentreOfMass) {
  const Vehicle vehicle = test::pelican();
  RigidPlant plant(vehicle, highUp());
  plant.setDisturbance({{3.0, 0.0, 0.0}, {0.0, 0.0, 0.004}});
  fly(plant, off(vehicle), 0.5);
  EXPECT_NEAR(plant.state().velocity.x(), 3.0 / vehicle.mass * 0.5, 1e-10);
  EXPECT_NEAR(plant.state().body_rate.z(), 0.004 / 0.02 * 0.5, 1e-10);
}

TEST(Plant, AccelerometerReadsZeroInFreeFall) {
  const Vehicle vehicle = test::pelican();
  State start = highUp();
  start.attitude = test::Dice(3).attitude();
  RigidPlant plant(vehicle, start);
  fly(plant, off(vehicle), 0.1);
  EXPECT_LT(plant.specificForce().norm(), 1e-10);
}

TEST(Plant, AccelerometerReadsWhatTheBodyOriginFeels) {
  const Vehicle vehicle = test::pelican();
  test::Dice dice(4);
  for (int i = 0; i < 20; ++i) {
    RigidPlant plant(vehicle, dice.airborneState());
    if (i % 2 == 0) plant.attach(dice.payload());
    plant.setWind(dice.vector(5.0));
    const RotorArray command = dice.speeds(vehicle);
    fly(plant, command, 0.05);
    // Step back and forth is not possible, so compare with the mean slope of a very short step.
    const State before = plant.state();
    constexpr double kShort = 1e-6;
    plant.step(command, kShort);
    const Eigen::Vector3d slope = (plant.state().velocity - before.velocity) / kShort;
    const Eigen::Vector3d expected = before.attitude.conjugate() * (slope + kGravity * kUp);
    EXPECT_LT((plant.specificForce() - expected).norm(), 1e-2);
  }
}

}  // namespace
}  // namespace aqc
