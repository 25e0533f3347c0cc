#include "adaptive_quadrotor_control/simulation/closed_loop.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "adaptive_quadrotor_control/simulation/flight_simulation.h"
#include "support/fixtures.h"

namespace aqc {
namespace {

/// Three seconds: a step at 1 s, a payload at 2 s.
Scenario shortScenario() {
  Scenario scenario = loadScenario(test::configFile("scenario/aggressive_manoeuvre"));
  scenario.duration = fromSeconds(3.0);
  scenario.world.start.position.z() = 1.0;
  scenario.mission.set_points.resize(1);
  scenario.mission.set_points[0].time = fromSeconds(0.0);
  scenario.mission.set_points[0].set_point.position = {0.5, -0.3, 1.5};
  scenario.mission.events = {{fromSeconds(2.0), AttachPayload{"box", test::box(0.5)}}};
  return scenario;
}

TEST(ClosedLoop, IsTheControllerFedWithThePlantsStateAtItsRate) {
  const Vehicle vehicle = test::pelican();
  for (const char* law : {"asmc", "smc", "geometric"}) {
    const FlightLog log = fly(shortScenario(), vehicle, law, test::lawNamed(law, vehicle), {});
    FlightController controller(vehicle, test::lawNamed(law, vehicle));
    for (const FlightSample& sample : log.samples) {
      const SetPoint* set_point = sample.flying ? &sample.set_point : nullptr;
      const RotorArray speeds = controller.step({sample.state}, set_point, 0.01).speeds;
      ASSERT_TRUE(test::sameBits(speeds, sample.allocation.speeds)) << law;
    }
  }
}

TEST(ClosedLoop, HoldsTheRotorSpeedsBetweenControlSteps) {
  const Vehicle vehicle = test::pelican();
  const Scenario scenario = shortScenario();
  const FlightLog log = fly(scenario, vehicle, "asmc", test::lawNamed("asmc", vehicle), {});
  TimedPlant plant(makePlant(vehicle, scenario.world), {}, scenario.world.plant_step);
  for (const PlantEvent& event : scenario.mission.events) plant.schedule(event);
  for (const FlightSample& sample : log.samples) {
    ASSERT_EQ(sample.time, plant.now());
    ASSERT_TRUE(test::sameBits(sample.state, plant.plant().state()));
    plant.advance(sample.allocation.speeds, plant.now() + scenario.world.control_period);
  }
  EXPECT_EQ(plant.now(), scenario.duration);
}

TEST(ClosedLoop, EndsWithTheScenarioEvenInTheMiddleOfAControlPeriod) {
  const Vehicle vehicle = test::pelican();
  Scenario scenario = shortScenario();
  scenario.duration = fromSeconds(2.505);
  ClosedLoop loop(scenario, vehicle, test::lawNamed("asmc", vehicle));
  int steps = 0;
  for (; !loop.done(); ++steps) loop.advance();
  EXPECT_EQ(steps, 251);
  EXPECT_EQ(loop.plant().now(), scenario.duration);
}

PilotLimits guarded() {
  PilotLimits limits;
  limits.guard = GuardLimits();
  return limits;
}

// With sensors and without: the IMU's gyroscope is what a descent without odometry needs.
TEST(ClosedLoop, TakesOffFliesAndDescendsBlindlyWithAGuard) {
  for (const bool sensors : {false, true}) {
    Scenario scenario = shortScenario();
    scenario.duration = fromSeconds(20.0);
    scenario.world.start.position.z() = 0.1;
    scenario.mission.events.clear();
    if (sensors) {
      scenario.world.sensors = SensorFaults();
      scenario.world.sensors->odometry.period = scenario.world.control_period;
      scenario.world.sensors->odometry.gaps = {{fromSeconds(7.0)}};
      scenario.world.sensors->imu.period = scenario.world.control_period;
    }
    const Vehicle vehicle = test::pelican();
    ClosedLoop loop(scenario, vehicle, test::lawNamed("asmc", vehicle), guarded());
    while (loop.plant().now() < fromSeconds(6.9)) loop.advance();
    EXPECT_EQ(loop.pilot().guard()->mode(), Mode::kFlying);
    EXPECT_LT((loop.plant().plant().state().position - Eigen::Vector3d(0.5, -0.3, 1.5)).norm(),
              0.2);
    while (!loop.done()) loop.advance();
    EXPECT_EQ(loop.pilot().guard()->mode(), sensors ? Mode::kDisarmed : Mode::kFlying);
    EXPECT_EQ(loop.pilot().guard()->rule(), sensors ? Rule::kTouchDown : Rule::kSetPoint);
    EXPECT_FALSE(loop.plant().crashTime());
  }
}

TEST(ClosedLoop, TakesOverAVehicleThatStartsInTheAirWithAGuard) {
  const Vehicle vehicle = test::pelican();
  Scenario scenario = shortScenario();
  scenario.world.start.velocity.x() = 1.0;  // it could not be armed
  ClosedLoop loop(scenario, vehicle, test::lawNamed("asmc", vehicle), guarded());
  double lowest = 1.0;
  while (!loop.done()) {
    loop.advance();
    lowest = std::min(lowest, loop.plant().plant().state().position.z());
  }
  EXPECT_EQ(loop.pilot().guard()->mode(), Mode::kFlying);
  EXPECT_GT(lowest, 0.5);
}

TEST(ClosedLoop, FliesOnTheLastCommandUntilTheTimeOutWhileCommandsAreLost) {
  const Vehicle vehicle = test::pelican();
  Scenario scenario = shortScenario();
  scenario.world.ground = false;  // it falls
  const auto flown = [&] {
    return fly(scenario, vehicle, "geometric", test::lawNamed("geometric", vehicle), {});
  };
  const FlightLog sound = flown();
  scenario.world.command_timeout = fromSeconds(0.25);
  EXPECT_TRUE(test::sameBits(flown().samples.back().state, sound.samples.back().state))
      << "a time-out that never comes changes nothing";
  scenario.mission.events = {{fromSeconds(1.0), LoseCommands{1.0, fromSeconds(1.0), 1}}};
  ClosedLoop loop(scenario, vehicle, test::lawNamed("geometric", vehicle));
  while (loop.plant().now() < fromSeconds(1.0)) loop.advance();
  const RotorArray last = loop.pilot().allocation().speeds;
  while (loop.plant().now() < fromSeconds(1.23)) loop.advance();
  EXPECT_LT((loop.plant().plant().rotorSpeeds() - last).norm(), 1e-2);
  EXPECT_FALSE(loop.plant().silent());
  while (loop.plant().now() < fromSeconds(1.5)) loop.advance();
  EXPECT_LT(loop.plant().plant().rotorSpeeds().norm(), 0.2) << "ten time constants later";
  EXPECT_TRUE(loop.plant().silent());
  while (loop.plant().now() < fromSeconds(2.02)) loop.advance();
  EXPECT_GT(loop.plant().plant().rotorSpeeds().norm(), 100.0) << "heard again";
}

TEST(ClosedLoop, HearsThroughChannelsWhenTheWorldHasSensors) {
  const Vehicle vehicle = test::pelican();
  Scenario scenario = shortScenario();
  const auto flown = [&] {
    return fly(scenario, vehicle, "geometric", test::lawNamed("geometric", vehicle), {});
  };
  const FlightLog direct = flown();
  scenario.world.sensors.emplace();
  OdometryFaults& odometry = scenario.world.sensors->odometry;
  odometry.period = scenario.world.sensors->imu.period = scenario.world.control_period;
  const FlightLog perfect = flown();
  ASSERT_EQ(perfect.samples.size(), direct.samples.size());
  for (std::size_t i = 0; i < direct.samples.size(); ++i) {
    ASSERT_TRUE(test::sameBits(perfect.samples[i].state, direct.samples[i].state)) << i;
  }

  odometry.delay = 3 * scenario.world.control_period;
  const FlightLog late = flown();
  for (std::size_t i = 3; i < 10; ++i) {
    EXPECT_EQ(late.samples[i].flying, true);
    EXPECT_EQ(late.samples[i - 3].time, late.samples[i].time - odometry.delay);
  }
  EXPECT_FALSE(late.samples[2].flying) << "nothing has arrived yet";
  EXPECT_TRUE(test::sameBits(late.samples[3].state, perfect.samples[0].state));

  odometry.noise.position = 0.01;
  EXPECT_TRUE(test::sameBits(flown().samples.back().state, flown().samples.back().state));
}

}  // namespace
}  // namespace aqc
