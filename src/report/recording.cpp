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

// What a flight may be called, from the plainest on.
std::vector<std::string> labels(const Recording& recording) {
  const fs::path path = fs::absolute(recording.path);
  const std::string stem = path.stem().string();
  return {recording.log.controller, stem,
          stem + " (" + path.parent_path().filename().string() + ")"};
}

// Where the next sample would have been: with it the last one has lasted as long as the others.
Nanoseconds endOf(const FlightLog& log) {
  const auto& samples = log.samples;
  const Nanoseconds last = samples.back().time;
  return samples.size() < 2 ? last : 2 * last - samples[samples.size() - 2].time;
}

}  // namespace

void writeFlightSetting(const std::string& folder, const YAML::Node& scenario,
                        const YAML::Node& vehicle) {
  YAML::Node tree;
  tree["scenario"] = scenario;
  tree["vehicle"] = vehicle;
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
    recording.scenario = readScenario(reader.child("scenario"));
    recording.vehicle = readVehicle(reader.child("vehicle"));
    reader.finish();
  } else {
    recording.scenario = scenarioOf(recording.log, fs::path(path).stem().string());
    const Eigen::Index rotors = recording.log.samples.front().allocation.speeds.size();
    recording.vehicle.rotors.resize(static_cast<std::size_t>(rotors));
  }
  return recording;
}

Scenario scenarioOf(const FlightLog& log, const std::string& title) {
  Scenario scenario;
  scenario.name = scenario.title = title;
  scenario.duration = endOf(log);
  double mass = 0.0;
  for (const FlightSample& sample : log.samples) {
    if (sample.payload_mass == mass) continue;
    if (mass > 0.0) scenario.mission.events.push_back({sample.time, DetachPayload{}});
    mass = sample.payload_mass;
    if (mass == 0.0) continue;
    AttachPayload attach;
    attach.payload.mass = mass;
    scenario.mission.events.push_back({sample.time, attach});
  }
  return scenario;
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

Scenario jointScenario(const std::vector<Recording>& recordings) {
  Scenario scenario = recordings.front().scenario;
  for (const Recording& recording : recordings) {
    scenario.duration = std::max(scenario.duration, recording.scenario.duration);
    const std::string& title = recording.scenario.title;
    if (scenario.title.find(title) == std::string::npos) scenario.title += " and " + title;
  }
  return scenario;
}

Vehicle jointVehicle(const std::vector<Recording>& recordings) {
  const auto known = std::find_if(recordings.begin(), recordings.end(),
                                  [](const Recording& r) { return r.vehicle.mass > 0.0; });
  return (known != recordings.end() ? *known : recordings.front()).vehicle;
}

}  // namespace aqc
