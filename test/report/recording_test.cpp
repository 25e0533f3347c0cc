#include "report/recording.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <stdexcept>

#include "adaptive_quadrotor_control/parameters/parameter_reader.h"
#include "report/flight_files.h"
#include "report/resources.h"
#include "support/files.h"
#include "support/short_flight.h"

namespace aqc {
namespace {

namespace fs = std::filesystem;

using test::log;

using Recordings = test::InFolder;

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

TEST_F(Recordings, AreNamedByLawThenByFileThenByFolder) {
  using Names = std::vector<std::string>;
  EXPECT_EQ(namesOf({recorded("a.bag", "asmc"), recorded("b.bag", "smc")}), (Names{"asmc", "smc"}));
  EXPECT_EQ(namesOf({recorded("a.bag", "asmc"), recorded("b.bag", "asmc")}), (Names{"a", "b"}));
  EXPECT_EQ(namesOf({recorded("old/asmc.csv", "asmc"), recorded("new/asmc.csv", "asmc")}),
            (Names{"asmc (old)", "asmc (new)"}));
  EXPECT_THROW(namesOf({recorded("a.bag", "asmc"), recorded("a.bag", "asmc")}), std::runtime_error);
}

TEST_F(Recordings, OfACsvFileTellItsFlight) {
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

}  // namespace
}  // namespace aqc
