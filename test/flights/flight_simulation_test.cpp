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
  for (TimedSetPoint& timed : scenario.mission.set_points) timed.set_point.position.z() = -1.0;
  const FlightMetrics metrics = flyBothWays(scenario, "asmc");
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

}  // namespace
}  // namespace aqc
