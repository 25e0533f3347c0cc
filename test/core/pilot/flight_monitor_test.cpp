#include "adaptive_quadrotor_control/pilot/flight_monitor.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <string>

namespace aqc {
namespace {

constexpr Nanoseconds kPeriod = 4'000'000;

class FlightMonitorTest : public ::testing::Test {
 protected:
  // A second of a flight in which all is well.
  void fly(int steps = 250, bool saturated = false) {
    for (int i = 0; i < steps; ++i) {
      now_ += kPeriod;
      monitor_.countOdometry(now_, now_ + 1'000'000);
      monitor_.countStep(now_, true, telemetry_, saturated, load_);
    }
  }
  Finding judge(const std::string& name, double silence = 0.004) {
    for (Finding& finding : monitor_.judge(now_ + 1'000'000, silence)) {
      if (finding.name == name) return finding;
    }
    ADD_FAILURE() << name;
    return {};
  }
  void expect(const Finding& finding, Health health, const std::string& words) {
    EXPECT_EQ(finding.health, health) << finding.name << ": " << finding.reason;
    EXPECT_NE(finding.reason.find(words), std::string::npos) << finding.reason;
  }

  FlightMonitorTest() { monitor_.countSetPoint(0); }

  FlightMonitor monitor_{kPeriod};
  Load load_ = {2.0, 4.0};  // [kg]
  Telemetry telemetry_;
  Nanoseconds now_ = 1'000'000'000;
};

TEST_F(FlightMonitorTest, FindsNothingInAHealthyFlight) {
  fly();
  for (const Finding& finding : monitor_.judge(now_, 0.004)) {
    EXPECT_EQ(finding.health, Health::kOk) << finding.name << ": " << finding.reason;
    EXPECT_FALSE(finding.reason.empty());
  }
}

TEST_F(FlightMonitorTest, WaitsBeforeTheFlight) {
  expect(judge("Control loop"), Health::kWarn, "waits for odometry");
  expect(judge("Odometry"), Health::kWarn, "none has come yet");
  expect(judge("Set point"), Health::kOk, "none is active");
}

TEST_F(FlightMonitorTest, SeesASlowAndAnUnevenLoop) {
  for (int i = 0; i < 100; ++i) {
    now_ += 2 * kPeriod;
    monitor_.countStep(now_, true, telemetry_, false, load_);
  }
  expect(judge("Control loop"), Health::kError, "125.0 Hz instead of 250.0 Hz");
  fly(200);
  now_ += 2 * kPeriod;
  fly(200);
  expect(judge("Control loop"), Health::kWarn, "8.0 ms late");
  expect(judge("Control loop"), Health::kError, "stands still");
}

TEST_F(FlightMonitorTest, SeesOldAndMissingOdometry) {
  fly();
  monitor_.countOdometry(now_, now_ + 100'000'000);
  expect(judge("Odometry"), Health::kWarn, "100 ms old");
  fly();
  expect(judge("Odometry", 1.5), Health::kError, "none for 1.5 s");
  fly();
  expect(judge("Odometry"), Health::kOk, "fresh");
}

TEST_F(FlightMonitorTest, SeesSaturation) {
  fly(230);
  fly(20, true);
  expect(judge("Rotors"), Health::kWarn, "8 %");
  fly(250, true);
  expect(judge("Rotors"), Health::kError, "100 %");
  fly();
  expect(judge("Rotors"), Health::kOk, "within");
}

TEST_F(FlightMonitorTest, WeighsThePayload) {
  load_.carried = 3.4;
  fly();
  expect(judge("Payload"), Health::kWarn, "3.40 kg of 4.00 kg");
  load_.carried = 2.5;
  fly();
  expect(judge("Payload"), Health::kOk, "2.50 kg");
  load_.carried = std::numeric_limits<double>::quiet_NaN();
  fly();
  EXPECT_EQ(judge("Payload").health, Health::kError);
}

// 0.42 s are 105 steps, between the first and the last of which as much goes by as they last.
TEST_F(FlightMonitorTest, NamesAnOverloadThatStays) {
  load_ = {3.1, 2.8};
  fly(105);
  EXPECT_FALSE(monitor_.overloaded());
  expect(judge("Payload"), Health::kWarn, "3.10 kg of 2.80 kg");
  fly(1);
  EXPECT_TRUE(monitor_.overloaded());
  load_.carried = 1.0;
  fly(10);
  EXPECT_FALSE(monitor_.overloaded());
  expect(judge("Payload"), Health::kError, "lifts 2.80 kg, carries 3.10 kg");
  fly(10);
  expect(judge("Payload"), Health::kOk, "1.00 kg");
}

TEST_F(FlightMonitorTest, NamesNoPullThatComesAndGoes) {
  for (int swing = 0; swing < 20; ++swing) {
    load_ = {3.1, 2.8};
    fly(90);
    load_.carried = 1.0;
    fly(10);
    ASSERT_FALSE(monitor_.overloaded());
  }
}

TEST_F(FlightMonitorTest, CountsWhatWasRefused) {
  fly(10);
  monitor_.countDroppedSetPoint();
  expect(judge("Messages"), Health::kWarn, "1 of set points");
  fly(10);
  for (int i = 0; i < 20; ++i) monitor_.countDroppedOdometry();
  expect(judge("Messages"), Health::kError, "20 of odometry");
  expect(judge("Messages"), Health::kOk, "none");
}

TEST_F(FlightMonitorTest, TellsOnceOfAClockThatBeganAnew) {
  now_ = 100'000'000'000;
  fly();
  judge("Messages");
  now_ = 1'000'000'000;
  monitor_.countNewStart();
  fly();
  for (const Finding& finding : monitor_.judge(now_, 0.004)) {
    const bool told = finding.name == "Messages";
    EXPECT_EQ(finding.health, told ? Health::kWarn : Health::kOk) << finding.reason;
    if (told) expect(finding, Health::kWarn, "began anew");
  }
  expect(judge("Messages"), Health::kOk, "none");
}

TEST_F(FlightMonitorTest, SeesAVehicleThatDoesNotFollow) {
  telemetry_.position_error.x() = 1.5;
  fly();
  expect(judge("Set point"), Health::kWarn, "1.50 m");
  telemetry_.position_error.x() = -4.0;
  fly();
  expect(judge("Set point"), Health::kError, "4.00 m");
}

TEST_F(FlightMonitorTest, TellsTheRateOfAHealthyLoop) {
  fly();
  const Finding finding = judge("Control loop");
  EXPECT_EQ(finding.reason, "runs at 250.0 Hz");
  ASSERT_EQ(finding.values.size(), 3u);
  EXPECT_EQ(finding.values[2].second, "4.00") << "the longest step [ms]";
}

TEST_F(FlightMonitorTest, JudgesTheShareOfOdometryThatWasRefused) {
  fly(10);
  for (int i = 0; i < 10; ++i) monitor_.countDroppedOdometry();
  expect(judge("Messages"), Health::kWarn, "10 of odometry");
  fly(10);
  for (int i = 0; i < 11; ++i) monitor_.countDroppedOdometry();
  expect(judge("Messages"), Health::kError, "11 of odometry");
}

TEST_F(FlightMonitorTest, WeighsNothingThatStandsStill) {
  monitor_.countStep(now_, false, telemetry_, false, load_);
  EXPECT_EQ(judge("Payload").reason, "nothing is lifted");
}

}  // namespace
}  // namespace aqc
