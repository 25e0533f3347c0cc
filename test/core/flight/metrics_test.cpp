#include "adaptive_quadrotor_control/flight/metrics.h"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>
#include <string>

#include "adaptive_quadrotor_control/flight/flight_log.h"
#include "adaptive_quadrotor_control/flight/flight_meter.h"
#include "support/heap_counter.h"

namespace aqc {
namespace {

/// 20 s at 10 Hz; metrics count from 10 s, the payload changes at 8 s.
const MetricsWindow kWindow = {fromSeconds(10.0), fromSeconds(8.0), fromSeconds(20.0)};

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
  const FlightMetrics metrics = measure(steadyLog(), kWindow);
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
  const FlightMetrics metrics = measure(log, kWindow);
  EXPECT_NEAR(metrics.rms.position.x(), std::sqrt(0.5), 1e-12);
  EXPECT_NEAR(metrics.rms.position.y(), std::sqrt(2.0), 1e-12);
}

TEST(FlightMetrics, CountOnlyFromTheWindowOn) {
  FlightLog log = steadyLog();
  for (std::size_t i = 0; i < index(10.0); ++i) {
    log.samples[i].telemetry.position_error *= 100.0;
    log.samples[i].telemetry.attitude_error *= 100.0;
  }
  EXPECT_NEAR(measure(log, kWindow).rms.position.z(), 0.5, 1e-12);
  log.samples[index(10.0)].telemetry.position_error *= 2.0;
  EXPECT_NEAR(measure(log, kWindow).rms.position.z(), 0.5 * std::sqrt(103.0 / 100.0), 1e-12)
      << "the window's first sample counts";
}

TEST(FlightMetrics, PeakCountsFromTheLastPayloadChange) {
  FlightLog log = steadyLog();
  log.samples[index(7.9)].telemetry.position_error.z() = 9.0;
  EXPECT_NEAR(measure(log, kWindow).peak_altitude_error, 0.5, 1e-12);
  log.samples[index(8.0)].telemetry.position_error.z() = -3.0;
  EXPECT_NEAR(measure(log, kWindow).peak_altitude_error, 3.0, 1e-12);
}

TEST(FlightMetrics, SettledErrorIsTheMeanOfTheLastFiveSeconds) {
  FlightLog log = steadyLog();
  for (std::size_t i = index(15.0); i < log.samples.size(); ++i) {
    log.samples[i].telemetry.position_error.z() = i % 2 == 0 ? 0.02 : -0.04;
  }
  EXPECT_NEAR(measure(log, kWindow).settled_altitude_error, 0.03, 1e-12);
}

TEST(FlightMetrics, LeaveOutTimesWithoutASetPoint) {
  FlightLog log = steadyLog();
  for (std::size_t i = index(12.0); i < index(14.0); ++i) {
    log.samples[i].flying = false;
    log.samples[i].telemetry.position_error.setConstant(1e6);
  }
  EXPECT_NEAR(measure(log, kWindow).rms.position.x(), 0.3, 1e-12);
  EXPECT_NEAR(measure(log, kWindow).peak_altitude_error, 0.5, 1e-12);
}

TEST(FlightMetrics, TellACrashAndTimeOnTheGround) {
  FlightLog log = steadyLog();
  log.crash_time = fromSeconds(16.25);
  for (std::size_t i = index(5.0); i < index(6.0); ++i) log.samples[i].touching = true;
  EXPECT_FALSE(measure(log, kWindow).grounded_from.has_value()) << "it flew on";
  for (std::size_t i = index(17.3); i < log.samples.size(); ++i) log.samples[i].touching = true;
  const FlightMetrics metrics = measure(log, kWindow);
  EXPECT_NEAR(*metrics.crash_time, 16.25, 1e-12);
  ASSERT_TRUE(metrics.grounded_from.has_value());
  EXPECT_NEAR(*metrics.grounded_from, 17.3, 1e-12);
}

TEST(FlightMetrics, AreNotGroundedWithoutASetPoint) {
  FlightLog log = steadyLog();
  for (std::size_t i = index(17.0); i < log.samples.size(); ++i) log.samples[i].touching = true;
  log.samples[index(18.0)].flying = false;
  EXPECT_NEAR(*measure(log, kWindow).grounded_from, 18.1, 1e-12);
  log.samples.back().flying = false;
  EXPECT_FALSE(measure(log, kWindow).grounded_from.has_value());
}

TEST(FlightMetrics, FinalLateralErrorIsThatOfTheLastStepWithASetPoint) {
  FlightLog log = steadyLog();
  EXPECT_NEAR(measure(log, kWindow).final_lateral_error, 0.5, 1e-12);
  log.samples[index(19.8)].telemetry.position_error = {-3.0, 4.0, 100.0};
  log.samples[index(19.9)].flying = false;
  EXPECT_NEAR(measure(log, kWindow).final_lateral_error, 5.0, 1e-12);
}

std::string refusalOf(const FlightLog& log) {
  try {
    measure(log, kWindow);
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "";
}

TEST(FlightMetrics, NeedAStepInTheWindowAndInItsLastSeconds) {
  FlightLog log = steadyLog();
  log.samples.resize(index(15.0));
  EXPECT_EQ(refusalOf(log),
            "the flight of 'test' has no step with a set point from 15 s to 20 s; its metrics "
            "need at least one");
  log.samples.resize(index(9.0));
  EXPECT_EQ(refusalOf(log).substr(0, 67),
            "the flight of 'test' has no step with a set point from 10 s to 20 s");
  log.samples.clear();
  EXPECT_FALSE(refusalOf(log).empty());
}

TEST(FlightMeter, TellsTheMetricsOfTheStepsSoFar) {
  FlightLog log = steadyLog();
  log.samples.back().telemetry.position_error.z() = 7.0;
  FlightMeter meter(kWindow, "test");
  for (const FlightSample& sample : log.samples) {
    if (&sample == &log.samples.back()) {
      EXPECT_NEAR(meter.metrics({}).peak_altitude_error, 0.5, 1e-12);
    }
    meter.add({sample.time, sample.flying, sample.touching, sample.telemetry.position_error,
               sample.telemetry.attitude_error});
  }
  EXPECT_EQ(meter.metrics({}).peak_altitude_error, 7.0);
  EXPECT_EQ(meter.metrics(fromSeconds(3.0)).crash_time, 3.0);
}

TEST(FlightMeter, AllocatesNothingInFlight) {
  if (!test::canCountHeap()) GTEST_SKIP() << "the allocator cannot be watched here";
  FlightMeter meter(kWindow, "a flight whose name is too long to be kept in place");
  const Eigen::Vector3d error(0.3, 0.4, 0.5);
  const test::HeapCounter counter;
  for (int i = 0; i < 200; ++i) meter.add({i * fromSeconds(0.1), true, true, error, error});
  EXPECT_EQ(counter.count(), 0u);
}

}  // namespace
}  // namespace aqc
