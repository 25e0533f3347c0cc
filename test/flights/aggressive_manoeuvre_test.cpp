#include <gtest/gtest.h>

#include <cmath>

#include "adaptive_quadrotor_control/simulation/flight_simulation.h"
#include "support/fixtures.h"

// Scenario 1 of the thesis, flown to its end by all three laws and compared with what it publishes.
namespace aqc {
namespace {

class AggressiveManoeuvre : public ::testing::Test {
 protected:
  FlightLog flyWith(const std::string& law) const {
    return fly(scenario_, vehicle_, law, test::lawNamed(law, vehicle_), {});
  }
  FlightMetrics metricsOf(const std::string& law) const {
    return measure(flyWith(law), metricsWindow(scenario_));
  }

  const Scenario scenario_ = loadScenario(test::configFile("scenario/aggressive_manoeuvre"));
  const Vehicle vehicle_ = test::vehicleNamed(scenario_.vehicle);
};

void expectWithin(const Eigen::Vector3d& actual, const Eigen::Vector3d& published, double share) {
  for (int axis = 0; axis < 3; ++axis) {
    EXPECT_NEAR(actual[axis], published[axis], share * published[axis]) << "axis " << axis;
  }
}

TEST_F(AggressiveManoeuvre, AdaptiveLawErrsAsPublished) {
  const FlightMetrics metrics = metricsOf("asmc");
  expectWithin(metrics.rms.position, {0.40, 0.48, 0.42}, 0.20);
  EXPECT_FALSE(metrics.crash_time.has_value());
  EXPECT_FALSE(metrics.grounded_from.has_value());
  EXPECT_NEAR(metrics.duration, 117.0, 1e-9);
}

TEST_F(AggressiveManoeuvre, SlidingModeLawErrsAsPublished) {
  const FlightMetrics metrics = metricsOf("smc");
  expectWithin(metrics.rms.position, {0.47, 0.69, 0.65}, 0.30);
  EXPECT_FALSE(metrics.crash_time.has_value());
}

TEST_F(AggressiveManoeuvre, AdaptiveLawIsBetterThanTheSlidingModeLawInEveryAxis) {
  const Eigen::Vector3d adaptive = metricsOf("asmc").rms.position;
  const Eigen::Vector3d fixed = metricsOf("smc").rms.position;
  EXPECT_TRUE((adaptive.array() < fixed.array()).all())
      << adaptive.transpose() << " against " << fixed.transpose();
}

TEST_F(AggressiveManoeuvre, GeometricLawSagsUnderThePayloadAndEndsOnTheGround) {
  const FlightLog log = flyWith("geometric");
  // m g / k_x = 0.5 * 9.81 / 4 = 1.226 m, settled just before the step at 58.8 s.
  double sag = 0.0;
  for (const FlightSample& sample : log.samples) {
    if (sample.time <= fromSeconds(58.7)) sag = -sample.telemetry.position_error.z();
  }
  EXPECT_GT(sag, 1.1);
  EXPECT_LT(sag, 1.3);
  const FlightMetrics metrics = measure(log, metricsWindow(scenario_));
  EXPECT_TRUE(metrics.crash_time.has_value() || metrics.grounded_from.has_value());
}

TEST_F(AggressiveManoeuvre, AdaptiveLawFindsTheMassItCarries) {
  const FlightLog log = flyWith("asmc");
  const auto estimateAt = [&](double seconds) {
    return log.samples[static_cast<std::size_t>(std::lround(seconds * 100.0))]
        .telemetry.mass_estimate;
  };
  EXPECT_NEAR(estimateAt(34.9), 2.0, 0.1);
  EXPECT_NEAR(estimateAt(116.9), 2.5, 0.1);
}

TEST_F(AggressiveManoeuvre, PayloadIsAttachedAtItsTime) {
  const FlightLog log = flyWith("smc");
  for (const FlightSample& sample : log.samples) {
    ASSERT_EQ(sample.payload_mass, sample.time > fromSeconds(48.0) ? 0.5 : 0.0)
        << toSeconds(sample.time);
    ASSERT_EQ(sample.flying, sample.time >= fromSeconds(5.0)) << toSeconds(sample.time);
  }
  EXPECT_EQ(log.samples.size(), 11700u);
}

TEST_F(AggressiveManoeuvre, FliesTheSameBitsAgain) {
  const FlightLog one = flyWith("asmc");
  const FlightLog other = flyWith("asmc");
  ASSERT_EQ(one.samples.size(), other.samples.size());
  for (std::size_t i = 0; i < one.samples.size(); ++i) {
    ASSERT_TRUE(test::sameBits(one.samples[i].state, other.samples[i].state));
    ASSERT_TRUE(
        test::sameBits(one.samples[i].allocation.speeds, other.samples[i].allocation.speeds));
  }
}

TEST_F(AggressiveManoeuvre, ReportsItsProgress) {
  double last = 0.0;
  const auto progress = [&last](double share) {
    EXPECT_GT(share, last);
    last = share;
  };
  fly(scenario_, vehicle_, "smc", test::lawNamed("smc", vehicle_), progress);
  EXPECT_EQ(last, 1.0);
}

}  // namespace
}  // namespace aqc
