#include "adaptive_quadrotor_control/pilot/flight_monitor.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <string>

namespace aqc {
namespace {

constexpr Nanoseconds kPeriod = 4'000'000;
constexpr double kLift = 4.0;  // [kg]

class FlightMonitorTest : public ::testing::Test {
 protected:
  // A second of a flight in which all is well.
  void fly(int steps = 250, bool saturated = false) {
    for (int i = 0; i < steps; ++i) {
      now_ += kPeriod;
      monitor_.countOdometry(now_, now_ + 1'000'000);
      monitor_.countStep(now_, true, telemetry_, saturated);
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

  FlightMonitorTest() {
    telemetry_.mass_estimate = 2.0;
    monitor_.countSetPoint(0);
  }

  FlightMonitor monitor_{kPeriod, kLift};
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
    monitor_.countStep(now_, true, telemetry_, false);
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
  telemetry_.mass_estimate = 3.4;
  fly();
  expect(judge("Payload"), Health::kWarn, "3.40 kg of 4.00 kg");
  telemetry_.mass_estimate = 40.0;
  fly();
  expect(judge("Payload"), Health::kError, "40.00 kg against 4.00 kg");
  // A law without an estimate is judged by the force it asks for.
  telemetry_.mass_estimate = std::numeric_limits<double>::quiet_NaN();
  telemetry_.force.z() = 2.5 * kGravity;
  fly();
  expect(judge("Payload"), Health::kOk, "2.50 kg");
  telemetry_.force.z() = std::numeric_limits<double>::quiet_NaN();
  fly();
  EXPECT_EQ(judge("Payload").health, Health::kError);
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
  monitor_.countStep(now_, false, telemetry_, false);
  EXPECT_EQ(judge("Payload").reason, "nothing is lifted");
}

}  // namespace
}  // namespace aqc
