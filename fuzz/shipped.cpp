#include "fuzz/shipped.h"

#include <map>

#include "adaptive_quadrotor_control/law/law_factory.h"
#include "support/source_tree.h"

namespace aqc::fuzz {

const Vehicle& shippedVehicle(const std::string& name) {
  static std::map<std::string, Vehicle> vehicles;
  const auto known = vehicles.find(name);
  if (known != vehicles.end()) return known->second;
  return vehicles[name] = loadVehicle(test::configFile("vehicle/" + name));
}

std::unique_ptr<ControlLaw> shippedLaw(const std::string& name, const std::string& vehicle) {
  static std::map<std::string, std::unique_ptr<ControlLaw>> laws;
  std::unique_ptr<ControlLaw>& law = laws[name + " " + vehicle];
  if (!law) law = loadLaw(test::configFile("controller/" + name), shippedVehicle(vehicle));
  return law->clone();
}

}  // namespace aqc::fuzz
