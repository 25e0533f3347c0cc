// A vehicle takes off, hovers, and after 20 s carries half a kilogram that nobody told its law of.
#include <cstdio>
#include <exception>
#include <string>

#include "adaptive_quadrotor_control/law/law_factory.h"
#include "adaptive_quadrotor_control/pilot/flight_controller.h"
#include "adaptive_quadrotor_control/simulation/rigid_plant.h"

int main(int argc, char** argv) try {
  const std::string config = argc > 1 ? argv[1] : "config";  // the folder of that name
  const aqc::Vehicle vehicle = aqc::loadVehicle(config + "/vehicle/pelican_thesis.yaml");
  aqc::FlightController controller(vehicle,
                                   aqc::loadLaw(config + "/controller/asmc.yaml", vehicle));
  aqc::State start;
  start.position = {0.0, 0.0, 0.1};  // on its feet
  aqc::RigidPlant plant(vehicle, start);
  aqc::SetPoint hover;
  hover.position = {0.0, 0.0, 1.0};

  aqc::Payload box;
  box.mass = 0.5;
  box.size = {0.1, 0.1, 0.1};
  box.offset = {0.0, 0.0, -0.1};
  box.inertia = aqc::boxInertia(box.mass, box.size);

  constexpr int kRate = 500;  // [Hz]
  std::printf("time [s]  height [m]  thrust [N]\n");
  for (int step = 0; step <= 40 * kRate; ++step) {
    if (step == 20 * kRate) plant.attach(box);
    const aqc::State state = plant.state();
    const aqc::Allocation& rotors = controller.step(state, &hover, 1.0 / kRate);
    plant.step(rotors.speeds, 1.0 / kRate);
    if (step % (4 * kRate) == 0) {
      std::printf("%8d  %10.3f  %10.2f\n", step / kRate, state.position.z(),
                  rotors.achieved.thrust);
    }
  }
} catch (const std::exception& error) {
  std::fprintf(stderr, "hover: %s\n", error.what());
  return 1;
}
