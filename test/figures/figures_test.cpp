#include <gtest/gtest.h>

#include "figures/figure_script.h"
#include "figures/plotted_flight.h"
#include "figures/switching_figures.h"

namespace aqc {
namespace {

TEST(Figures, LawsKeepTheirColoursAndOthersTakeFreeOnes) {
  const auto colours = [](const std::vector<std::string>& names) {
    std::vector<FlightLog> logs(names.size());
    for (std::size_t i = 0; i < names.size(); ++i) logs[i].controller = names[i];
    return flightColours(logs);
  };
  EXPECT_EQ(colours({"smc", "asmc"}),
            (std::vector<std::string>{paletteColour(1), paletteColour(0)}));
  EXPECT_EQ(colours({"mine", "asmc", "other"}),
            (std::vector<std::string>{paletteColour(1), paletteColour(0), paletteColour(2)}));
}

TEST(Figures, SubsystemsAreCountedInWholeNumbers) {
  FlightLog log;
  log.controller = "switched";
  log.adaptive_quantities = {{"active_subsystem", ""}};
  for (int i = 0; i < 100; ++i) {
    FlightSample sample;
    sample.time = fromSeconds(0.1 * i);
    sample.flying = true;
    sample.telemetry.adaptive = Eigen::Matrix<double, 1, 1>(i < 50 ? 1.0 : 2.0);
    log.samples.push_back(sample);
  }
  const PlottedFlight flight = plottedFlight(log, fromSeconds(10.0), paletteColour(0));
  Figure frame;
  frame.duration = 10.0;
  const std::vector<Figure> figures = switchingFigures(flight, frame);
  ASSERT_EQ(figures.size(), 1u);
  EXPECT_EQ(figures[0].panels[0].least_tic, 1.0);
  const std::string script = figureScript(figures[0]);
  EXPECT_NE(script.find("set label 200 'active subsystem'"), std::string::npos);
  EXPECT_NE(script.find("set ytics 1\n"), std::string::npos);
}

TEST(Figures, GainsHaveTheUnitThatTheFlightTells) {
  EXPECT_EQ(withUnit({"K_p0", "N"}), "K_p0 [N]");
  EXPECT_EQ(withUnit({"switches", ""}), "switches");
  FlightLog log;
  log.adaptive_quantities = {
      {"active_subsystem", ""}, {"theta_1[1]", "kN"}, {"zeta[1]", "mN"}, {"gamma[1]", ""}};
  for (int i = 0; i < 60; ++i) {
    FlightSample sample;
    sample.time = fromSeconds(0.1 * i);
    sample.flying = true;
    sample.telemetry.adaptive = Eigen::Vector4d(1.0, 2.0, 3.0, 4.0);
    log.samples.push_back(sample);
  }
  const PlottedFlight flight = plottedFlight(log, fromSeconds(6.0), paletteColour(0));
  EXPECT_EQ(flight.unit("zeta[1]"), "mN");
  EXPECT_EQ(flight.unit("zeta[2]"), "");
  const std::vector<Figure> figures = switchingFigures(flight, Figure());
  ASSERT_EQ(figures.size(), 2u);
  ASSERT_EQ(figures[1].panels.size(), 3u);
  ASSERT_EQ(figures[1].key.size(), 1u);
  EXPECT_EQ(figures[1].key[0].title, "theta_1 [kN]");
  EXPECT_EQ(figures[1].panels[1].label, "zeta [mN]");
  EXPECT_EQ(figures[1].panels[2].label, "gamma");
}

}  // namespace
}  // namespace aqc
