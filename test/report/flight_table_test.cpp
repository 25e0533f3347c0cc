#include "report/flight_table.h"

#include <gtest/gtest.h>

#include <iterator>
#include <sstream>

#include "support/files.h"
#include "support/short_flight.h"

namespace aqc {
namespace {

using test::crashed;
using test::log;
using test::scenario;
using test::split;
using test::vehicle;

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

}  // namespace
}  // namespace aqc
