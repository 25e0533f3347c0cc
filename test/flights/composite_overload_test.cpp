#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <string>

#include "adaptive_quadrotor_control/simulation/closed_loop.h"
#include "adaptive_quadrotor_control/simulation/scenario.h"
#include "support/fixtures.h"
#include "support/hover_flights.h"

// When `composite` under a Pelican of 1 kg, which lifts 2.86 kg, has too much to carry: how soon
// that is told, and how level it sinks.
namespace aqc {
namespace {

constexpr double kHung = 5.0;  // [s]

struct Told {
  double after;  // [s]; infinity: never
  double tilt;   // until 2 s later [deg]
};

Told hang(double mass, double aside, bool imu, Nanoseconds delay = 0) {
  Scenario scenario = test::carrying(mass, aside, {kHung, 30.0}, kHung + 2.0);
  scenario.world.start.position.z() = 20.0;
  scenario.mission.set_points.front().set_point.position.z() = 20.0;
  const test::Flown flown(test::sensing(scenario, imu, delay), "pelican");
  const Told told = {flown.toldOverload() - kHung, flown.tilt(kHung, kHung + 2.0)};
  std::printf("%.1f kg at %.0f cm, IMU %d, %.0f ms late: told after %.2f s, tilt %.1f deg\n", mass,
              100.0 * aside, imu, 1e3 * toSeconds(delay), told.after, told.tilt);
  return told;
}

TEST(CompositeOverload, IsToldInHalfASecondAndTheVehicleStaysLevel) {
  for (const double mass : {1.8, 2.2, 3.0}) {
    const Told told = hang(mass, 0.0, true);
    EXPECT_LT(told.after, 0.5);
    EXPECT_LT(told.tilt, 2.0);
    EXPECT_LT(hang(mass, 0.0, true, 20'000'000).after, 0.5);
  }
}

TEST(CompositeOverload, IsToldWhenTheMomentOfThePayloadTakesTheThrust) {
  for (const double aside : {0.02, -0.02}) {
    const Told told = hang(1.7, aside, true);
    EXPECT_LT(told.after, 0.5);
    EXPECT_LT(told.tilt, 3.0);
  }
  EXPECT_EQ(hang(1.7, 0.0, true).after, INFINITY) << "centred it can be carried";
}

TEST(CompositeOverload, IsToldWithoutAnImuWithinASecond) {
  for (const double mass : {1.8, 2.2, 3.0}) {
    const Told told = hang(mass, 0.0, false);
    EXPECT_LT(told.after, 0.8);
    EXPECT_LT(told.tilt, 2.0);
  }
  EXPECT_LT(hang(1.7, 0.02, false, 20'000'000).after, 0.8);
}

TEST(CompositeOverload, IsNotToldOfWhatCanBeCarried) {
  EXPECT_EQ(hang(0.6, 0.03, true).after, INFINITY);
  EXPECT_EQ(hang(0.6, 0.03, false).after, INFINITY);
  EXPECT_EQ(hang(1.5, 0.0, true).after, INFINITY);
}

TEST(CompositeOverload, IsNotToldInAnyScenario) {
  for (const char* name : {"aggressive_manoeuvre", "payload_transport", "offset_payload"}) {
    const Scenario scenario = loadScenario(test::configFile(std::string("scenario/") + name));
    EXPECT_EQ(test::Flown(scenario, scenario.vehicle).toldOverload(), INFINITY) << name;
  }
}

// The pull of a payload that swings on a cable of 0.5 to 4 m makes m-hat go from 0.9 to 2.3 kg.
TEST(CompositeOverload, IsNotToldOfAPullThatComesAndGoes) {
  for (const double frequency : {0.5, 1.0, 1.5}) {
    for (const bool imu : {true, false}) {
      Scenario scenario = test::carrying(0.6, 0.0, {2.0, 30.0}, 20.0);
      ApplyDisturbance pull;
      pull.duration = fromSeconds(18.0);
      pull.amplitude.force.z() = 6.5;
      pull.angular_frequency = 2.0 * M_PI * frequency;
      scenario.mission.events.insert(scenario.mission.events.begin() + 1, {fromSeconds(4.0), pull});
      const test::Flown flown(test::sensing(scenario, imu, 0), "pelican");
      EXPECT_EQ(flown.toldOverload(), INFINITY) << frequency;
      EXPECT_FALSE(flown.crashed());
    }
  }
}

// A tenth less thrust than scenario 1 was flown with at its worst: T/W 1.14.
TEST(CompositeOverload, IsNotToldWithHardlyAnyThrustLeft) {
  const Scenario scenario = loadScenario(test::configFile("scenario/aggressive_manoeuvre"));
  Vehicle weak = test::pelican();
  weak.max_rotor_speed = 838.0;
  EXPECT_EQ(test::Flown(scenario, weak, weak).toldOverload(), INFINITY);
}

}  // namespace
}  // namespace aqc
