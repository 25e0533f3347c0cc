// Draws recorded flights: the figures of fly, from bags and CSV files; several lie over each other.

#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>
#include <iostream>
#include <stdexcept>
#include <string>
#include <vector>

#include "figures/flight_figures.h"
#include "report/flight_csv.h"
#include "report/flight_files.h"
#include "report/run_program.h"
#include "ros/simulation/recorded_flight.h"

namespace aqc {
namespace {

namespace fs = std::filesystem;

bool isCsv(const std::string& path) {
  return fs::path(path).extension() == ".csv";
}

// What a bag holds as CSV, too; never over a file that is being drawn.
void writeCsv(const Recording& recording, const std::vector<std::string>& files,
              const fs::path& folder) {
  const fs::path path = folder / (fs::path(recording.path).stem().string() + ".csv");
  for (const std::string& file : files) {
    if (fs::exists(path) && fs::equivalent(path, file)) {
      throw std::runtime_error("the CSV file of '" + recording.path + "' would overwrite '" + file +
                               "'; choose another --out");
    }
  }
  writeFile(path.string(), flightCsv(recording.log));
}

// A recorder that could not keep up leaves straight lines that nobody flew.
void warnOfGaps(const Recording& recording) {
  const auto& samples = recording.log.samples;
  if (samples.size() < 2) return;
  std::vector<Nanoseconds> periods;
  for (std::size_t i = 1; i < samples.size(); ++i) {
    periods.push_back(samples[i].time - samples[i - 1].time);
  }
  const auto median = periods.begin() + static_cast<std::ptrdiff_t>(periods.size() / 2);
  std::nth_element(periods.begin(), median, periods.end());
  const Nanoseconds steps = (samples.back().time - samples.front().time) / *median + 1;
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
    recordings.push_back(isCsv(file) ? readCsvRecording(file) : readBag(file));
  }
  for (const Recording& recording : recordings) {
    if (isCsv(recording.path)) continue;
    warnOfGaps(recording);
    writeCsv(recording, files, folder);
  }
  nameApart(recordings);
  const Backdrop backdrop = jointBackdrop(recordings);
  const Vehicle vehicle = jointVehicle(recordings);
  std::vector<FlightLog> logs;
  for (Recording& recording : recordings) logs.push_back(std::move(recording.log));
  for (const std::string& path : drawFigures(folder, logs, backdrop, vehicle, {})) {
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
  return aqc::runProgram("plot_flight", [&] { aqc::run(files, folder); });
}
