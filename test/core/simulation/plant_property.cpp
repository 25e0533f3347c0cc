#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <vector>

#include "adaptive_quadrotor_control/math/rotations.h"
#include "adaptive_quadrotor_control/simulation/rigid_plant.h"
#include "support/fixtures.h"

namespace aqc {
namespace {

/// A random flight of 100 ms: start, wind, payload and commands.
struct Flight {
  State start;
  Eigen::Vector3d wind;
  ForceMoment disturbance;
  std::vector<RotorArray> commands;
  Payload payload;
  bool is_loaded = false;

  State fly() const {
    RigidPlant plant(test::pelican(), start);
    plant.setWind(wind);
    plant.setDisturbance(disturbance);
    for (std::size_t i = 0; i < commands.size(); ++i) {
      if (i == commands.size() / 2 && is_loaded) plant.attach(payload);
      plant.step(commands[i], 1e-3);
    }
    return plant.state();
  }
};

Flight anyFlight(bool on_the_ground) {
  test::Dice dice(*rc::gen::arbitrary<unsigned>());
  const Vehicle vehicle = test::pelican();
  Flight flight;
  flight.start = dice.airborneState();
  if (on_the_ground) {
    flight.start.position.z() = dice.between(0.0, 0.3);
    flight.start.attitude = Eigen::Quaterniond::Identity();
  }
  flight.wind = dice.vector(5.0);
  flight.disturbance = {dice.vector(3.0), dice.vector(0.05)};
  flight.payload = dice.payload();
  flight.is_loaded = *rc::gen::arbitrary<bool>();
  for (int i = 0; i < 100; ++i) flight.commands.push_back(dice.speeds(vehicle));
  return flight;
}

double difference(const State& a, const State& b) {
  return (a.position - b.position).norm() + (a.velocity - b.velocity).norm() +
         2.0 * (a.attitude.conjugate() * b.attitude).vec().norm() +
         (a.body_rate - b.body_rate).norm();
}

RC_GTEST_PROP(Plants, FlyTheSameBitsAgain, ()) {
  const Flight flight = anyFlight(*rc::gen::arbitrary<bool>());
  const State end = flight.fly();
  RC_ASSERT(end.valid());
  RC_ASSERT(test::sameBits(end, flight.fly()));
}

RC_GTEST_PROP(Plants, DoNotCareWhereTheWorldBegins, ()) {
  const Flight flight = anyFlight(false);
  Flight shifted = flight;
  test::Dice dice(*rc::gen::arbitrary<unsigned>());
  Eigen::Vector3d shift = dice.vector(50.0);
  shifted.start.position += shift;
  State end = shifted.fly();
  end.position -= shift;
  RC_ASSERT(difference(end, flight.fly()) < 1e-9);
}

RC_GTEST_PROP(Plants, DoNotCareWhereNorthIs, ()) {
  const bool is_on_the_ground = *rc::gen::arbitrary<bool>();
  const Flight flight = anyFlight(is_on_the_ground);
  test::Dice dice(*rc::gen::arbitrary<unsigned>());
  const Eigen::Quaterniond turn = yawRotation(dice.between(-4.0, 4.0));
  Flight turned = flight;
  turned.start.position = turn * flight.start.position;
  turned.start.velocity = turn * flight.start.velocity;
  turned.start.attitude = turn * flight.start.attitude;
  turned.wind = turn * flight.wind;
  turned.disturbance.force = turn * flight.disturbance.force;
  State end = turned.fly();
  end.position = turn.conjugate() * end.position;
  end.velocity = turn.conjugate() * end.velocity;
  end.attitude = turn.conjugate() * end.attitude;
  // The stiff ground makes rounding errors grow.
  RC_ASSERT(difference(end, flight.fly()) < (is_on_the_ground ? 1e-3 : 1e-8));
}

RC_GTEST_PROP(Plants, KeepAUnitQuaternionAndTheirRotorsInLimits, ()) {
  test::Dice dice(*rc::gen::arbitrary<unsigned>());
  const Vehicle vehicle =
      test::vehicleNamed(*rc::gen::element<std::string>("pelican", "hummingbird", "firefly"));
  RigidPlant plant(vehicle, dice.airborneState());
  for (int i = 0; i < 200; ++i) {
    RotorArray command = dice.speeds(vehicle);
    command *= dice.between(-2.0, 3.0);
    plant.step(command, 1e-3);
    RC_ASSERT(std::abs(plant.state().attitude.norm() - 1.0) < 1e-12);
    RC_ASSERT(plant.rotorSpeeds().minCoeff() >= 0.0);
    RC_ASSERT(plant.rotorSpeeds().maxCoeff() <= vehicle.max_rotor_speed);
  }
}

RC_GTEST_PROP(Plants, TurnTheirRotorsNoFasterThanAWeakBatteryAllows, ()) {
  test::Dice dice(*rc::gen::arbitrary<unsigned>());
  const Vehicle vehicle = test::pelican();
  RigidPlant plant(vehicle, dice.airborneState());
  double share = 1.0;
  for (int i = 0; i < 200; ++i) {
    if (i % 20 == 0) plant.setSpeedLimit(share = dice.between(0.01, 1.0));
    const double before = plant.rotorSpeeds().maxCoeff();
    const RotorArray command = 3.0 * dice.speeds(vehicle);
    plant.step(command, 1e-3);
    RC_ASSERT(plant.rotorSpeeds().maxCoeff() <= std::max(before, share * vehicle.max_rotor_speed));
  }
}

RC_GTEST_PROP(Plants, FlyTheSameBitsAfterARotorIsSoundAgain, ()) {
  test::Dice dice(*rc::gen::arbitrary<unsigned>());
  const Vehicle vehicle = test::pelican();
  RigidPlant plant(vehicle, dice.airborneState());
  RigidPlant repaired = plant;
  for (int i = 0; i < 50; ++i) {
    const RotorArray command = dice.speeds(vehicle);
    if (i == 25) {
      const auto rotor = static_cast<std::size_t>(dice.index(4));
      repaired.setRotor(rotor, {dice.between(0.0, 1.0), std::nullopt, dice.between(1.0, 9.0)});
      repaired.setRotor(rotor, {});
    }
    plant.step(command, 1e-3);
    repaired.step(command, 1e-3);
  }
  RC_ASSERT(test::sameBits(plant.state(), repaired.state()));
}

}  // namespace
}  // namespace aqc
