// Prints the URDF of a vehicle: the parameter robot_description for rviz.

#include <iostream>
#include <string>
#include <vector>

#include "adaptive_quadrotor_control/parameters/parameter_reader.h"
#include "adaptive_quadrotor_control/simulation/scenario.h"
#include "figures/vehicle_urdf.h"
#include "report/resources.h"
#include "report/run_program.h"

namespace {

// The vehicle that a scenario file names; its mission is nobody's business here.
std::string vehicleOf(const std::string& scenario) {
  const aqc::ParameterReader reader(aqc::loadYamlFile(scenario), scenario);
  aqc::readWorldAlone(reader);
  reader.finish();
  return reader.text("vehicle");
}

// `VEHICLE`, or `--scenario SCENARIO` for the vehicle that it names, unless one follows.
std::string vehicleName(const std::string& config, const std::vector<std::string>& arguments) {
  if (arguments.front() != "--scenario" || arguments.size() == 3) return arguments.back();
  return vehicleOf(aqc::findResource(config, "scenario", arguments.back()));
}

}  // namespace

int main(int argc, char** argv) {
  const std::vector<std::string> arguments(argv + 1, argv + argc);
  const bool by_scenario = !arguments.empty() && arguments.front() == "--scenario";
  if (by_scenario ? arguments.size() < 2 || arguments.size() > 3 : arguments.size() != 1) {
    std::cerr << "usage: vehicle_urdf VEHICLE | vehicle_urdf --scenario SCENARIO [VEHICLE]\n"
                 "       files, or names of some in config/vehicle and config/scenario\n";
    return 2;
  }
  return aqc::runProgram("vehicle_urdf", [&] {
    const std::string config = aqc::configFolder();
    const std::string name = vehicleName(config, arguments);
    std::cout << aqc::vehicleUrdf(aqc::loadVehicle(aqc::findResource(config, "vehicle", name)));
  });
}
