#include <gtest/gtest.h>

#include "adaptive_quadrotor_control/simulation/flight_simulation.h"
#include "support/fixtures.h"

// Scenario 2 of the thesis, flown to its end by all three laws and compared with what it publishes.
namespace aqc {
namespace {

class PayloadTransport : public ::testing::Test {
 protected:
  FlightLog flyWith(const std::string& law) const {
    return fly(scenario_, vehicle_, law, test::lawNamed(law, vehicle_), {});
  }

  // How often the vehicle passed from one side of the wall to the other before `end`.
  int crossings(const FlightLog& log, Nanoseconds end) const {
    const double middle =
        0.5 * (scenario_.world.walls.front().min.x() + scenario_.world.walls.front().max.x());
    int count = 0;
    for (std::size_t i = 1; i < log.samples.size() && log.samples[i].time < end; ++i) {
      const bool before = log.samples[i - 1].state.position.x() > middle;
      const bool after = log.samples[i].state.position.x() > middle;
      if (before != after) ++count;
    }
    return count;
  }

  const Scenario scenario_ = loadScenario(test::configFile("scenario/payload_transport"));
  const Vehicle vehicle_ = test::vehicleNamed(scenario_.vehicle);
};

TEST_F(PayloadTransport, AdaptiveLawCarriesBothPayloadsOverTheWall) {
  const FlightLog log = flyWith("asmc");
  const FlightMetrics metrics = measure(log, metricsWindow(scenario_));
  EXPECT_FALSE(metrics.crash_time.has_value()) << log.crash_reason;
  EXPECT_TRUE(log.refusals.empty());
  EXPECT_EQ(crossings(log, scenario_.duration), 2);
  const Eigen::Vector3d published = scenario_.published.at("asmc").position;
  for (int axis = 0; axis < 3; ++axis) {
    EXPECT_NEAR(metrics.rms.position[axis], published[axis], 0.25 * published[axis]) << axis;
  }
}

TEST_F(PayloadTransport, PayloadsHangWhileTheyAreCarried) {
  for (const FlightSample& sample : flyWith("asmc").samples) {
    const double time = toSeconds(sample.time);
    const double expected = time > 32.0 && time <= 58.0    ? 0.4
                            : time > 83.0 && time <= 123.0 ? 1.0
                                                           : 0.0;
    ASSERT_EQ(sample.payload_mass, expected) << time << " s";
  }
}

TEST_F(PayloadTransport, SlidingModeLawClearsTheWallOnceAndNotTwice) {
  const FlightLog log = flyWith("smc");
  ASSERT_TRUE(log.crash_time.has_value());
  EXPECT_GT(*log.crash_time, fromSeconds(90.0));
  EXPECT_LT(*log.crash_time, fromSeconds(100.0));
  EXPECT_EQ(log.crash_reason, "wall strike");
  EXPECT_EQ(crossings(log, *log.crash_time), 1);
}

TEST_F(PayloadTransport, GeometricLawDoesNotGetPastTheFirstPayload) {
  const FlightLog log = flyWith("geometric");
  ASSERT_TRUE(log.crash_time.has_value());
  EXPECT_GT(*log.crash_time, fromSeconds(32.0));
  EXPECT_LT(*log.crash_time, fromSeconds(58.0));
  EXPECT_EQ(crossings(log, *log.crash_time), 0);
}

}  // namespace
}  // namespace aqc
