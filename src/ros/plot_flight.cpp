// Draws recorded flights: the figures of fly, from bags and CSV files; several lie over each other.

#include <CLI/CLI.hpp>
#include <algorithm>
#include <exception>
#include <filesystem>
#include <iostream>
#include <string>
#include <vector>

#include "adaptive_quadrotor_control/tools/flight_csv.h"
#include "adaptive_quadrotor_control/tools/flight_figures.h"
#include "adaptive_quadrotor_control/tools/flight_files.h"
#include "recorded_flight.h"

namespace aqc {
namespace {

namespace fs = std::filesystem;

// What a bag holds as CSV, too.
void writeCsv(const Recording& recording, const fs::path& folder) {
  const std::string name = fs::path(recording.path).stem().string() + ".csv";
  writeFile((folder / name).string(), flightCsv(recording.log));
}

// A recorder that could not keep up leaves straight lines that nobody flew.
void warnOfGaps(const Recording& recording) {
  const auto& samples = recording.log.samples;
  if (samples.size() < 2) return;
  Nanoseconds period = recording.scenario.duration;
  for (std::size_t i = 1; i < samples.size(); ++i) {
    period = std::min(period, samples[i].time - samples[i - 1].time);
  }
  const Nanoseconds steps = (samples.back().time - samples.front().time) / period + 1;
  const Nanoseconds missing = steps - static_cast<Nanoseconds>(samples.size());
  if (100 * missing < steps) return;  // a timer may be late
  std::cerr
      << "plot_flight: '" << recording.path << "' lacks " << missing << " of " << steps
      << " control steps; record more slowly (lock_step:=false, a smaller real_time_factor)\n";
}

void run(const std::vector<std::string>& files, const std::string& folder) {
  makeFolder(folder);
  std::vector<Recording> recordings;
  for (const std::string& file : files) {
    const bool csv = fs::path(file).extension() == ".csv";
    recordings.push_back(csv ? readCsvRecording(file) : readBag(file));
    if (csv) continue;
    warnOfGaps(recordings.back());
    writeCsv(recordings.back(), folder);
  }
  nameApart(recordings);
  const Scenario scenario = jointScenario(recordings);
  std::vector<FlightLog> logs;
  for (Recording& recording : recordings) logs.push_back(std::move(recording.log));
  for (const std::string& path :
       drawFigures(folder, logs, scenario, recordings.front().vehicle, {})) {
    std::cout << path << "\n";
  }
}

}  // namespace
}  // namespace aqc

int main(int argc, char** argv) {
  CLI::App app("Draws recorded flights; several lie over each other.", "plot_flight");
  std::vector<std::string> files;
  std::string folder = "flight/recorded";
  app.add_option("files", files,
                 "bags, e.g. of demo.launch record:=true, and CSV files of fly, in any order")
      ->required()
      ->check(CLI::ExistingFile)
      ->type_name("FILE.bag|FILE.csv ...");
  app.add_option("-o,--out", folder,
                 "folder for figures, and for CSV files of what bags hold, made if need be")
      ->type_name("FOLDER");
  CLI11_PARSE(app, argc, argv);
  try {
    aqc::run(files, folder);
    return 0;
  } catch (const std::exception& error) {
    std::cerr << "plot_flight: " << error.what() << std::endl;
    return 1;
  }
}
