#include <benchmark/benchmark.h>

#include <cstddef>
#include <vector>

#include "adaptive_quadrotor_control/simulation/rigid_plant.h"
#include "support/fixtures.h"

namespace aqc {
namespace {

/// Rotor commands around hover, so that the vehicle tumbles a little but goes nowhere.
std::vector<RotorArray> commandsAround(const RotorArray& hover) {
  test::Dice dice(1);
  std::vector<RotorArray> commands(1024, hover);
  for (RotorArray& command : commands) {
    for (double& speed : command) speed *= dice.between(0.95, 1.05);
  }
  return commands;
}

/// One airborne step of 1 ms.
void plantStep(benchmark::State& state, bool loaded) {
  const Vehicle vehicle = test::pelican();
  State start;
  start.position.z() = 1000.0;
  RigidPlant plant(vehicle, start);
  if (loaded) plant.attach(test::box(0.5));
  const std::vector<RotorArray> commands = commandsAround(test::hoverSpeeds(vehicle, plant.mass()));
  const RigidPlant fresh = plant;
  std::size_t next = 0;
  for (auto _ : state) {
    plant.step(commands[next], 1e-3);
    State after = plant.state();
    benchmark::DoNotOptimize(after);
    if (++next == commands.size()) {
      next = 0;
      plant = fresh;  // once a simulated second, before it falls to the ground
    }
  }
  state.SetLabel("for comparison: flightmare 360 ns, MRS 732 ns, kr 1169 ns, MuJoCo 1.2-1.7 us");
}
BENCHMARK_CAPTURE(plantStep, empty, false);
BENCHMARK_CAPTURE(plantStep, with_payload, true);

}  // namespace
}  // namespace aqc
