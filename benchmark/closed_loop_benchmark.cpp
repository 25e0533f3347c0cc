#include <benchmark/benchmark.h>

#include <memory>
#include <string>
#include <utility>

#include "adaptive_quadrotor_control/simulation/closed_loop.h"
#include "adaptive_quadrotor_control/simulation/flight_simulation.h"
#include "support/fixtures.h"

namespace aqc {
namespace {

Scenario scenarioNamed(const std::string& name) {
  return loadScenario(test::configFile("scenario/" + name));
}

/// A whole flight of 117 s, plant and controller both at 1 kHz, on one core.
void flight(benchmark::State& state, const std::string& law) {
  const Vehicle vehicle = test::pelican();
  Scenario scenario = scenarioNamed("aggressive_manoeuvre");
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

/// Flights of a campaign, by asmc as the scenario has it: only their metrics are wanted.
template <class Fly>
void campaign(benchmark::State& state, const std::string& name, Fly measured) {
  const Scenario scenario = scenarioNamed(name);
  const Vehicle vehicle = test::vehicleNamed(scenario.vehicle);
  for (auto _ : state) {
    state.PauseTiming();
    std::unique_ptr<ControlLaw> law = test::lawNamed("asmc", vehicle);
    state.ResumeTiming();
    const FlightMetrics metrics = measured(scenario, vehicle, std::move(law));
    benchmark::DoNotOptimize(metrics.settled_altitude_error);
  }
  state.counters["flights_per_second"] =
      benchmark::Counter(static_cast<double>(state.iterations()), benchmark::Counter::kIsRate);
}

void withLog(benchmark::State& state, const std::string& name) {
  campaign(state, name, [](const Scenario& scenario, const Vehicle& vehicle, auto law) {
    const FlightLog log = fly(scenario, vehicle, "asmc", std::move(law), {});
    return measure(log, metricsWindow(scenario));
  });
}
BENCHMARK_CAPTURE(withLog, hover_payload, "hover_payload")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(withLog, aggressive_manoeuvre, "aggressive_manoeuvre")
    ->Unit(benchmark::kMillisecond);

void withMeter(benchmark::State& state, const std::string& name) {
  campaign(state, name, flyMeasured);
}
BENCHMARK_CAPTURE(withMeter, hover_payload, "hover_payload")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(withMeter, aggressive_manoeuvre, "aggressive_manoeuvre")
    ->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace aqc
