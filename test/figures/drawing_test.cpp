#include <gtest/gtest.h>
#include <stdlib.h>

#include <filesystem>
#include <stdexcept>

#include "figures/flight_figures.h"
#include "report/flight_files.h"
#include "report/recording.h"
#include "support/files.h"
#include "support/short_flight.h"

namespace aqc {
namespace {

namespace fs = std::filesystem;

using test::crashed;
using test::log;
using test::readFile;
using test::scenario;
using test::vehicle;

using Drawing = test::InFolder;

TEST_F(Drawing, MakesFiguresOrMissesGnuplot) {
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

TEST_F(Drawing, TakesFlightsOfDifferentLengthAndAnUnknownVehicle) {
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

}  // namespace
}  // namespace aqc
