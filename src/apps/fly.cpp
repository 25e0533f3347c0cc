// Flies a scenario without ROS: a table on the terminal, CSV, JSON and figures in files.

#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <iostream>
#include <memory>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "adaptive_quadrotor_control/law/law_factory.h"
#include "adaptive_quadrotor_control/parameters/parameter_reader.h"
#include "adaptive_quadrotor_control/simulation/flight_simulation.h"
#include "figures/flight_figures.h"
#include "report/flight_files.h"
#include "report/flight_table.h"
#include "report/progress_bar.h"
#include "report/recording.h"
#include "report/resources.h"
#include "report/run_program.h"

namespace aqc {
namespace {

// Every control step is kept in memory, about 1.5 kB each.
constexpr Nanoseconds kMaxSteps = 500'000;

struct Options {
  std::string scenario;
  std::vector<std::string> controllers;
  std::string vehicle;
  std::string out;
  std::string json;
  bool no_plots = false;
};

struct NamedLaw {
  std::string name;
  std::unique_ptr<ControlLaw> law;
};

// Loads all of them before anything flies, so that a mistake in the last one shows at once.
std::vector<NamedLaw> loadControllers(const std::string& config,
                                      const std::vector<std::string>& names,
                                      const Vehicle& vehicle) {
  if (names.empty())
    throw std::runtime_error("the scenario names no controllers; use --controller");
  std::vector<NamedLaw> controllers;
  for (const std::string& wanted : names) {
    const std::string path = findResource(config, "controller", wanted);
    const std::string name = resourceName(path);
    for (const NamedLaw& other : controllers) {
      if (other.name == name) {
        throw std::runtime_error("controller '" + name + "' is given twice; files are named by it");
      }
    }
    controllers.push_back({name, loadLaw(path, vehicle)});
  }
  return controllers;
}

void checkLength(const Scenario& scenario) {
  const Nanoseconds steps = scenario.duration / scenario.world.control_period;
  if (steps > kMaxSteps) {
    throw std::runtime_error("scenario '" + scenario.name + "' has " + std::to_string(steps) +
                             " control steps; at most " + std::to_string(kMaxSteps) +
                             " fit (duration x control_rate)");
  }
}

FlightLog flyTimed(const Scenario& scenario, const Vehicle& vehicle, NamedLaw controller) {
  ProgressBar progress("flying " + scenario.name + " with " + controller.name);
  const auto start = std::chrono::steady_clock::now();
  FlightLog log = fly(scenario, vehicle, controller.name, std::move(controller.law),
                      [&](double share) { progress.update(share); });
  const std::chrono::duration<double> wall = std::chrono::steady_clock::now() - start;
  log.real_time_factor = toSeconds(scenario.duration) / std::max(wall.count(), 1e-9);
  return log;
}

void run(const Options& options) {
  const std::string config = configFolder();
  const std::string scenario_path = findResource(config, "scenario", options.scenario);
  const Scenario scenario = loadScenario(scenario_path);
  checkLength(scenario);
  const std::string vehicle_path =
      findResource(config, "vehicle", options.vehicle.empty() ? scenario.vehicle : options.vehicle);
  const Vehicle vehicle = loadVehicle(vehicle_path);
  std::vector<NamedLaw> controllers = loadControllers(
      config, options.controllers.empty() ? scenario.controllers : options.controllers, vehicle);
  const std::string folder =
      options.out.empty() ? "flight/" + resourceName(scenario_path) : options.out;
  makeFolder(folder);

  std::vector<FlightLog> logs;
  for (NamedLaw& controller : controllers) {
    logs.push_back(flyTimed(scenario, vehicle, std::move(controller)));
  }
  std::cout << flightTable(logs, scenario, vehicle, styleOfStdout()) << std::flush;
  writeFlightFiles(folder, logs);
  writeFlightSetting(folder, loadYamlFile(scenario_path), loadYamlFile(vehicle_path), logs);
  if (!options.json.empty()) writeJson(options.json, logs, scenario);
  if (!options.no_plots) {
    ProgressBar progress("drawing figures");
    drawFigures(folder, logs, backdropOf(scenario), vehicle,
                [&](double share) { progress.update(share); });
  }
  std::cout << (options.no_plots ? "CSV: " : "CSV and figures: ") << folder << "\n" << std::flush;
}

void addOptions(CLI::App& app, Options& options) {
  app.add_option("scenario", options.scenario, "file, or name of one in config/scenario")
      ->required()
      ->type_name("SCENARIO");
  app.add_option(
         "-c,--controller", options.controllers,
         "files, or names of some in config/controller, separated by commas; default: those "
         "the scenario names")
      ->delimiter(',')
      ->type_name("NAME,...");
  app.add_option("-v,--vehicle", options.vehicle,
                 "file, or name of one in config/vehicle; default: the scenario's")
      ->type_name("NAME");
  app.add_option("-o,--out", options.out,
                 "folder for CSV and figures, made if need be; default: flight/SCENARIO")
      ->type_name("FOLDER");
  app.add_option("-j,--json", options.json, "write the metrics to this file")->type_name("FILE");
  app.add_flag("--no-plots", options.no_plots, "draw no figures");
}

}  // namespace
}  // namespace aqc

int main(int argc, char** argv) {
  CLI::App app("Flies a scenario without ROS and compares controllers.", "fly");
  aqc::Options options;
  aqc::addOptions(app, options);
  CLI11_PARSE(app, argc, argv);
  return aqc::runProgram("fly", [&] { aqc::run(options); });
}
