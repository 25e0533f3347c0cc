// Draws recorded flights: the figures of fly, from bags; several lie over each other.

#include <CLI/CLI.hpp>
#include <algorithm>
#include <exception>
#include <iostream>
#include <string>
#include <vector>

#include "adaptive_quadrotor_control/tools/flight_figures.h"
#include "adaptive_quadrotor_control/tools/flight_files.h"
#include "recorded_flight.h"

namespace aqc {
namespace {

void run(const std::vector<std::string>& bags, const std::string& folder) {
  std::vector<FlightLog> logs;
  RecordedFlight first;
  Scenario scenario;
  for (const std::string& bag : bags) {
    RecordedFlight flight = readBag(bag);
    for (const FlightLog& other : logs) {
      if (other.controller == flight.log.controller) {
        throw std::runtime_error("two recordings are called '" + other.controller +
                                 "'; curves are named by their files");
      }
    }
    logs.push_back(flight.log);
    if (logs.size() == 1) {
      scenario = flight.scenario;
      first = std::move(flight);
    } else {
      scenario.title += " and " + flight.log.controller;
      scenario.duration = std::max(scenario.duration, flight.scenario.duration);
    }
  }
  writeFlightFiles(folder, logs);
  for (const std::string& path : drawFigures(folder, logs, scenario, first.vehicle, {})) {
    std::cout << path << "\n";
  }
}

}  // namespace
}  // namespace aqc

int main(int argc, char** argv) {
  CLI::App app("Draws recorded flights; several lie over each other.", "plot_flight");
  std::vector<std::string> bags;
  std::string folder = "flight/recorded";
  app.add_option("bags", bags, "recordings, e.g. of demo.launch record:=true")
      ->required()
      ->check(CLI::ExistingFile)
      ->type_name("FILE.bag ...");
  app.add_option("-o,--out", folder, "folder for CSV and figures, made if need be")
      ->type_name("FOLDER");
  CLI11_PARSE(app, argc, argv);
  try {
    aqc::run(bags, folder);
    return 0;
  } catch (const std::exception& error) {
    std::cerr << "plot_flight: " << error.what() << std::endl;
    return 1;
  }
}
