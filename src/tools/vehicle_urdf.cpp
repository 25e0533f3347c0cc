// Prints the URDF of a vehicle: the parameter robot_description for rviz.

#include <exception>
#include <iostream>

#include "adaptive_quadrotor_control/model/vehicle_urdf.h"
#include "adaptive_quadrotor_control/tools/resources.h"

int main(int argc, char** argv) {
  if (argc != 2 || argv[1][0] == '-') {
    std::cerr << "usage: vehicle_urdf VEHICLE    (a file, or the name of one in config/vehicle)\n";
    return 2;
  }
  try {
    std::cout << aqc::vehicleUrdf(
                     aqc::loadVehicle(aqc::findResource(aqc::configFolder(), "vehicle", argv[1])))
              << std::flush;
    return std::cout ? 0 : 1;
  } catch (const std::exception& error) {
    std::cerr << "vehicle_urdf: " << error.what() << std::endl;
    return 1;
  }
}
