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

/// What a law met in twenty seconds of a real flight: two steps of metres with a payload.
std::vector<Moment> recordFlight(const Vehicle& vehicle, const std::string& law) {
  Scenario scenario = loadScenario(test::configFile("scenario/aggressive_manoeuvre"));
  scenario.duration = fromSeconds(70.0);
  const FlightLog log = fly(scenario, vehicle, law, test::lawNamed(law, vehicle), {});
  std::vector<Moment> moments;
  for (const FlightSample& sample : log.samples) {
    if (sample.time < fromSeconds(50.0)) continue;
    Moment moment = {{sample.state}, sample.set_point};
    moment.sensed.specific_force = kGravity * Eigen::Vector3d::UnitZ();  // as good as any
    moments.push_back(moment);
  }
  return moments;
}

/// One whole control step: the law and the allocation to rotor speeds. It meets what `flown` met,
/// `age` seconds late.
void controlStep(benchmark::State& state, const std::string& law, const std::string& flown,
                 double age) {
  const Vehicle vehicle = test::pelican();
  std::vector<Moment> moments = recordFlight(vehicle, flown);
  for (Moment& moment : moments) moment.sensed.ages.pose = moment.sensed.ages.body_rate = age;
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
BENCHMARK_CAPTURE(controlStep, asmc, "asmc", "asmc", 0.0);
BENCHMARK_CAPTURE(controlStep, smc, "smc", "smc", 0.0);
BENCHMARK_CAPTURE(controlStep, geometric, "geometric", "geometric", 0.0);
// Tuned for another vehicle: they need not fly this one.
BENCHMARK_CAPTURE(controlStep, integral, "integral", "geometric", 0.0);
BENCHMARK_CAPTURE(controlStep, l1, "l1", "geometric", 0.0);
BENCHMARK_CAPTURE(controlStep, composite, "composite", "composite", 0.0);
BENCHMARK_CAPTURE(controlStep, composite_20_ms_late, "composite", "composite", 0.02);

}  // namespace
}  // namespace aqc
