#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>
#include <utility>

#include "adaptive_quadrotor_control/simulation/closed_loop.h"
#include "adaptive_quadrotor_control/simulation/scenario.h"
#include "support/fixtures.h"
#include "support/hover_flights.h"

// What docs/composite.md says of the law's flights, each with the one set of gains.
namespace aqc {
namespace {

using test::carrying;
using test::circling;
using test::Errors;
using test::Flown;
using test::sensing;

struct Limits {
  double peak, settled, drop, side;  // [cm]
};

void expectCarried(const char* what, const Scenario& scenario, const std::string& vehicle,
                   const Limits& limits) {
  const Flown flown(scenario, vehicle);
  const Errors peak = flown.within(10.0, 20.0);
  const Errors settled = flown.within(20.0, 25.0);
  const Errors drop = flown.within(25.0, 40.0);
  std::printf("%s, %s: peak %.2f settled %.3f drop %.2f, aside %.2f settled %.3f drop %.2f cm\n",
              what, vehicle.c_str(), peak.z, settled.z, drop.z, peak.side, settled.side, drop.side);
  EXPECT_FALSE(flown.crashed()) << what;
  EXPECT_LT(peak.z, limits.peak) << what;
  EXPECT_LT(std::max(settled.z, settled.side), limits.settled) << what;
  EXPECT_LT(drop.z, limits.drop) << what;
  EXPECT_LT(std::max(peak.side, drop.side), limits.side) << what;
}

TEST(CompositeFlight, CarriesWhatItIsHanded) {
  expectCarried("0.4 kg", carrying(0.4, 0.0), "pelican", {0.6, 0.1, 1.1, 0.01});
  expectCarried("0.6 kg", carrying(0.6, 0.0), "pelican", {0.8, 0.1, 1.6, 0.01});
  expectCarried("0.6 kg, 3 cm", carrying(0.6, 0.03), "pelican", {1.0, 0.1, 1.6, 1.2});
}

TEST(CompositeFlight, DoesSoWithoutAnImuAndWithLateOdometry) {
  constexpr Nanoseconds kLate = 20'000'000;
  expectCarried("0.4 kg, no IMU", sensing(carrying(0.4, 0.0), false, 0), "pelican",
                {3.0, 0.1, 2.5, 0.1});
  expectCarried("0.4 kg, 20 ms late", sensing(carrying(0.4, 0.0), true, kLate), "pelican",
                {1.0, 0.1, 1.5, 0.1});
  expectCarried("0.4 kg, 3 cm, 20 ms late", sensing(carrying(0.4, 0.03), true, kLate), "pelican",
                {1.0, 0.1, 1.5, 1.6});
}

TEST(CompositeFlight, CarriesUnderEveryVehicleWithOneSetOfGains) {
  for (const char* vehicle : {"hummingbird", "firefly", "pelican_thesis", "pelican"}) {
    const double mass = test::vehicleNamed(vehicle).mass;
    expectCarried("40 %", carrying(0.4 * mass, 0.0), vehicle, {1.0, 0.1, 1.5, 0.1});
  }
}

TEST(CompositeFlight, FliesCircles) {
  const Flown slow(circling(0.6, 0.0), "pelican");
  const Flown fast(circling(1.0, 0.3), "pelican");
  const Errors slow_error = slow.within(10.0, 30.0);
  const Errors fast_error = fast.within(10.0, 30.0);
  std::printf("circle 0.6: %.2f cm, 1.0 with 0.3 kg: %.2f cm rms\n", slow_error.rms(),
              fast_error.rms());
  EXPECT_LT(slow_error.rms(), 0.3);
  EXPECT_LT(fast_error.rms(), 0.6);
}

TEST(CompositeFlight, HoldsAgainstWind) {
  for (const bool imu : {true, false}) {
    const Flown flown(sensing(test::blown(8.0, 10.0, 30.0), imu, 0), "pelican");
    const Errors peak = flown.within(10.0, 20.0);
    const Errors settled = flown.within(25.0, 30.0);
    std::printf("wind 8 m/s, IMU %d: peak %.2f settled %.3f cm\n", imu, peak.side, settled.side);
    EXPECT_LT(peak.side, imu ? 3.5 : 4.0);
    EXPECT_LT(settled.side, 0.1);
  }
}

// With 838 rad/s the thrust is 1.14 times the weight.
TEST(CompositeFlight, FliesScenario1WithHardlyAnyThrustLeft) {
  Scenario scenario = loadScenario(test::configFile("scenario/aggressive_manoeuvre"));
  Vehicle weak = test::pelican();
  weak.max_rotor_speed = 838.0;
  ClosedLoop loop(scenario, weak, test::lawNamed("composite", weak));
  Eigen::Vector3d square = Eigen::Vector3d::Zero();
  int count = 0;
  double heaviest = 0.0;
  while (!loop.done()) {
    const bool counts = loop.plant().now() >= scenario.metrics_from;
    loop.advance();
    const Telemetry& seen = loop.pilot().law().telemetry();
    heaviest = std::max(heaviest, seen.mass_estimate);
    if (!counts) continue;
    square += seen.position_error.cwiseAbs2();
    ++count;
  }
  const Eigen::Vector3d rms = 100.0 * (square / count).cwiseSqrt();
  std::printf("scenario 1 at 838 rad/s: %.1f %.1f %.1f cm, at most %.2f kg\n", rms.x(), rms.y(),
              rms.z(), heaviest);
  EXPECT_FALSE(loop.plant().crashTime());
  EXPECT_LT(rms.x(), 1.15 * 33.2);
  EXPECT_LT(rms.y(), 1.15 * 45.5);
  EXPECT_LT(rms.z(), 1.15 * 41.5);
  EXPECT_LT(heaviest, 1.1 * 2.5);
}

}  // namespace
}  // namespace aqc
