#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "adaptive_quadrotor_control/simulation/flight_simulation.h"
#include "support/fixtures.h"

/// config/scenario/vertical_lift.yaml as `fly` and the ROS nodes fly it: on the plant.
namespace aqc {
namespace {

struct Flown {
  std::string vehicle;
  double rate;            // of the controller [Hz]
  double boundary_layer;  // varpi
};

std::ostream& operator<<(std::ostream& out, const Flown& flown) {
  return out << flown.vehicle << " at " << flown.rate << " Hz, varpi " << flown.boundary_layer;
}

Scenario liftScenario(double rate) {
  Scenario scenario = loadScenario(test::configFile("scenario/vertical_lift"));
  scenario.world.control_period = fromSeconds(1.0 / rate);
  return scenario;
}

FlightLog lift(const Scenario& scenario, const Flown& flown) {
  YAML::Node tree = loadYamlFile(test::configFile("controller/switched"));
  tree["boundary_layer"] = flown.boundary_layer;
  const Vehicle vehicle = test::vehicleNamed(flown.vehicle);
  return fly(scenario, vehicle, "switched", makeLaw(ParameterReader(tree, "switched"), vehicle),
             {});
}

/// Largest error of a kind after a time [s].
template <class Error>
double largest(const FlightLog& log, double after, Error error) {
  double most = 0.0;
  for (const FlightSample& sample : log.samples) {
    if (toSeconds(sample.time) > after) most = std::max(most, std::abs(error(sample.telemetry)));
  }
  return most;
}

double height(const Telemetry& telemetry) {
  return telemetry.position_error.z();
}
double attitude(const Telemetry& telemetry) {
  return telemetry.attitude_error.cwiseAbs().maxCoeff() * 180.0 / M_PI;
}

class LiftFlight : public testing::TestWithParam<Flown> {};

TEST_P(LiftFlight, SettlesAsTheThesisReports) {
  const Scenario scenario = liftScenario(GetParam().rate);
  const FlightLog log = lift(scenario, GetParam());
  EXPECT_TRUE(log.refusals.empty()) << "the scenario's signal keeps the dwell time";
  EXPECT_FALSE(log.crash_time);
  EXPECT_LE(largest(log, 20.0, height), 0.07);
  EXPECT_LT(largest(log, 20.0, attitude), 2.0);
  EXPECT_GT(largest(log, 20.0, attitude), 0.5) << "the pulse was felt";
  EXPECT_LT(largest(log, 40.0, attitude), 0.5);
  // x and y are nobody's business in this law: what the first second leaves goes on for ever.
  const double aside = measure(log, metricsWindow(scenario)).final_lateral_error;
  EXPECT_GT(aside, 20.0);
  EXPECT_LT(aside, 40.0);
}

INSTANTIATE_TEST_SUITE_P(Cases, LiftFlight,
                         testing::Values(Flown{"lifter", 1000.0, 0.1}, Flown{"lifter", 500.0, 0.1},
                                         Flown{"lifter", 250.0, 0.1},
                                         Flown{"lifter_lag", 1000.0, 0.1},
                                         Flown{"lifter_lag", 500.0, 0.1},
                                         Flown{"lifter_lag", 250.0, 0.5}));

TEST(LiftFlights, MassAndDisturbanceFollowTheScenario) {
  const FlightLog log = lift(liftScenario(250.0), {"lifter", 250.0, 0.1});
  const auto at = [&log](double time) { return log.samples[static_cast<std::size_t>(time * 250)]; };
  EXPECT_EQ(at(1.0).payload_mass, 0.0);
  EXPECT_NEAR(at(5.0).payload_mass, 0.2, 1e-12);
  EXPECT_NEAR(at(10.0).disturbance.force.z(), -0.05 * std::sin(5.0), 1e-12);
  EXPECT_EQ(at(24.9).disturbance.moment.z(), 0.0);
  EXPECT_EQ(at(26.0).disturbance.moment.z(), -5e-4);
  EXPECT_EQ(at(27.1).disturbance.moment.z(), 0.0);
}

TEST(LiftFlights, OnlyActiveGainsAdaptAndOnlyGammaRests) {
  const FlightLog log = lift(liftScenario(250.0), {"lifter", 250.0, 0.1});
  constexpr Eigen::Index kPerSubsystem = 6;  // theta_0 .. theta_3, zeta, gamma
  for (std::size_t i = 1; i < log.samples.size(); ++i) {
    const AdaptiveValues& before = log.samples[i - 1].telemetry.adaptive;
    const AdaptiveValues& after = log.samples[i].telemetry.adaptive;
    const auto active = static_cast<Eigen::Index>(after[3 * kPerSubsystem]) - 1;
    for (Eigen::Index s = 0; s < 3; ++s) {
      const bool same_theta =
          before.segment<4>(kPerSubsystem * s) == after.segment<4>(kPerSubsystem * s);
      const bool same_gamma = before[kPerSubsystem * s + 5] == after[kPerSubsystem * s + 5];
      ASSERT_EQ(same_theta, s != active) << "subsystem " << s + 1 << ", sample " << i;
      ASSERT_TRUE(same_gamma || s != active) << "sample " << i;
    }
  }
}

TEST(LiftFlights, RefusalsAreInTheLog) {
  Scenario scenario = liftScenario(250.0);
  scenario.mission.switches = {{fromSeconds(1), 2},
                               {fromSeconds(1), 3},
                               {fromSeconds(1), 1},
                               {fromSeconds(2), 2},
                               {fromSeconds(3), 8}};
  const FlightLog log = lift(scenario, {"lifter", 250.0, 0.1});
  ASSERT_EQ(log.refusals.size(), 2u);
  EXPECT_EQ(log.refusals[0].time, fromSeconds(2));
  EXPECT_EQ(log.refusals[0].reason.substr(0, 91),
            "switch to subsystem 2 refused: against the dwell time; the next switch is allowed at "
            "7.7596");
  EXPECT_NE(log.refusals[1].reason.find("switch to subsystem 8 refused: no such subsystem"),
            std::string::npos);
  EXPECT_NE(log.dwell_time.find("theta* = 6.7597 s"), std::string::npos) << log.dwell_time;
}

TEST(LiftFlights, OtherLawsIgnoreTheSwitches) {
  const Vehicle vehicle = test::vehicleNamed("lifter");
  const FlightLog log =
      fly(liftScenario(250.0), vehicle, "asmc", test::lawNamed("asmc", vehicle), {});
  EXPECT_TRUE(log.refusals.empty());
  EXPECT_TRUE(log.dwell_time.empty());
}

}  // namespace
}  // namespace aqc
