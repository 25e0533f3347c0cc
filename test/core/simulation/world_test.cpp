#include "adaptive_quadrotor_control/simulation/world.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <memory>
#include <string>

#include "adaptive_quadrotor_control/simulation/scenario.h"
#include "support/fixtures.h"
#include "support/refusal.h"

namespace aqc {
namespace {

using test::expectRefusal;
using test::replaced;

const std::string kWorld = R"(
control_rate: 100.0
plant_rate: 1000.0
start: {position: [1.0, 2.0, 0.1], yaw_deg: 90.0}
payloads:
  box: {mass: 0.5, size: [0.1, 0.2, 0.3], offset: [0.0, 0.0, -0.15], place: [3.0, 4.0]}
  rod: {mass: 0.1, size: [0.1, 0.1, 0.1], offset: [0.1, 0.0, 0.0]}
walls: [{min: [0, 0, 0], max: [1, 2, 3]}]
)";

// Of no use, but none of the world's business; only the names that a scenario has are known.
const std::string kRest = R"(
name: [1, 2]
duration: -1
mission:
  - path: {at: 1.0, through: [{at: 0.5, speling: 3}, {position: nowhere}]}
  - conjure: {payload: elephant}
metrics: {from: never, until: {the: end}}
published: {asmc: 7}
)";

World readAlone(const std::string& yaml) {
  const ParameterReader reader = test::readerOf(yaml, "scenario");
  World world = readWorldAlone(reader);
  reader.finish();
  return world;
}

TEST(World, IsReadWithoutAMission) {
  for (const std::string& rest : {std::string(), kRest}) {
    const World world = readAlone(kWorld + rest);
    EXPECT_EQ(world.start.position, Eigen::Vector3d(1.0, 2.0, 0.1));
    EXPECT_EQ(world.control_period, 10'000'000);
    EXPECT_EQ(world.plant_step, 1'000'000);
    EXPECT_TRUE(world.ground);
    ASSERT_EQ(world.walls.size(), 1u);
    EXPECT_EQ(world.walls[0].max, Eigen::Vector3d(1.0, 2.0, 3.0));
    ASSERT_EQ(world.cargo.size(), 1u) << "the rod appears when it is attached";
    EXPECT_EQ(world.cargo[0].name, "box");
    EXPECT_EQ(world.cargo[0].position, Eigen::Vector3d(3.0, 4.0, 0.15));
    EXPECT_EQ(world.payloads.size(), 2u);
    EXPECT_EQ(world.payloads.at("rod").mass, 0.1);
  }
}

TEST(World, AloneRefusesItsOwnMistakesAndNamesOfNoScenario) {
  expectRefusal([] { readAlone(kWorld + "wals: []\n"); }, {"'scenario/wals'", "unknown"});
  expectRefusal([] { readAlone(replaced(kWorld, "size: [0.1, 0.1", "sizes: 1, size: [0.1, 0.1")); },
                {"'scenario/payloads/rod/sizes'", "unknown"});
  expectRefusal([] { readAlone(replaced(kWorld, "max: [1, 2, 3]", "max: [1, 0, 3]")); },
                {"'scenario/walls[0]/max'", "above 'min'"});
  expectRefusal([] { readAlone(replaced(kWorld, "plant_rate: 1000.0", "plant_rate: 150.0")); },
                {"'scenario/plant_rate'", "whole multiple"});
}

TEST(World, HasATimeOutOfCommandsOnlyWhenItIsGiven) {
  EXPECT_FALSE(readAlone(kWorld).command_timeout);
  EXPECT_FALSE(readAlone(kWorld + "rotors: {}\n").command_timeout);
  EXPECT_EQ(readAlone(kWorld + "rotors: {command_timeout: 0.25}\n").command_timeout, 250'000'000);
  EXPECT_EQ(readAlone(kWorld + "rotors: {command_timeout: 0}\n").command_timeout, 0);
  expectRefusal([] { readAlone(kWorld + "rotors: {command_timeout: 0.01}\n"); },
                {"'scenario/rotors/command_timeout' is '0.01'", "0 for none", "0.01 s"});
  expectRefusal([] { readAlone(kWorld + "rotors: {command_timeout: -1}\n"); },
                {"'scenario/rotors/command_timeout' is '-1'", ">= 0"});
}

TEST(World, IsTheSameAloneAndInEveryScenario) {
  const std::string folder = test::sourceTree() + "/config/scenario";
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    const std::string path = entry.path().string();
    const ParameterReader reader(loadYamlFile(path), path);
    const World alone = readWorldAlone(reader);
    EXPECT_NO_THROW(reader.finish());
    const World whole = loadScenario(path).world;
    EXPECT_TRUE(test::sameBits(alone.start, whole.start)) << path;
    EXPECT_EQ(alone.walls.size(), whole.walls.size()) << path;
    EXPECT_EQ(alone.cargo.size(), whole.cargo.size()) << path;
    EXPECT_EQ(alone.ground, whole.ground) << path;
    EXPECT_EQ(alone.plant_step, whole.plant_step) << path;
    EXPECT_EQ(alone.control_period, whole.control_period) << path;
  }
}

TEST(World, MakesAPlantThatStandsInIt) {
  World world = readAlone(kWorld);
  const Vehicle vehicle = test::pelican();
  std::unique_ptr<Plant> plant = makePlant(vehicle, world);
  EXPECT_TRUE(plant->hasGround());
  EXPECT_TRUE(test::sameBits(plant->state().position, world.start.position));
  world.ground = false;
  EXPECT_FALSE(makePlant(vehicle, world)->hasGround());
  world.start.position = {0.5, 1.0, 1.5};  // inside the wall
  plant = makePlant(vehicle, world);
  plant->step(RotorArray::Zero(4), 1e-3);
  EXPECT_EQ(plant->crash(), Crash::kWallStrike);
}

}  // namespace
}  // namespace aqc
