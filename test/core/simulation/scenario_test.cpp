#include "adaptive_quadrotor_control/simulation/scenario.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <string>
#include <vector>

#include "adaptive_quadrotor_control/math/rotations.h"
#include "support/fixtures.h"
#include "support/refusal.h"

namespace aqc {
namespace {

using test::expectRefusal;
using test::replaced;

const std::string kGood = R"(
name: short
title: "A short flight"
vehicle: pelican
controllers: [asmc, smc]
duration: 30.0
control_rate: 100.0
plant_rate: 1000.0
set_point_rate: 50.0
start: {position: [1.0, 2.0, 0.1], yaw_deg: 90.0}
payloads:
  box: {mass: 0.5, size: [0.1, 0.2, 0.3], offset: [0.0, 0.0, -0.15]}
  rod: {mass: 0.1, size: [0.1, 0.1, 0.1], offset: [0.1, 0.0, 0.0], inertia: [1, 2, 2.5]}
mission:
  - step: {at: 5.0, position: [1.0, 2.0, 1.5]}
  - attach: {at: 10.0, payload: box}
  - detach: {at: 20.0}
metrics: {from: 10.0}
published:
  asmc: {position: [0.1, 0.2, 0.3], attitude_deg: [1.0, 2.0, 3.0]}
)";

Scenario read(const std::string& yaml) {
  const ParameterReader reader = test::readerOf(yaml, "scenario");
  Scenario scenario = readScenario(reader);
  reader.finish();
  return scenario;
}

void expectRefused(const std::string& from, const std::string& to,
                   const std::vector<std::string>& parts) {
  expectRefusal([&] { read(replaced(kGood, from, to)); }, parts);
}

TEST(Scenario, MayStartTiltedWithoutGroundAndSwitch) {
  const std::string tilted =
      replaced(kGood, "yaw_deg: 90.0}", "yaw_deg: 90.0, roll_deg: 10, pitch_deg: -20}");
  const std::string yaml =
      replaced(tilted, "- attach:", "- switch: {at: 6.0, subsystem: 3}\n  - attach:");
  const Scenario scenario = read(yaml + "ground: false\n");
  const Eigen::Vector3d angles = rollPitchYaw(scenario.world.start.attitude) * 180.0 / M_PI;
  EXPECT_LT((angles - Eigen::Vector3d(10.0, -20.0, 90.0)).norm(), 1e-9);
  EXPECT_FALSE(scenario.world.ground);
  ASSERT_EQ(scenario.mission.switches.size(), 1u);
  EXPECT_EQ(scenario.mission.switches[0].subsystem, 3);
  EXPECT_TRUE(read(kGood).world.ground);
}

TEST(Scenario, ReadsEveryValue) {
  const Scenario scenario = read(kGood);
  EXPECT_EQ(scenario.name, "short");
  EXPECT_EQ(scenario.title, "A short flight");
  EXPECT_EQ(scenario.vehicle, "pelican");
  EXPECT_EQ(scenario.controllers, (std::vector<std::string>{"asmc", "smc"}));
  EXPECT_EQ(scenario.duration, 30'000'000'000);
  EXPECT_EQ(scenario.world.control_period, 10'000'000);
  EXPECT_EQ(scenario.world.plant_step, 1'000'000);
  EXPECT_EQ(scenario.world.start.position, Eigen::Vector3d(1.0, 2.0, 0.1));
  EXPECT_NEAR(rollPitchYaw(scenario.world.start.attitude).z(), M_PI_2, 1e-12);
  ASSERT_EQ(scenario.mission.set_points.size(), 1u);
  EXPECT_EQ(scenario.mission.set_points[0].time, 5'000'000'000);
  EXPECT_NEAR(scenario.mission.set_points[0].set_point.yaw, M_PI_2, 1e-12) << "as at the start";
  ASSERT_EQ(scenario.mission.events.size(), 2u);
  EXPECT_EQ(scenario.mission.events[0].time, 10'000'000'000);
  EXPECT_EQ(std::get<AttachPayload>(scenario.mission.events[0].action).payload.mass, 0.5);
  EXPECT_EQ(scenario.lastPayloadChange(), 20'000'000'000);
  EXPECT_EQ(scenario.metrics_from, 10'000'000'000);
  const MetricsWindow window = metricsWindow(scenario);
  EXPECT_EQ(window.from, scenario.metrics_from);
  EXPECT_EQ(window.last_payload_change, scenario.lastPayloadChange());
  EXPECT_EQ(window.end, scenario.duration);
  EXPECT_EQ(scenario.published.at("asmc").position, Eigen::Vector3d(0.1, 0.2, 0.3));
}

TEST(Scenario, LastPayloadChangeIsThatOfTheLastAttachOrDetach) {
  Scenario scenario;
  EXPECT_EQ(scenario.lastPayloadChange(), 0);
  scenario.mission.events = {{fromSeconds(8.0), AttachPayload{"box", test::box(0.5)}},
                             {fromSeconds(9.0), SetWind{Eigen::Vector3d::Zero()}},
                             {fromSeconds(9.0), SetRotor()},
                             {fromSeconds(9.0), SetBattery()},
                             {fromSeconds(9.0), SetGust()},
                             {fromSeconds(9.0), LoseCommands()}};
  EXPECT_EQ(scenario.lastPayloadChange(), fromSeconds(8.0)) << "wind is no payload";
}

TEST(Scenario, PayloadsAreSolidBoxesUnlessTheirInertiaIsGiven) {
  std::string yaml = kGood;
  EXPECT_TRUE(std::get<AttachPayload>(read(yaml).mission.events[0].action)
                  .payload.inertia.isApprox(boxInertia(0.5, {0.1, 0.2, 0.3})));
  yaml = replaced(kGood, "payload: box", "payload: rod");
  EXPECT_EQ(std::get<AttachPayload>(read(yaml).mission.events[0].action).payload.inertia.diagonal(),
            Eigen::Vector3d(1.0, 2.0, 2.5));
}

// Leaves not-a-number behind where the next function and the next allocations put their values.
[[gnu::noinline]] void soilMemory() {
  volatile double stack[4096];
  for (volatile double& value : stack) value = std::numeric_limits<double>::quiet_NaN();
  for (std::size_t size = 1; size < 4096; size *= 2) {
    const std::vector<double> heap(size, double(stack[0]));
    EXPECT_TRUE(std::isnan(heap.back()));
  }
}

TEST(Scenario, CargoLiesStillAtTheStart) {
  const std::string file = test::configFile("scenario/payload_transport");
  const ParameterReader reader(loadYamlFile(file), file);
  soilMemory();
  const World world = readWorld(reader);
  ASSERT_GE(world.cargo.size(), 2u);
  for (const Cargo& cargo : world.cargo) {
    EXPECT_EQ(cargo.velocity, Eigen::Vector3d::Zero()) << cargo.name;
    EXPECT_EQ(cargo.position.z(), 0.5 * cargo.payload.size.z()) << cargo.name;
  }
}

TEST(Scenario, ReadsEveryScenarioFile) {
  int count = 0;
  for (const auto& entry :
       std::filesystem::directory_iterator(test::sourceTree() + "/config/scenario")) {
    const Scenario scenario = loadScenario(entry.path().string());
    EXPECT_EQ(scenario.name, entry.path().stem().string());
    EXPECT_NO_THROW(test::vehicleNamed(scenario.vehicle)) << scenario.name;
    for (const std::string& controller : scenario.controllers) {
      EXPECT_NO_THROW(test::lawNamed(controller, test::vehicleNamed(scenario.vehicle)));
    }
    ++count;
  }
  EXPECT_GE(count, 1);
}

TEST(Scenario, RefusesRatesThatDoNotFit) {
  expectRefused("plant_rate: 1000.0", "plant_rate: 150.0",
                {"'scenario/plant_rate' is '150.0'", "whole multiple", "'100.0'", "6666667 ns"});
  expectRefused("plant_rate: 1000.0", "plant_rate: 50.0",
                {"'scenario/plant_rate'", "whole multiple"});
  expectRefused("control_rate: 100.0", "control_rate: 0.0",
                {"'scenario/control_rate'", "'0.0'", ">= 1 and <= 100000"});
  expectRefused("set_point_rate: 50.0", "set_point_rate: .inf",
                {"'scenario/set_point_rate'", "'.inf'", "finite"});
}

TEST(Scenario, RefusesDurationsThatAreTooShort) {
  expectRefused("duration: 30.0", "duration: 15.0",
                {"'scenario/duration' is '15.0'", "lasts until 20 s"});
  expectRefused("duration: 30.0", "duration: -1", {"'scenario/duration'", "'-1'", "> 0"});
  expectRefused("from: 10.0", "from: 30.0",
                {"'scenario/metrics/from' is '30.0'", "before the end", "30 s"});
  expectRefused("from: 10.0", "from: 1.0e+300",
                {"'scenario/metrics/from' is '1.0e+300'", "<= 1000000"});
  expectRefused("from: 10.0", "from: -1.0", {"'scenario/metrics/from'", "'-1.0'", ">= 0"});
}

TEST(Scenario, RefusesPayloadsThatMakeNoSense) {
  expectRefused("mass: 0.5", "mass: -0.5", {"'scenario/payloads/box/mass'", "'-0.5'", "> 0"});
  expectRefused("size: [0.1, 0.2, 0.3]", "size: [0.1, 0, 0.3]",
                {"'scenario/payloads/box/size[1]'", "'0'", "> 0"});
  expectRefused("offset: [0.0, 0.0, -0.15]", "offset: [0.0, 0.0, .nan]",
                {"'scenario/payloads/box/offset[2]'", "'.nan'", "finite"});
  expectRefused("inertia: [1, 2, 2.5]", "inertia: [1, 2, 30]",
                {"'scenario/payloads/rod/inertia' is [1, 2, 30]", "10 times these"});
  expectRefused("inertia: [1, 2, 2.5]", "inertia: [1, -2, 2.5]",
                {"'scenario/payloads/rod/inertia'", "-2", "positive definite"});
  expectRefused("payload: box", "payload: crate", {"'crate'", "'payloads'"});
}

TEST(Scenario, RefusesPayloadsThatLieOnAGroundThatIsNotThere) {
  const std::string lying =
      replaced(kGood, "offset: [0.0, 0.0, -0.15]}", "offset: [0.0, 0.0, -0.15], place: [1, 2]}");
  EXPECT_EQ(read(lying).world.cargo.size(), 1u);
  expectRefusal([&] { read(lying + "ground: false\n"); },
                {"'scenario/payloads/box/place'", "'ground' is false"});
}

TEST(Scenario, RefusesWallsInsideOut) {
  expectRefused("metrics:", "walls: [{min: [0, 0, 0], max: [1, 0, 1]}]\nmetrics:",
                {"'scenario/walls[0]/max' is [1, 0, 1]", "above", "[0, 0, 0]"});
}

TEST(Scenario, RefusesWhatIsMissingUnknownOrMistyped) {
  for (const char* line : {"name: short\n", "vehicle: pelican\n", "controllers: [asmc, smc]\n",
                           "duration: 30.0\n", "control_rate: 100.0\n", "plant_rate: 1000.0\n",
                           "set_point_rate: 50.0\n", "metrics: {from: 10.0}\n"}) {
    const std::string key = std::string(line).substr(0, std::string(line).find(':'));
    expectRefused(line, "", {"'scenario/" + key + "'", "missing"});
  }
  expectRefused("duration: 30.0", "duration: 30.0\nspeed: 1", {"'scenario/speed'", "unknown"});
  expectRefused("controllers: [asmc, smc]", "controllers: asmc",
                {"'scenario/controllers'", "a list of texts"});
  expectRefused("position: [1.0, 2.0, 0.1]", "position: [1.0, 2.0]",
                {"'scenario/start/position'", "3 numbers"});
  expectRefused("position: [0.1, 0.2, 0.3]", "position: [0.1, 0.2, -0.3]",
                {"'scenario/published/asmc/position[2]'", "'-0.3'", ">= 0"});
}

TEST(Scenario, LastsAsLongAsItsLastSetPointEventAndSwitch) {
  const std::string early = "  - switch: {at: 6.0, subsystem: 1}\n";
  const std::string step = "  - step: {at: 25.0, position: [1.0, 2.0, 1.5]}\n";
  const std::string late = "  - switch: {at: 26.0, subsystem: 2}\n";
  const struct {
    std::string first, last;  // entries of the mission besides
    const char* until;
  } cases[] = {{"", "", "20"}, {early, "", "20"}, {"", step, "25"}, {early, late, "26"}};
  for (const auto& [first, last, until] : cases) {
    std::string yaml = replaced(kGood, "metrics:", last + "metrics:");
    yaml = replaced(yaml, "  - attach:", first + "  - attach:");
    const auto lasting = [&](const std::string& duration) {
      read(replaced(yaml, "duration: 30.0", "duration: " + duration));
    };
    EXPECT_NO_THROW(lasting(until));
    const std::string less = std::to_string(std::stod(until) - 0.5);
    expectRefusal([&] { lasting(less); }, {std::string("lasts until ") + until + " s"});
  }
}

TEST(Scenario, TheFirstLegBeginsAtTheStart) {
  const Scenario scenario =
      read(replaced(kGood, "  - step: {at: 5.0, position: [1.0, 2.0, 1.5]}\n",
                    "  - path: {at: 5.0, through: [{at: 8.0, position: [3.0, -2.0, 1.5]}]}\n"));
  const SetPoint& first = scenario.mission.set_points.front().set_point;
  EXPECT_LT((first.position - Eigen::Vector3d(1.0, 2.0, 0.1)).norm(), 1e-12);
  EXPECT_NEAR(first.yaw, M_PI_2, 1e-12);
}

TEST(Scenario, StartsLessThanUprightButNeverOnItsSide) {
  EXPECT_NO_THROW(
      read(replaced(kGood, "yaw_deg: 90.0}", "yaw_deg: 0, roll_deg: -89, pitch_deg: 89}")));
  for (const std::string angle : {"roll_deg", "pitch_deg"}) {
    for (const char* value : {"89.5", "-89.5"}) {
      expectRefused("yaw_deg: 90.0}", "yaw_deg: 0, " + angle + ": " + value + "}",
                    {"'scenario/start/" + angle + "'", value, ">= -89 and <= 89"});
    }
  }
  expectRefused("yaw_deg: 90.0}", "yaw_deg: -360.5}",
                {"'scenario/start/yaw_deg'", "-360.5", ">= -360 and <= 360"});
}

}  // namespace
}  // namespace aqc
