#include "figures/vehicle_urdf.h"

#include <gtest/gtest.h>

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

}  // namespace
}  // namespace aqc
