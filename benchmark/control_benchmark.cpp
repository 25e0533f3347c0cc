#include <benchmark/benchmark.h>

#include <cstddef>
#include <string>
#include <vector>

#include "adaptive_quadrotor_control/pilot/flight_controller.h"
#include "adaptive_quadrotor_control/simulation/flight_simulation.h"
#include "support/fixtures.h"

namespace aqc {
namespace {

struct Moment {
  Sensed sensed;
  SetPoint set_point;
};

/// What the law met in twenty seconds of a real flight: two steps of metres with a payload.
std::vector<Moment> recordFlight(const Vehicle& vehicle, const std::string& law) {
  Scenario scenario = loadScenario(test::configFile("scenario/aggressive_manoeuvre"));
  scenario.duration = fromSeconds(70.0);
  const FlightLog log = fly(scenario, vehicle, law, test::lawNamed(law, vehicle), {});
  std::vector<Moment> moments;
  for (const FlightSample& sample : log.samples) {
    if (sample.time >= fromSeconds(50.0)) moments.push_back({{sample.state}, sample.set_point});
  }
  return moments;
}

/// One whole control step: the law and the allocation to rotor speeds.
void controlStep(benchmark::State& state, const std::string& law) {
  const Vehicle vehicle = test::pelican();
  const std::vector<Moment> moments = recordFlight(vehicle, law);
  FlightController controller(vehicle, test::lawNamed(law, vehicle));
  std::size_t next = 0;
  for (auto _ : state) {
    const Moment& moment = moments[next];
    benchmark::DoNotOptimize(controller.step(moment.sensed, &moment.set_point, 0.01).speeds.data());
    benchmark::ClobberMemory();
    if (++next == moments.size()) next = 0;
  }
  state.SetLabel("for comparison: RotorS Lee 136 ns, published ASMC code 308 ns, kr so3 81 ns");
}
BENCHMARK_CAPTURE(controlStep, asmc, "asmc");
BENCHMARK_CAPTURE(controlStep, smc, "smc");
BENCHMARK_CAPTURE(controlStep, geometric, "geometric");

}  // namespace
}  // namespace aqc
