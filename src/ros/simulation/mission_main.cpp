#include <iostream>

#include "figures/flight_figures.h"
#include "report/flight_files.h"
#include "report/flight_table.h"
#include "report/recording.h"
#include "ros/border/parameter_tree.h"
#include "ros/border/run_node.h"
#include "ros/simulation/mission_node.h"

namespace {

// Flies, prints the table, and leaves the files in the folder `~out` (none if empty).
int flyMission() {
  const aqc::ParameterReader own = aqc::parameterReader(ros::NodeHandle("~"), "");
  const std::string out = own.text("out", "");
  const bool plots = own.flag("plots", true);
  own.finish();
  if (!out.empty()) aqc::makeFolder(out);  // before the flight: it must not be in vain

  aqc::MissionNode mission;
  const std::vector<aqc::FlightLog> logs = {mission.fly()};
  std::cout << aqc::flightTable(logs, mission.scenario(), mission.vehicle(), aqc::styleOfStdout())
            << std::flush;
  if (out.empty()) return 0;
  aqc::writeFlightFiles(out, logs);
  const ros::NodeHandle node;
  aqc::writeFlightSetting(out, aqc::parameterTree(node, "scenario"),
                          aqc::parameterTree(node, "vehicle"), logs);
  aqc::writeJson(out + "/metrics.json", logs, mission.scenario());
  if (plots)
    aqc::drawFigures(out, logs, aqc::backdropOf(mission.scenario()), mission.vehicle(), {});
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  return aqc::runNode(argc, argv, "mission", flyMission);
}
