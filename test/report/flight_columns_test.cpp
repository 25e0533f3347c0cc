#include "report/flight_columns.h"

#include <gtest/gtest.h>

#include <cmath>

#include "report/flight_csv.h"
#include "support/files.h"
#include "support/short_flight.h"

namespace aqc {
namespace {

using test::log;
using test::split;

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

}  // namespace
}  // namespace aqc
