#include <gtest/gtest.h>
#include <stdlib.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <limits>
#include <sstream>

#include "adaptive_quadrotor_control/parameters/parameter_reader.h"
#include "figures/flight_figures.h"
#include "report/flight_columns.h"
#include "report/flight_csv.h"
#include "report/flight_files.h"
#include "report/flight_table.h"
#include "report/progress_bar.h"
#include "report/recording.h"
#include "report/resources.h"

namespace aqc {
namespace {

namespace fs = std::filesystem;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kDegree = M_PI / 180.0;

// Ten seconds at 10 Hz; the errors count from 4 s on.
Scenario scenario() {
  Scenario scenario;
  scenario.name = "short";
  scenario.title = "A short flight";
  scenario.duration = fromSeconds(10.0);
  scenario.world.control_period = fromSeconds(0.1);
  scenario.metrics_from = fromSeconds(4.0);
  AttachPayload attach;
  attach.payload.mass = 0.5;
  scenario.mission.events.push_back({fromSeconds(4.0), attach});
  scenario.published["good"].position = {0.2, 0.2, 0.0};
  scenario.published["good"].attitude = {4.0, 4.0, 4.0};
  return scenario;
}

Vehicle vehicle() {
  Vehicle vehicle;
  vehicle.name = "test bird";
  vehicle.mass = 2.0;
  vehicle.rotors.resize(4);
  vehicle.max_rotor_speed = 900.0;
  return vehicle;
}

// Flies from 1 s on with constant errors: 0.1, 0.2 and -0.3 m; 2, 2 and 2 deg.
FlightLog log(const std::string& controller) {
  FlightLog log;
  log.controller = controller;
  log.adaptive_quantities = {{"K_a", "N"}, {"K_b", "N m/\u2016\u03be\u2016\u00b2"}};
  for (int i = 0; i < 100; ++i) {
    FlightSample sample;
    sample.time = fromSeconds(0.1 * i);
    sample.flying = i >= 10;
    sample.state.position = {1.0 / 3.0, 0.01 * i, 1.0};
    sample.telemetry.position_error = {0.1, 0.2, -0.3};
    sample.telemetry.attitude_error.setConstant(2.0 * kDegree);
    sample.telemetry.adaptive = Eigen::Vector2d(0.25, 0.01 * i);
    sample.allocation.speeds = Eigen::Vector4d::Constant(700.0);
    sample.payload_mass = i >= 40 ? 0.5 : 0.0;
    log.samples.push_back(sample);
  }
  return log;
}

FlightLog crashed(const std::string& controller) {
  FlightLog flight = log(controller);
  flight.crash_time = fromSeconds(6.5);
  flight.crash_reason = "hard impact";
  flight.refusals = {{fromSeconds(4.0), "the box is out of reach"}};
  return flight;
}

std::vector<std::string> split(const std::string& text, char separator) {
  std::vector<std::string> parts;
  std::istringstream stream(text + separator);
  for (std::string part; std::getline(stream, part, separator);) parts.push_back(part);
  return parts;
}

std::string readFile(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

// A folder that is gone after the test.
class ToolsInFolder : public ::testing::Test {
 protected:
  ToolsInFolder() {
    std::string name = (fs::temp_directory_path() / "aqc_tools_XXXXXX").string();
    folder_ = mkdtemp(name.data()) != nullptr ? name : "";
  }
  ~ToolsInFolder() override { fs::remove_all(folder_); }

  fs::path folder_;
};

TEST(FlightCsv, HasAColumnForEveryNumberAndALineForEverySample) {
  const FlightLog flight = log("good");
  std::vector<std::string> lines = split(flightCsv(flight), '\n');
  EXPECT_EQ(lines.back(), "");  // the last line is complete, too
  lines.pop_back();
  ASSERT_EQ(lines.size(), flight.samples.size() + 1);
  const std::size_t columns = flightColumns(layoutOf(flight)).size();
  for (const std::string& line : lines) EXPECT_EQ(split(line, ',').size(), columns);
  EXPECT_EQ(lines.front().rfind("t [s],x [m],y [m],z [m],roll [rad],", 0), 0u);
  for (const char* name : {"mass_estimate [kg]", "K_a", "K_b", "rotor_4 [rad/s]", "flying"}) {
    EXPECT_NE(("," + lines.front() + ",").find("," + std::string(name) + ","), std::string::npos)
        << name;
  }
  EXPECT_EQ(lines.front().find("rotor_5"), std::string::npos);
}

TEST(FlightCsv, HasNoErrorsWithoutASetPoint) {
  const FlightLog flight = log("good");
  const auto missing = [&](const FlightColumn& column) {
    return std::isnan(column.value(flight.samples[9]));
  };
  for (const FlightColumn& column : flightColumns(layoutOf(flight))) {
    const std::string kind = column.name.substr(0, column.name.find('_'));
    const bool active_only = kind == "set" || kind == "error" || kind == "desired" ||
                             kind == "sliding" || kind == "force";
    EXPECT_EQ(missing(column), active_only || kind == "mass") << column.name;
  }
}

TEST(FlightJson, FollowsTheSchema) {
  FlightLog fast = log("good");
  fast.real_time_factor = 120.0;
  const nlohmann::json json = flightJson({fast, crashed("bad")}, scenario());
  EXPECT_EQ(json.at("scenario"), "short");
  ASSERT_EQ(json.at("flights").size(), 2u);
  const nlohmann::json& good = json["flights"][0];
  EXPECT_EQ(good.size(), 11u);
  EXPECT_EQ(good.at("controller"), "good");
  EXPECT_NEAR(good.at("rms").at("x").get<double>(), 0.1, 1e-12);
  EXPECT_NEAR(good.at("rms").at("z").get<double>(), 0.3, 1e-12);
  EXPECT_NEAR(good.at("rms").at("yaw").get<double>(), 2.0, 1e-12);
  EXPECT_NEAR(good.at("peak_altitude_error").get<double>(), 0.3, 1e-12);
  EXPECT_NEAR(good.at("settled_altitude_error").get<double>(), 0.3, 1e-12);
  EXPECT_EQ(good.at("crashed"), false);
  EXPECT_TRUE(good.at("crash_time").is_null());
  EXPECT_TRUE(good.at("grounded_from").is_null());
  EXPECT_TRUE(good.at("refusals").empty() && good.at("refusals").is_array());
  EXPECT_EQ(good.at("duration"), 10.0);
  EXPECT_EQ(good.at("real_time_factor"), 120.0);
  const nlohmann::json& bad = json["flights"][1];
  EXPECT_EQ(bad.at("crashed"), true);
  EXPECT_EQ(bad.at("crash_time"), 6.5);
  EXPECT_EQ(bad.at("refusals"),
            (nlohmann::json{{{"time", 4.0}, {"reason", "the box is out of reach"}}}));
  EXPECT_TRUE(bad.at("real_time_factor").is_null());  // not measured
}

TEST(FlightJson, HasNullForWhatIsNotFinite) {
  FlightLog flight = log("lost");
  flight.samples[50].telemetry.position_error.x() = kNan;
  flight.samples[50].telemetry.position_error.y() = std::numeric_limits<double>::infinity();
  const nlohmann::json rms = flightJson({flight}, scenario())["flights"][0]["rms"];
  EXPECT_TRUE(rms.at("x").is_null());
  EXPECT_TRUE(rms.at("y").is_null());
  EXPECT_TRUE(rms.at("z").is_number());
}

TEST(FlightTable, ShowsFlownAndPublishedErrors) {
  FlightLog fast = log("good");
  fast.real_time_factor = 1234.5;
  const std::string table =
      flightTable({fast, crashed("bad")}, scenario(), vehicle(), TableStyle::kPlain);
  const auto line = [&](const std::string& begin) {
    for (const std::string& candidate : split(table, '\n')) {
      if (candidate.rfind(begin, 0) != 0) continue;
      std::istringstream words(candidate);
      return std::vector<std::string>(std::istream_iterator<std::string>(words), {});
    }
    return std::vector<std::string>();
  };
  using Words = std::vector<std::string>;
  EXPECT_EQ(line("good"), (Words{"good", "0.100", "0.200", "0.300", "2.00", "2.00", "2.00", "0.300",
                                 "0.300", "1234", "x", "flew", "to", "the", "end"}));
  EXPECT_EQ(line("  published"),
            (Words{"published", "0.200", "0.200", "0.000", "4.00", "4.00", "4.00"}));
  EXPECT_EQ(line("  difference"),
            (Words{"difference", "-50", "%", "+0", "%", "-", "-50", "%", "-50", "%", "-50", "%"}));
  EXPECT_NE(table.find("crashed at 6.5 s: hard impact"), std::string::npos);
  EXPECT_NE(table.find("  at 4 s: the box is out of reach\n"), std::string::npos);
  EXPECT_NE(table.find("RMS errors from 4 s to the end at 10 s"), std::string::npos);
  EXPECT_EQ(table.find('\033'), std::string::npos);
}

TEST(FlightTable, ColoursChangeNothingElse) {
  const std::vector<FlightLog> logs = {log("good"), crashed("bad")};
  std::string coloured = flightTable(logs, scenario(), vehicle(), TableStyle::kColoured);
  ASSERT_NE(coloured.find('\033'), std::string::npos);
  for (std::size_t at; (at = coloured.find('\033')) != std::string::npos;) {
    coloured.erase(at, coloured.find('m', at) + 1 - at);
  }
  EXPECT_EQ(coloured, flightTable(logs, scenario(), vehicle(), TableStyle::kPlain));
}

TEST_F(ToolsInFolder, FilesOfAFlightAreThere) {
  const fs::path out = folder_ / "a" / "b";
  writeFlightFiles(out.string(), {log("good"), crashed("bad")});
  EXPECT_EQ(readFile(out / "good.csv"), flightCsv(log("good")));
  EXPECT_TRUE(fs::exists(out / "bad.csv"));
  writeJson((out / "m.json").string(), {log("good")}, scenario());
  EXPECT_EQ(nlohmann::json::parse(readFile(out / "m.json")), flightJson({log("good")}, scenario()));
}

TEST_F(ToolsInFolder, WhatCannotBeWrittenIsRefused) {
  writeFile((folder_ / "file").string(), "text");
  EXPECT_THROW(makeFolder((folder_ / "file").string()), std::runtime_error);
  EXPECT_THROW(writeFlightFiles((folder_ / "file" / "below").string(), {}), std::runtime_error);
  EXPECT_THROW(writeFile((folder_ / "missing" / "file").string(), ""), std::runtime_error);
  EXPECT_THROW(writeFile("/dev/full", "text"), std::runtime_error);
}

TEST_F(ToolsInFolder, FiguresAreDrawnOrGnuplotIsMissed) {
  const std::vector<FlightLog> logs = {log("it's"),
                                       crashed("<false")};  // names gnuplot might act on
  writeFlightFiles(folder_.string(), logs);
  double done = 0.0;
  const auto paths = drawFigures(folder_.string(), logs, backdropOf(scenario()), vehicle(),
                                 [&](double share) { done = share; });
  EXPECT_EQ(done, 1.0);
  ASSERT_EQ(paths.size(), 5u);
  for (const std::string& path : paths) EXPECT_EQ(readFile(path).substr(1, 3), "PNG") << path;

  const std::string path_before = getenv("PATH");
  setenv("PATH", folder_.c_str(), 1);
  EXPECT_THROW(drawFigures(folder_.string(), logs, backdropOf(scenario()), vehicle(), {}),
               std::runtime_error);
  setenv("PATH", path_before.c_str(), 1);
  EXPECT_TRUE(fs::exists(folder_ / "position.gnuplot"));
  EXPECT_FALSE(fs::exists(folder_ / "position.png"));
}

Recording recorded(const std::string& path, const std::string& controller) {
  Recording recording;
  recording.path = path;
  recording.log.controller = controller;
  return recording;
}

std::vector<std::string> namesOf(std::vector<Recording> recordings) {
  nameApart(recordings);
  std::vector<std::string> names;
  for (const Recording& recording : recordings) names.push_back(recording.log.controller);
  return names;
}

TEST(Recordings, AreNamedByLawThenByFileThenByFolder) {
  using Names = std::vector<std::string>;
  EXPECT_EQ(namesOf({recorded("a.bag", "asmc"), recorded("b.bag", "smc")}), (Names{"asmc", "smc"}));
  EXPECT_EQ(namesOf({recorded("a.bag", "asmc"), recorded("b.bag", "asmc")}), (Names{"a", "b"}));
  EXPECT_EQ(namesOf({recorded("old/asmc.csv", "asmc"), recorded("new/asmc.csv", "asmc")}),
            (Names{"asmc (old)", "asmc (new)"}));
  EXPECT_THROW(namesOf({recorded("a.bag", "asmc"), recorded("a.bag", "asmc")}), std::runtime_error);
}

TEST_F(ToolsInFolder, ACsvFileTellsItsFlight) {
  writeFlightFiles(folder_.string(), {log("mine")});
  const std::string path = (folder_ / "mine.csv").string();
  const Recording alone = readCsvRecording(path);
  EXPECT_EQ(alone.log.controller, "mine");
  EXPECT_EQ(alone.vehicle.rotors.size(), 4u);
  EXPECT_EQ(alone.vehicle.mass, 0.0);
  EXPECT_EQ(alone.backdrop.title, "mine");
  EXPECT_EQ(alone.backdrop.duration, fromSeconds(10.0));
  ASSERT_EQ(alone.backdrop.payloads.size(), 1u);
  EXPECT_EQ(alone.backdrop.payloads[0].from, fromSeconds(4.0));
  EXPECT_FALSE(alone.backdrop.payloads[0].to);
  EXPECT_EQ(alone.backdrop.payloads[0].mass, 0.5);
  EXPECT_EQ(alone.log.adaptive_quantities,
            (std::vector<AdaptiveQuantity>{{"K_a", ""}, {"K_b", ""}}));

  const std::string config = configFolder();
  FlightLog other = log("other");
  other.adaptive_quantities = {{"K_a", "kg"}, {"switches", ""}};
  writeFlightSetting(folder_.string(), loadYamlFile(config + "/scenario/hover_payload.yaml"),
                     loadYamlFile(config + "/vehicle/pelican.yaml"), {log("mine"), other});
  const Recording beside = readCsvRecording(path);
  EXPECT_EQ(beside.backdrop.title, loadScenario(config + "/scenario/hover_payload.yaml").title);
  EXPECT_EQ(beside.vehicle.mass, loadVehicle(config + "/vehicle/pelican.yaml").mass);
  EXPECT_EQ(beside.log.adaptive_quantities, log("mine").adaptive_quantities);
  const std::string renamed = (folder_ / "renamed.csv").string();
  fs::copy_file(path, renamed);
  EXPECT_EQ(readCsvRecording(renamed).log.adaptive_quantities, alone.log.adaptive_quantities);
  writeFile((folder_ / "flight.yaml").string(), "scenario: 1\n");
  EXPECT_THROW(readCsvRecording(path), ParameterError);
}

TEST_F(ToolsInFolder, FlightsOfDifferentLengthAndAnUnknownVehicleAreDrawn) {
  std::vector<Recording> recordings(2);
  for (Recording& recording : recordings) recording.log = log("some");
  recordings[0].log.samples.resize(30);
  recordings[0].path = "short.csv";
  recordings[1].path = "long.csv";
  std::vector<FlightLog> logs;
  nameApart(recordings);
  for (Recording& recording : recordings) {
    recording.backdrop = backdropOf(recording.log, recording.log.controller);
    logs.push_back(recording.log);
  }
  EXPECT_EQ(jointVehicle(recordings).mass, 0.0);
  recordings[1].vehicle = vehicle();
  EXPECT_EQ(jointVehicle(recordings).name, "test bird");
  const Backdrop joint = jointBackdrop(recordings);
  EXPECT_EQ(joint.title, "short and long");
  EXPECT_EQ(joint.duration, fromSeconds(10.0));
  Vehicle unknown;
  unknown.rotors.resize(4);
  EXPECT_EQ(drawFigures(folder_.string(), logs, joint, unknown, {}).size(), 5u);
}

TEST_F(ToolsInFolder, ResourcesAreFoundByNameAndByPath) {
  fs::create_directories(folder_ / "vehicle");
  for (const char* name : {"b.yaml", "a.yaml", "notes.txt"}) {
    writeFile((folder_ / "vehicle" / name).string(), "x");
  }
  const std::string config = folder_.string();
  EXPECT_EQ(resourceNames(config, "vehicle"), (std::vector<std::string>{"a", "b"}));
  const std::string file = (folder_ / "vehicle" / "a.yaml").string();
  EXPECT_EQ(findResource(config, "vehicle", "a"), file);
  EXPECT_EQ(findResource("", "vehicle", file), file);
  EXPECT_EQ(resourceName(file), "a");
  try {
    findResource(config, "vehicle", "c");
    FAIL();
  } catch (const std::runtime_error& error) {
    EXPECT_STREQ(error.what(), "unknown vehicle 'c'; there are: a, b");
  }
  EXPECT_THROW(findResource(config, "vehicle", ""), std::runtime_error);
  EXPECT_THROW(findResource(config, "vehicle", config + "/c.yaml"), std::runtime_error);
  EXPECT_THROW(findResource(config, "vehicle", config + "/vehicle"), std::runtime_error);
}

TEST(Resources, ConfigFolderHoldsScenarios) {
  EXPECT_FALSE(resourceNames(configFolder(), "scenario").empty());
}

TEST(ProgressBar, SaysNothingAwayFromATerminal) {
  ::testing::internal::CaptureStderr();
  ProgressBar progress("work");
  for (const double share : {0.0, 0.5, 2.0, -1.0, kNan}) progress.update(share);
  progress.finish();
  progress.update(1.0);
  EXPECT_EQ(::testing::internal::GetCapturedStderr(), "");
}

}  // namespace
}  // namespace aqc
