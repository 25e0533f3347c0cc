#include "report/flight_files.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <limits>

#include "report/flight_csv.h"
#include "support/files.h"
#include "support/short_flight.h"

namespace aqc {
namespace {

namespace fs = std::filesystem;

using test::crashed;
using test::log;
using test::readFile;
using test::scenario;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

using FlightFiles = test::InFolder;

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

TEST_F(FlightFiles, AreThere) {
  const fs::path out = folder_ / "a" / "b";
  writeFlightFiles(out.string(), {log("good"), crashed("bad")});
  EXPECT_EQ(readFile(out / "good.csv"), flightCsv(log("good")));
  EXPECT_TRUE(fs::exists(out / "bad.csv"));
  writeJson((out / "m.json").string(), {log("good")}, scenario());
  EXPECT_EQ(nlohmann::json::parse(readFile(out / "m.json")), flightJson({log("good")}, scenario()));
}

TEST_F(FlightFiles, AreRefusedWhereTheyCannotBeWritten) {
  writeFile((folder_ / "file").string(), "text");
  EXPECT_THROW(makeFolder((folder_ / "file").string()), std::runtime_error);
  EXPECT_THROW(writeFlightFiles((folder_ / "file" / "below").string(), {}), std::runtime_error);
  EXPECT_THROW(writeFile((folder_ / "missing" / "file").string(), ""), std::runtime_error);
  EXPECT_THROW(writeFile("/dev/full", "text"), std::runtime_error);
}

}  // namespace
}  // namespace aqc
