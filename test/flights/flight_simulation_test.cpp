#include "adaptive_quadrotor_control/simulation/flight_simulation.h"

#include <gtest/gtest.h>

#include <stdexcept>
#include <string>

#include "support/fixtures.h"

// Flights of which only the metrics are kept, against the same flights with a log.
namespace aqc {
namespace {

void expectSameBits(const FlightMetrics& a, const FlightMetrics& b) {
  EXPECT_TRUE(test::sameBits(a.rms.position, b.rms.position));
  EXPECT_TRUE(test::sameBits(a.rms.attitude, b.rms.attitude));
  const Eigen::Vector4d one(a.peak_altitude_error, a.settled_altitude_error, a.final_lateral_error,
                            a.duration);
  const Eigen::Vector4d other(b.peak_altitude_error, b.settled_altitude_error,
                              b.final_lateral_error, b.duration);
  EXPECT_TRUE(test::sameBits(one, other)) << one.transpose() << " against " << other.transpose();
  EXPECT_EQ(a.crash_time, b.crash_time);
  EXPECT_EQ(a.grounded_from, b.grounded_from);
}

/// Flies both ways and compares; the metrics.
FlightMetrics flyBothWays(const Scenario& scenario, const std::string& law) {
  SCOPED_TRACE(scenario.name + " with " + law);
  const Vehicle vehicle = test::vehicleNamed(scenario.vehicle);
  const FlightLog log = fly(scenario, vehicle, law, test::lawNamed(law, vehicle), {});
  const FlightMetrics logged = measure(log, metricsWindow(scenario));
  expectSameBits(flyMeasured(scenario, vehicle, test::lawNamed(law, vehicle)), logged);
  return logged;
}

Scenario scenarioNamed(const std::string& name) {
  return loadScenario(test::configFile("scenario/" + name));
}

class MeasuredFlight : public testing::TestWithParam<const char*> {};

TEST_P(MeasuredFlight, HasTheMetricsOfTheLogWithEveryLaw) {
  const Scenario scenario = scenarioNamed(GetParam());
  for (const std::string& law : lawNames()) flyBothWays(scenario, law);
}

INSTANTIATE_TEST_SUITE_P(Scenarios, MeasuredFlight,
                         testing::Values("aggressive_manoeuvre", "hover_payload",
                                         "payload_transport", "vertical_lift"));

TEST(MeasuredFlights, TellACrash) {
  EXPECT_TRUE(flyBothWays(scenarioNamed("payload_transport"), "geometric").crash_time);
}

TEST(MeasuredFlights, TellThatTheVehicleStayedOnTheGround) {
  Scenario scenario = scenarioNamed("aggressive_manoeuvre");
  scenario.duration = fromSeconds(20.0);
  scenario.metrics_from = 0;
  scenario.mission.events = {};
  const Eigen::Vector3d below = scenario.world.start.position - Eigen::Vector3d::UnitZ();
  for (TimedSetPoint& timed : scenario.mission.set_points) timed.set_point.position = below;
  const FlightMetrics metrics = flyBothWays(scenario, "asmc");
  EXPECT_FALSE(metrics.crash_time);
  EXPECT_EQ(metrics.grounded_from, toSeconds(scenario.mission.set_points.front().time));
}

TEST(MeasuredFlights, EndWithTheScenarioEvenInTheMiddleOfAControlPeriod) {
  Scenario scenario = scenarioNamed("aggressive_manoeuvre");
  scenario.duration = fromSeconds(12.345);
  scenario.metrics_from = fromSeconds(7.0);
  EXPECT_EQ(flyBothWays(scenario, "smc").duration, 12.345);
}

TEST(MeasuredFlights, NeedAStepWithASetPointAsTheLogDoes) {
  Scenario scenario = scenarioNamed("aggressive_manoeuvre");
  scenario.mission.set_points.clear();
  scenario.mission.events.clear();
  scenario.duration = fromSeconds(2.0);
  EXPECT_THROW(flyBothWays(scenario, "asmc"), std::invalid_argument);
  const Vehicle vehicle = test::vehicleNamed(scenario.vehicle);
  try {
    flyMeasured(scenario, vehicle, test::lawNamed("asmc", vehicle));
    FAIL();
  } catch (const std::invalid_argument& error) {
    EXPECT_NE(std::string(error.what()).find(scenario.name), std::string::npos) << error.what();
  }
}

TEST(LoggedFlights, TellRefusalsOfPlantAndSwitchesByTime) {
  Scenario scenario = scenarioNamed("vertical_lift");
  scenario.duration = fromSeconds(4.0);
  scenario.world.cargo = {{"far", test::box(0.5), {100.0, 0.0, 0.05}, Eigen::Vector3d::Zero()}};
  scenario.mission.events = {{fromSeconds(2.5), AttachPayload{"far", test::box(0.5)}}};
  scenario.mission.switches = {{fromSeconds(2.0), 8}, {fromSeconds(3.0), 8}};
  const Vehicle vehicle = test::vehicleNamed(scenario.vehicle);
  const FlightLog log = fly(scenario, vehicle, "switched", test::lawNamed("switched", vehicle), {});
  ASSERT_EQ(log.refusals.size(), 3u);
  EXPECT_EQ(log.refusals[0].time, fromSeconds(2.0));
  EXPECT_EQ(log.refusals[1].time, fromSeconds(2.5));
  EXPECT_NE(log.refusals[1].reason.find("far"), std::string::npos);
  EXPECT_EQ(log.refusals[2].time, fromSeconds(3.0));
}

}  // namespace
}  // namespace aqc
