#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <exception>
#include <stdexcept>
#include <utility>
#include <vector>

#include "adaptive_quadrotor_control/law/law_factory.h"
#include "adaptive_quadrotor_control/parameters/parameter_reader.h"
#include "adaptive_quadrotor_control/simulation/closed_loop.h"
#include "fuzz/range.h"
#include "fuzz/shipped.h"
#include "fuzz/targets.h"
#include "support/source_tree.h"

namespace aqc::fuzz {
namespace {

constexpr Nanoseconds kMostPlantSteps =
    3000;  // of a flight, lest a scenario of 100 kHz takes a minute

constexpr double kMostSetPointRate = 1000.0;  // [Hz]

// What is wrong with `act()`, or with what it throws.
template <typename Act>
std::string findingOf(const Act& act) {
  try {
    return act();
  } catch (const ParameterError& error) {
    return *error.what() == '\0' ? "refused without a word" : "";
  } catch (const std::invalid_argument& error) {
    return *error.what() == '\0' ? "refused without a word" : "";
  } catch (const std::exception& error) {
    return std::string("it throws what nobody expects: ") + error.what();
  }
}

// `use(reader)` for a text that is a map in YAML, as loadYamlFile() has it.
template <typename Use>
std::string readText(const std::string& yaml, const Use& use) {
  YAML::Node tree;
  try {
    tree = YAML::Load(yaml);
  } catch (const YAML::Exception&) {
    return "";
  }
  return findingOf([&]() -> std::string { return use(ParameterReader(tree, "it")); });
}

std::string flyFor(double seconds, const Scenario& scenario, const Vehicle& vehicle,
                   std::unique_ptr<ControlLaw> law) {
  const World& world = scenario.world;
  const Nanoseconds most = std::min(fromSeconds(seconds), kMostPlantSteps * world.plant_step);
  if (world.control_period > most) return "";
  ClosedLoop loop(scenario, vehicle, std::move(law));
  while (!loop.done() && loop.plant().now() < most) {
    loop.advance();
    loop.sample();
    std::string finding = outOfRange(loop.pilot().allocation().speeds, vehicle);
    if (finding.empty() && !loop.plant().plant().state().valid()) finding = "the plant is nowhere";
    if (!finding.empty()) return finding + ", at " + std::to_string(loop.plant().now()) + " ns";
  }
  return "";
}

// Something to do at once: up, aside, and a payload. Without ground it suits vehicles of so little
// inertia that the plant's step is too long for them to stand.
const Scenario& briefScenario(bool ground) {
  static const Scenario on_ground = [] {
    const ParameterReader reader(YAML::Load(R"(
name: brief
title: Up and aside
vehicle: pelican_thesis
controllers: []
duration: 1.0
control_rate: 250.0
plant_rate: 1000.0
set_point_rate: 250.0
start: {position: [0.0, 0.0, 0.1], yaw_deg: 10.0}
payloads:
  box: {mass: 0.3, size: [0.1, 0.1, 0.1], offset: [0.01, 0.02, -0.15]}
mission:
  - step: {at: 0.0, position: [0.3, 0.0, 1.0], yaw_deg: 20.0}
  - attach: {at: 0.15, payload: box}
  - switch: {at: 0.15, subsystem: 2}
  - detach: {at: 0.2}
metrics: {from: 0.0}
)"),
                                 "brief");
    return readScenario(reader);
  }();
  static const Scenario in_the_air = [] {
    Scenario copy = on_ground;
    copy.world.ground = false;
    return copy;
  }();
  return ground ? on_ground : in_the_air;
}

}  // namespace

std::string flyVehicleText(const std::string& yaml) {
  return readText(yaml, [](const ParameterReader& reader) -> std::string {
    const Vehicle vehicle = readVehicle(reader);
    reader.finish();
    for (const std::string& law : lawNames()) {
      const std::string finding = findingOf([&] {
        const ParameterReader gains(loadYamlFile(test::configFile("controller/" + law)), law);
        return flyFor(0.25, briefScenario(law != "switched"), vehicle, makeLaw(gains, vehicle));
      });
      if (!finding.empty()) return law + ": " + finding;
    }
    return "";
  });
}

std::string flyLawText(const std::string& yaml) {
  return readText(yaml, [](const ParameterReader& reader) -> std::string {
    for (const bool ground : {true, false}) {
      const Vehicle& vehicle = shippedVehicle(ground ? "pelican_thesis" : "lifter_lag");
      std::unique_ptr<ControlLaw> law = makeLaw(reader, vehicle);
      reader.finish();
      const std::string finding = flyFor(0.5, briefScenario(ground), vehicle, std::move(law));
      if (!finding.empty()) return vehicle.name + ": " + finding;
    }
    return "";
  });
}

std::string flyScenarioText(const std::string& yaml) {
  return readText(yaml, [](const ParameterReader& reader) -> std::string {
    // A million set points a path are allowed, and take seconds.
    if (reader.number("set_point_rate", Range::any()) > kMostSetPointRate) return "";
    const Scenario scenario = readScenario(reader);
    reader.finish();
    std::string law = "asmc";  // whatever else it names is not this target's affair
    for (const std::string& name : scenario.controllers) {
      const std::vector<std::string> known = lawNames();
      if (std::find(known.begin(), known.end(), name) != known.end()) law = name;
    }
    const std::string vehicle = scenario.world.ground ? "pelican_thesis" : "lifter_lag";
    return flyFor(3.0, scenario, shippedVehicle(vehicle), shippedLaw(law, vehicle));
  });
}

}  // namespace aqc::fuzz
