#include <gtest/gtest.h>
#include <yaml-cpp/yaml.h>

#include <string>

#include "adaptive_quadrotor_control/model/vehicle.h"
#include "adaptive_quadrotor_control/parameters/parameter_reader.h"
#include "adaptive_quadrotor_control/simulation/scenario.h"
#include "support/leaves.h"
#include "support/refusal.h"
#include "support/source_tree.h"

// No number of a file may be so large that the plant has no answer to it: every one that is finite,
// but absurd, is refused by its name.
namespace aqc {
namespace {

using Read = void (*)(const ParameterReader&);

void expectEveryNumberBounded(const std::string& path, Read read) {
  YAML::Node tree = loadYamlFile(path);
  read(ParameterReader(tree, "file"));
  int count = 0;
  test::forEachNumber(tree, "file", [&](const std::string& name, YAML::Node leaf) {
    const std::string value = leaf.Scalar();
    const std::string list = name.back() == ']' ? name.substr(0, name.rfind('[')) : name + "'";
    for (const char* absurd : {"1e300", "-1e300", "1e12"}) {
      leaf = absurd;
      test::expectRefusal([&] { read(ParameterReader(tree, "file")); }, {"'" + list, absurd});
    }
    leaf = value;
    ++count;
  });
  EXPECT_GE(count, 18) << path;
}

TEST(AbsurdNumbers, AreRefusedInVehicleFiles) {
  for (const char* name : {"firefly", "hummingbird", "lifter", "pelican_thesis"}) {
    expectEveryNumberBounded(test::configFile(std::string("vehicle/") + name),
                             [](const ParameterReader& reader) { readVehicle(reader); });
  }
}

TEST(AbsurdNumbers, AreRefusedInScenarioFiles) {
  const Read read = [](const ParameterReader& reader) { readScenario(reader); };
  for (const char* name : {"aggressive_manoeuvre", "payload_transport", "vertical_lift"}) {
    expectEveryNumberBounded(test::configFile(std::string("scenario/") + name), read);
  }
  expectEveryNumberBounded(test::sourceTree() + "/test/apps/every_event.yaml", read);
}

TEST(AbsurdNumbers, AreNotThoseOfTheLightestAndTheHeaviestMultirotors) {
  const auto read = [](const std::string& facts) {
    return readVehicle(test::readerOf(
        facts + "\n  angles_deg: [45, 135, -135, -45]\n  directions: [1, -1, 1, -1]", "vehicle"));
  };
  EXPECT_EQ(read(R"(
name: 10 g
mass: 0.01
inertia: [1.0e-6, 1.0e-6, 2.0e-6]
landing_gear: {height: 0.005, radius: 0.02}
rotors:
  arm_length: 0.03
  force_constant: 5.0e-9
  moment_constant: 0.003
  max_speed: 5000.0
  time_constant_up: 0.02
  time_constant_down: 0.02
  drag_coefficient: 1.0e-8
  rolling_moment_coefficient: 1.0e-10)")
                .mass,
            0.01);
  EXPECT_EQ(read(R"(
name: 500 kg
mass: 500.0
inertia: [900.0, 1100.0, 1900.0]
landing_gear: {height: 0.8, radius: 1.5}
rotors:
  arm_length: 3.0
  force_constant: 0.03
  moment_constant: 0.1
  max_speed: 400.0
  time_constant_up: 0.3
  time_constant_down: 0.5
  drag_coefficient: 0.02
  rolling_moment_coefficient: 0.01)")
                .mass,
            500.0);
}

TEST(AbsurdNumbers, AreThoseOfInertiasThatNoVehicleHas) {
  const std::string path = test::configFile("vehicle/pelican");
  const auto expectRefused = [&](const std::string& inertia, const std::string& says) {
    YAML::Node tree = loadYamlFile(path);
    tree["inertia"] = YAML::Load(inertia);
    test::expectRefusal([&] { readVehicle(ParameterReader(tree, "vehicle")); },
                        {"'vehicle/inertia' is " + inertia, says});
  };
  expectRefused("[1e-12, 1e-12, 1e-12]", "smallest principal moment is 1e-12; it must be >= 1e-09");
  // Its diagonal could be a rigid body's; its principal moments are 0.01, 0.01 and 0.1.
  expectRefused("[0.055, 0.055, 0.01, 0.045, 0, 0]", "largest is 5 times these (up to 1.5");
}

}  // namespace
}  // namespace aqc
