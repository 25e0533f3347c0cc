#include "adaptive_quadrotor_control/flight/flight_log.h"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

#include "support/fixtures.h"

namespace aqc {
namespace {

/// 20 s at 10 Hz; metrics count from 10 s, the payload changes at 8 s.
Scenario scenario() {
  Scenario scenario;
  scenario.duration = fromSeconds(20.0);
  scenario.metrics_from = fromSeconds(10.0);
  const PlantEvent attach{fromSeconds(8.0), AttachPayload{"box", test::box(0.5)}};
  const PlantEvent wind{fromSeconds(9.0), SetWind{Eigen::Vector3d::Zero()}};
  scenario.mission.events = {attach, wind};
  return scenario;
}

FlightLog steadyLog() {
  FlightLog log;
  log.controller = "test";
  for (int i = 0; i < 200; ++i) {
    FlightSample sample;
    sample.time = i * fromSeconds(0.1);
    sample.flying = true;
    const double sign = i % 2 == 0 ? 1.0 : -1.0;
    sample.telemetry.position_error = sign * Eigen::Vector3d(0.3, 0.4, 0.5);
    sample.telemetry.attitude_error = sign * Eigen::Vector3d(0.1, 0.2, -0.3);
    log.samples.push_back(sample);
  }
  return log;
}

std::size_t index(double seconds) {
  return static_cast<std::size_t>(std::lround(10.0 * seconds));
}

TEST(FlightMetrics, RmsOfASteadyErrorIsTheError) {
  const FlightMetrics metrics = measure(steadyLog(), scenario());
  EXPECT_LT((metrics.rms.position - Eigen::Vector3d(0.3, 0.4, 0.5)).norm(), 1e-12);
  const double degree = 180.0 / M_PI;
  EXPECT_LT((metrics.rms.attitude - degree * Eigen::Vector3d(0.1, 0.2, 0.3)).norm(), 1e-12);
  EXPECT_NEAR(metrics.settled_altitude_error, 0.5, 1e-12);
  EXPECT_NEAR(metrics.peak_altitude_error, 0.5, 1e-12);
  EXPECT_EQ(metrics.duration, 20.0);
  EXPECT_FALSE(metrics.crash_time.has_value());
  EXPECT_FALSE(metrics.grounded_from.has_value());
}

TEST(FlightMetrics, RmsOfASineIsItsAmplitudeOverRootTwo) {
  FlightLog log = steadyLog();
  for (FlightSample& sample : log.samples) {
    const double phase = 2.0 * M_PI * toSeconds(sample.time);
    sample.telemetry.position_error = {std::sin(phase), 2.0 * std::cos(phase), 0.0};
  }
  const FlightMetrics metrics = measure(log, scenario());
  EXPECT_NEAR(metrics.rms.position.x(), std::sqrt(0.5), 1e-12);
  EXPECT_NEAR(metrics.rms.position.y(), std::sqrt(2.0), 1e-12);
}

TEST(FlightMetrics, CountOnlyFromTheWindowOn) {
  FlightLog log = steadyLog();
  for (std::size_t i = 0; i < index(10.0); ++i) {
    log.samples[i].telemetry.position_error *= 100.0;
    log.samples[i].telemetry.attitude_error *= 100.0;
  }
  EXPECT_NEAR(measure(log, scenario()).rms.position.z(), 0.5, 1e-12);
  log.samples[index(10.0)].telemetry.position_error *= 2.0;
  EXPECT_NEAR(measure(log, scenario()).rms.position.z(), 0.5 * std::sqrt(103.0 / 100.0), 1e-12)
      << "the window's first sample counts";
}

TEST(FlightMetrics, PeakCountsFromTheLastPayloadChange) {
  FlightLog log = steadyLog();
  log.samples[index(7.9)].telemetry.position_error.z() = 9.0;
  EXPECT_NEAR(measure(log, scenario()).peak_altitude_error, 0.5, 1e-12);
  log.samples[index(8.0)].telemetry.position_error.z() = -3.0;
  EXPECT_NEAR(measure(log, scenario()).peak_altitude_error, 3.0, 1e-12) << "wind is no payload";
}

TEST(FlightMetrics, SettledErrorIsTheMeanOfTheLastFiveSeconds) {
  FlightLog log = steadyLog();
  for (std::size_t i = index(15.0); i < log.samples.size(); ++i) {
    log.samples[i].telemetry.position_error.z() = i % 2 == 0 ? 0.02 : -0.04;
  }
  EXPECT_NEAR(measure(log, scenario()).settled_altitude_error, 0.03, 1e-12);
}

TEST(FlightMetrics, LeaveOutTimesWithoutASetPoint) {
  FlightLog log = steadyLog();
  for (std::size_t i = index(12.0); i < index(14.0); ++i) {
    log.samples[i].flying = false;
    log.samples[i].telemetry.position_error.setConstant(1e6);
  }
  EXPECT_NEAR(measure(log, scenario()).rms.position.x(), 0.3, 1e-12);
  EXPECT_NEAR(measure(log, scenario()).peak_altitude_error, 0.5, 1e-12);
}

TEST(FlightMetrics, TellACrashAndTimeOnTheGround) {
  FlightLog log = steadyLog();
  log.crash_time = fromSeconds(16.25);
  for (std::size_t i = index(5.0); i < index(6.0); ++i) log.samples[i].touching = true;
  EXPECT_FALSE(measure(log, scenario()).grounded_from.has_value()) << "it flew on";
  for (std::size_t i = index(17.3); i < log.samples.size(); ++i) log.samples[i].touching = true;
  const FlightMetrics metrics = measure(log, scenario());
  EXPECT_NEAR(*metrics.crash_time, 16.25, 1e-12);
  ASSERT_TRUE(metrics.grounded_from.has_value());
  EXPECT_NEAR(*metrics.grounded_from, 17.3, 1e-12);
}

TEST(FlightMetrics, NeedSamplesInTheWindow) {
  FlightLog log = steadyLog();
  log.samples.resize(index(9.0));
  EXPECT_THROW(measure(log, scenario()), std::invalid_argument);
  log.samples.clear();
  EXPECT_THROW(measure(log, scenario()), std::invalid_argument);
}

TEST(Scenario, LastPayloadChangeIsThatOfTheLastAttachOrDetach) {
  EXPECT_EQ(scenario().lastPayloadChange(), fromSeconds(8.0));
  EXPECT_EQ(Scenario().lastPayloadChange(), 0);
}

}  // namespace
}  // namespace aqc
