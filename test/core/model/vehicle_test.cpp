#include "adaptive_quadrotor_control/model/vehicle.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "support/fixtures.h"
#include "support/refusal.h"

namespace aqc {
namespace {

using test::expectRefusal;
using test::replaced;

const std::string kGood = R"(
name: test
mass: 1.0
inertia: [0.01, 0.01, 0.02]
rotors:
  angles_deg: [0.0, 90.0, 180.0, -90.0]
  directions: [-1, 1, -1, 1]
  arm_length: 0.21
  force_constant: 1.0e-5
  moment_constant: 0.016
  max_speed: 800.0
  time_constant_up: 0.0125
  time_constant_down: 0.025
  drag_coefficient: 0.0
  rolling_moment_coefficient: 0.0
landing_gear: {height: 0.1, radius: 0.15}
)";

Vehicle read(const std::string& yaml) {
  const ParameterReader reader = test::readerOf(yaml, "vehicle");
  Vehicle vehicle = readVehicle(reader);
  reader.finish();
  return vehicle;
}

void expectRefused(const std::string& from, const std::string& to,
                   const std::vector<std::string>& parts) {
  expectRefusal([&] { read(replaced(kGood, from, to)); }, parts);
}

TEST(Vehicle, ReadsEveryValue) {
  const Vehicle vehicle = read(kGood);
  EXPECT_EQ(vehicle.name, "test");
  EXPECT_EQ(vehicle.mass, 1.0);
  EXPECT_EQ(vehicle.inertia(2, 2), 0.02);
  ASSERT_EQ(vehicle.rotors.size(), 4u);
  EXPECT_NEAR(vehicle.rotors[1].angle, M_PI_2, 1e-15);
  EXPECT_EQ(vehicle.rotors[0].direction, -1);
  EXPECT_EQ(vehicle.rotors[0].arm_length, 0.21);
  EXPECT_LT((vehicle.rotors[3].position() - Eigen::Vector2d(0.0, -0.21)).norm(), 1e-15);
  EXPECT_EQ(vehicle.time_constant_up, 0.0125);
  EXPECT_EQ(vehicle.time_constant_down, 0.025);
  EXPECT_EQ(vehicle.gear_height, 0.1);
  EXPECT_EQ(vehicle.gear_radius, 0.15);
  EXPECT_NEAR(vehicle.maxThrust(), 4.0 * 1e-5 * 800.0 * 800.0, 1e-12);
}

TEST(Vehicle, ReadsEveryVehicleFile) {
  for (const char* name : {"pelican_thesis", "pelican", "hummingbird", "firefly"}) {
    const Vehicle vehicle = test::vehicleNamed(name);
    EXPECT_EQ(vehicle.name, name);
    EXPECT_GT(vehicle.maxThrust(), 1.3 * vehicle.mass * kGravity) << name;
  }
  EXPECT_EQ(test::vehicleNamed("firefly").rotors.size(), 6u);
}

TEST(Vehicle, RefusesMassesThatAreNotPositive) {
  expectRefused("mass: 1.0", "mass: -2",
                {"'vehicle/mass'", "'-2'", "a finite number >= 0.001 and <= 1000"});
  expectRefused("mass: 1.0", "mass: 0", {"'vehicle/mass'", "'0'", ">= 0.001"});
  expectRefused("mass: 1.0", "mass: .inf", {"'vehicle/mass'", "'.inf'", "finite"});
  expectRefused("mass: 1.0", "mass: heavy", {"'vehicle/mass'", "'heavy'"});
  expectRefused("mass: 1.0\n", "", {"'vehicle/mass'", "missing", ">= 0.001"});
}

TEST(Vehicle, RefusesInertiasThatNoBodyHas) {
  expectRefused("[0.01, 0.01, 0.02]", "[0.01, -0.01, 0.02]",
                {"'vehicle/inertia'", "-0.01", "positive definite"});
  expectRefused("[0.01, 0.01, 0.02]", "[0.01, 0.01, 0.2]",
                {"'vehicle/inertia' is [0.01, 0.01, 0.2]", "a rigid body's", "is 10 times these",
                 "up to 1.5"});
  expectRefused("[0.01, 0.01, 0.02]", "[0.01, 0.01]", {"'vehicle/inertia'", "2 numbers"});
  expectRefused("[0.01, 0.01, 0.02]", "0.01", {"'vehicle/inertia'", "'0.01'", "list"});
}

TEST(Vehicle, RefusesThreeRotorsAndSeventeen) {
  expectRefused("[0.0, 90.0, 180.0, -90.0]", "[0, 120, 240]",
                {"'vehicle/rotors/angles_deg'", "3 rotors", "4 to 16"});
  expectRefused("[0.0, 90.0, 180.0, -90.0]", "[0,1,2,3,4,5,6,7,8,9,10,11,12,13,14,15,16]",
                {"'vehicle/rotors/angles_deg'", "17 rotors", "4 to 16"});
}

TEST(Vehicle, RefusesDirectionsThatDoNotFit) {
  expectRefused("[-1, 1, -1, 1]", "[-1, 1, -1]", {"'vehicle/rotors/directions'", "4 numbers"});
  for (const char* directions : {"[-1, 1, 0, 1]", "[-1, 1, 2, 1]", "[-1, 1, -1, 0.5]"}) {
    expectRefused("[-1, 1, -1, 1]", directions,
                  {"'vehicle/rotors/directions' is ", directions,
                   "1 (counter-clockwise) and -1 (clockwise)"});
  }
}

TEST(Vehicle, RefusesLayoutsThatCannotFly) {
  expectRefused("[-1, 1, -1, 1]", "[1, 1, 1, 1]",
                {"'vehicle/rotors/angles_deg' is [0.0, 90.0, 180.0, -90.0]", "independent",
                 "'directions' [1, 1, 1, 1]"});
  expectRefused("[0.0, 90.0, 180.0, -90.0]", "[0, 0, 180, 180]",
                {"'vehicle/rotors/angles_deg' is [0, 0, 180, 180]", "independent"});
}

TEST(Vehicle, RefusesEveryRotorConstantOutOfRange) {
  for (const char* key : {"arm_length", "force_constant", "moment_constant", "max_speed"}) {
    for (const char* value : {"0", "-1", ".nan", "text"}) {
      const std::string line = std::string(key) + ": ";
      const std::size_t start = kGood.find(line);
      const std::size_t end = kGood.find('\n', start);
      const std::string bad = kGood.substr(0, start) + line + value + kGood.substr(end);
      expectRefusal([&] { read(bad); },
                    {"'vehicle/rotors/" + std::string(key) + "'", value, "> 0"});
    }
  }
  expectRefused("time_constant_up: 0.0125", "time_constant_up: -0.1",
                {"'vehicle/rotors/time_constant_up'", "'-0.1'", ">= 0"});
  expectRefused("time_constant_down: 0.025", "time_constant_down: 11",
                {"'vehicle/rotors/time_constant_down'", "'11'", "<= 10"});
  for (const char* key : {"drag_coefficient", "rolling_moment_coefficient"}) {
    expectRefused(std::string(key) + ": 0.0", std::string(key) + ": -0.1",
                  {"'vehicle/rotors/" + std::string(key) + "'", "'-0.1'", ">= 0"});
  }
}

TEST(Vehicle, RefusesUnknownNames) {
  expectRefused("mass: 1.0", "mass: 1.0\nmas: 2.0", {"'vehicle/mas'", "unknown"});
  expectRefused("{height: 0.1,", "{hieght: 0.2, height: 0.1,",
                {"'vehicle/landing_gear/hieght'", "unknown"});
}

TEST(Vehicle, RefusesUnknownNamesInAFile) {
  EXPECT_EQ(loadVehicle(test::written("vehicle", kGood)).name, "test");
  const std::string path = test::written("vehicle", kGood + "mas: 2.0\n");
  expectRefusal([&] { loadVehicle(path); }, {path + "/mas'", "unknown"});
}

TEST(Vehicle, RotorsStandWithinOneTurn) {
  EXPECT_EQ(read(replaced(kGood, "[0.0, 90.0, 180.0, -90.0]", "[360, 90, 180, -90]")).name, "test");
  for (const char* angle : {"360.5", "-360.5"}) {
    expectRefused("[0.0, 90.0", std::string("[") + angle + ", 90.0",
                  {"'vehicle/rotors/angles_deg[0]'", angle, ">= -360 and <= 360"});
  }
}

TEST(Vehicle, StandsOnFourFeetBetweenItsAxes) {
  const auto feet = read(kGood).feet();
  const double side = 0.15 * M_SQRT1_2;
  const Eigen::Vector2d expected[] = {{side, side}, {-side, side}, {-side, -side}, {side, -side}};
  for (std::size_t i = 0; i < 4; ++i) EXPECT_LT((feet[i] - expected[i]).norm(), 1e-15) << i;
}

}  // namespace
}  // namespace aqc
