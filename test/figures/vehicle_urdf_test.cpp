#include "figures/vehicle_urdf.h"

#include <gtest/gtest.h>

#include <cmath>
#include <regex>

#include "support/fixtures.h"

namespace aqc {
namespace {

int count(const std::string& text, const std::string& word) {
  int found = 0;
  for (std::size_t at = text.find(word); at != std::string::npos; at = text.find(word, at + 1)) {
    ++found;
  }
  return found;
}

TEST(VehicleUrdf, DrawsEveryVehicleFromItsNumbers) {
  for (const std::string name : {"pelican", "pelican_thesis", "hummingbird", "firefly"}) {
    const Vehicle vehicle = test::vehicleNamed(name);
    const std::string urdf = vehicleUrdf(vehicle);
    EXPECT_EQ(count(urdf, "<link "), 1) << name;
    EXPECT_EQ(count(urdf, "<visual>"), count(urdf, "</visual>")) << name;
    const int rotors = static_cast<int>(vehicle.rotors.size());
    EXPECT_EQ(count(urdf, "0.25 0.60 1.00"), rotors / 2) << "counter-clockwise";
    EXPECT_EQ(count(urdf, "1.00 0.62 0.15"), rotors / 2) << "clockwise";
    EXPECT_FALSE(std::regex_search(urdf, std::regex("nan|inf"))) << urdf;
  }
}

TEST(VehicleUrdf, RotorsAreWhereTheyAre) {
  Vehicle vehicle = test::pelican();
  vehicle.rotors[0].angle = 0.0;
  vehicle.rotors[0].arm_length = 0.33;
  EXPECT_NE(vehicleUrdf(vehicle).find("xyz=\"0.33 0 "), std::string::npos);
}

TEST(VehicleUrdf, CoaxialRotorsHaveDiscs) {
  Vehicle vehicle = test::pelican();
  const std::vector<Rotor> upper = vehicle.rotors;
  for (Rotor rotor : upper) {
    rotor.direction = -rotor.direction;
    vehicle.rotors.push_back(rotor);
  }
  EXPECT_EQ(count(vehicleUrdf(vehicle), "radius=\"0\""), 0);
}

TEST(VehicleUrdf, NamesCannotBreakIt) {
  Vehicle vehicle = test::pelican();
  vehicle.name = "a\"<&b";
  EXPECT_NE(vehicleUrdf(vehicle).find("\"a&quot;&lt;&amp;b\""), std::string::npos);
}

// Arms of 0.5 m along the axes: hubs 0.5 sqrt(2) m apart, legs at 0.1 sqrt(2) m from the middle.
TEST(VehicleUrdf, EveryPartIsWhereItBelongs) {
  Vehicle vehicle = test::pelican();
  for (std::size_t i = 0; i < 4; ++i) {
    vehicle.rotors[i].arm_length = 0.5;
    vehicle.rotors[i].angle = 0.5 * M_PI * static_cast<double>(i);
  }
  vehicle.gear_height = 0.4;
  vehicle.gear_radius = 0.1 * std::sqrt(2.0);
  const std::string urdf = vehicleUrdf(vehicle);
  EXPECT_EQ(count(urdf, "<cylinder radius=\"0.18\" length=\"0.11\"/>"), 1) << "body";
  EXPECT_EQ(count(urdf, "<origin xyz=\"0.18 0 0.055\" "), 1) << "nose";
  EXPECT_EQ(count(urdf, "<cylinder radius=\"0.325269\" length=\"0.012\"/>"), 4) << "discs";
  EXPECT_EQ(count(urdf, "<origin xyz=\"0.5 0 0.09\" "), 1) << "disc in front";
  EXPECT_EQ(count(urdf, "<cylinder radius=\"0.006\" length=\"0.4\"/>"), 4) << "legs";
  for (const char* foot : {"0.1 0.1", "-0.1 0.1", "-0.1 -0.1", "0.1 -0.1"}) {
    EXPECT_EQ(count(urdf, "xyz=\"" + std::string(foot) + " -0.2\""), 1) << foot;
  }
  EXPECT_EQ(count(urdf, "<box size=\"0.282843 0.006 0.006\"/>"), 2) << "rails";
  EXPECT_EQ(count(urdf, "rpy=\"0 0 0.785398\""), 1);
  EXPECT_EQ(count(urdf, "rpy=\"0 0 -0.785398\""), 1);
  // The nearest two of an uneven set, at 100 and 180 deg, are sin 40 deg apart.
  vehicle.rotors[1].angle = M_PI * 100.0 / 180.0;
  EXPECT_EQ(count(vehicleUrdf(vehicle), "<cylinder radius=\"0.295682\" length=\"0.012\"/>"), 4);
}

}  // namespace
}  // namespace aqc
