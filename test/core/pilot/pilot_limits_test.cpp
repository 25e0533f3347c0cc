#include "adaptive_quadrotor_control/pilot/pilot_limits.h"

#include <gtest/gtest.h>

#include "adaptive_quadrotor_control/parameters/parameter_reader.h"
#include "support/refusal.h"

namespace aqc {
namespace {

PilotLimits read(const std::string& yaml) {
  const ParameterReader reader(YAML::Load(yaml), "limits");
  const PilotLimits limits = readPilotLimits(reader);
  reader.finish();
  return limits;
}

TEST(PilotLimits, ReadsEveryName) {
  const PilotLimits limits = read(R"(
new_start: 2.0
confirmations: 4
specific_force_age: 0.05
trajectory_age: 3.0
handover: {position_error: 0.1, velocity_error: 0.2, attitude_error: 0.3}
monitor: {rate_deviation: [1, 2], jitter: [3, 4], odometry_age: [5, 6], silence: [7, 8],
          distance: [9, 10], saturation: [11, 12], dropped_odometry: [13, 14], lift: [15, 16]})");
  EXPECT_EQ(limits.clock.new_start, 2'000'000'000);
  EXPECT_EQ(limits.clock.confirmations, 4);
  EXPECT_EQ(limits.specific_force_age, 50'000'000);
  EXPECT_EQ(limits.trajectory_age, 3'000'000'000);
  EXPECT_EQ(limits.handover.position_error, 0.1);
  EXPECT_EQ(limits.handover.velocity_error, 0.2);
  EXPECT_EQ(limits.handover.attitude_error, 0.3);
  double next = 1.0;
  const MonitorLimits& monitor = limits.monitor;
  for (const Threshold& threshold :
       {monitor.rate_deviation, monitor.jitter, monitor.odometry_age, monitor.silence,
        monitor.distance, monitor.saturation, monitor.dropped_odometry, monitor.lift}) {
    EXPECT_EQ(threshold.warn, next++);
    EXPECT_EQ(threshold.error, next++);
  }
}

TEST(PilotLimits, AreTheDefaultsWhereNothingIsSaid) {
  const PilotLimits limits = read("{monitor: {lift: [0.5, 0.6]}}");
  EXPECT_EQ(limits.clock.new_start, kNewStart);
  EXPECT_EQ(limits.clock.confirmations, ClockLimits().confirmations);
  EXPECT_EQ(limits.specific_force_age, PilotLimits().specific_force_age);
  EXPECT_EQ(limits.monitor.jitter.warn, MonitorLimits().jitter.warn);
  EXPECT_EQ(limits.monitor.lift.warn, 0.5);
}

TEST(PilotLimits, RefusesByName) {
  EXPECT_EQ(test::refusal<ParameterError>([] { read("{confirmations: 0}"); }),
            "parameter 'limits/confirmations' is '0'; it must be a finite number >= 1 and <= 1000");
  EXPECT_EQ(test::refusal<ParameterError>([] { read("{monitor: {jitter: [2, 1]}}"); }),
            "parameter 'limits/monitor/jitter' is [2, 1]; it must be [warn, error] with warn <= "
            "error");
  EXPECT_EQ(test::refusal<ParameterError>([] { read("{odometry_age: 1}"); }),
            "parameter 'limits/odometry_age' is unknown");
}

}  // namespace
}  // namespace aqc
