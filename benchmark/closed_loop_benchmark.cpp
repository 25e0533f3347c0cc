#include <benchmark/benchmark.h>

#include <string>

#include "adaptive_quadrotor_control/simulation/closed_loop.h"
#include "support/fixtures.h"

namespace aqc {
namespace {

/// A whole flight of 117 s, plant and controller both at 1 kHz, on one core.
void flight(benchmark::State& state, const std::string& law) {
  const Vehicle vehicle = test::pelican();
  Scenario scenario = loadScenario(test::configFile("scenario/aggressive_manoeuvre"));
  scenario.world.control_period = scenario.world.plant_step;
  double flown = 0.0;
  for (auto _ : state) {
    state.PauseTiming();  // reading files is not flying
    ClosedLoop loop(scenario, vehicle, test::lawNamed(law, vehicle));
    state.ResumeTiming();
    while (!loop.done()) loop.advance();
    flown += toSeconds(loop.plant().now());
    State end = loop.plant().plant().state();
    benchmark::DoNotOptimize(end);
  }
  state.counters["times_real_time"] = benchmark::Counter(flown, benchmark::Counter::kIsRate);
}
BENCHMARK_CAPTURE(flight, asmc, "asmc")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(flight, smc, "smc")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(flight, geometric, "geometric")->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace aqc
