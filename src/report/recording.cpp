#include "report/recording.h"

#include <algorithm>
#include <filesystem>
#include <set>
#include <stdexcept>

#include "adaptive_quadrotor_control/parameters/parameter_reader.h"
#include "report/flight_csv.h"
#include "report/flight_files.h"

namespace aqc {
namespace {

namespace fs = std::filesystem;

constexpr const char* kSettingName = "flight.yaml";
constexpr const char* kUnits = "adaptive_units";  // by controller and name

void readUnits(const ParameterReader& all, FlightLog& log) {
  if (!all.has(log.controller)) return;
  const ParameterReader units = all.child(log.controller);
  for (AdaptiveQuantity& quantity : log.adaptive_quantities) {
    quantity.unit = units.text(quantity.name, "");
  }
}

// What a flight may be called, from the plainest on.
std::vector<std::string> labels(const Recording& recording) {
  const fs::path path = fs::absolute(recording.path);
  const std::string stem = path.stem().string();
  return {recording.log.controller, stem,
          stem + " (" + path.parent_path().filename().string() + ")"};
}

}  // namespace

void writeFlightSetting(const std::string& folder, const YAML::Node& scenario,
                        const YAML::Node& vehicle, const std::vector<FlightLog>& logs) {
  YAML::Node tree;
  tree["scenario"] = scenario;
  tree["vehicle"] = vehicle;
  for (const FlightLog& log : logs) {
    for (const AdaptiveQuantity& quantity : log.adaptive_quantities) {
      if (quantity.unit.empty()) continue;
      tree[kUnits][log.controller][quantity.name] = quantity.unit;
    }
  }
  writeFile(
      (fs::path(folder) / kSettingName).string(),
      "# What was flown; plot_flight reads it beside the CSV files.\n" + YAML::Dump(tree) + "\n");
}

Recording readCsvRecording(const std::string& path) {
  Recording recording;
  recording.path = path;
  recording.log = readFlightCsv(path);
  const std::string setting = (fs::path(path).parent_path() / kSettingName).string();
  if (fs::exists(setting)) {
    const ParameterReader reader(loadYamlFile(setting), setting);
    recording.backdrop = backdropOf(readScenario(reader.child("scenario")));
    recording.vehicle = readVehicle(reader.child("vehicle"));
    if (reader.has(kUnits)) readUnits(reader.child(kUnits), recording.log);
    reader.skip(kUnits);  // those of other flights
    reader.finish();
  } else {
    recording.backdrop = backdropOf(recording.log, fs::path(path).stem().string());
    const Eigen::Index rotors = recording.log.samples.front().allocation.speeds.size();
    recording.vehicle.rotors.resize(static_cast<std::size_t>(rotors));
  }
  return recording;
}

void nameApart(std::vector<Recording>& recordings) {
  for (std::size_t choice = 0; choice < 3; ++choice) {
    std::set<std::string> different;
    for (const Recording& recording : recordings) different.insert(labels(recording)[choice]);
    if (different.size() < recordings.size()) continue;
    for (Recording& recording : recordings) recording.log.controller = labels(recording)[choice];
    return;
  }
  std::string files;
  for (const Recording& recording : recordings) files += " '" + recording.path + "'";
  throw std::runtime_error(
      "curves are named by their files, and two of these are called the same:" + files);
}

Backdrop jointBackdrop(const std::vector<Recording>& recordings) {
  Backdrop joint = recordings.front().backdrop;
  for (const Recording& recording : recordings) {
    joint.duration = std::max(joint.duration, recording.backdrop.duration);
    const std::string& title = recording.backdrop.title;
    if (joint.title.find(title) == std::string::npos) joint.title += " and " + title;
  }
  return joint;
}

Vehicle jointVehicle(const std::vector<Recording>& recordings) {
  const auto known = std::find_if(recordings.begin(), recordings.end(),
                                  [](const Recording& r) { return r.vehicle.mass > 0.0; });
  return (known != recordings.end() ? *known : recordings.front()).vehicle;
}

}  // namespace aqc
