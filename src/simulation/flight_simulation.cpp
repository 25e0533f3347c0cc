#include "adaptive_quadrotor_control/simulation/flight_simulation.h"

#include <algorithm>
#include <utility>

#include "adaptive_quadrotor_control/flight/flight_meter.h"
#include "adaptive_quadrotor_control/simulation/closed_loop.h"

namespace aqc {
namespace {

// Flies to the end; calls record(time, touching) after every control step with what it began with.
template <class Record>
void flyToTheEnd(ClosedLoop& loop, Record record) {
  while (!loop.done()) {
    const Nanoseconds time = loop.plant().now();
    const bool touching = loop.plant().plant().touching();
    loop.advance();
    record(time, touching);
  }
}

// What the plant and the switches refused, by time.
std::vector<Refusal> refusalsOf(const ClosedLoop& loop) {
  std::vector<Refusal> refusals = loop.plant().refusals();
  refusals.insert(refusals.end(), loop.objections().begin(), loop.objections().end());
  const auto earlier = [](const Refusal& a, const Refusal& b) { return a.time < b.time; };
  std::stable_sort(refusals.begin(), refusals.end(), earlier);
  return refusals;
}

}  // namespace

FlightLog fly(const Scenario& scenario, const Vehicle& vehicle, const std::string& controller_name,
              std::unique_ptr<ControlLaw> law, const std::function<void(double)>& progress) {
  ClosedLoop loop(scenario, vehicle, std::move(law));
  FlightLog log;
  log.controller = controller_name;
  log.adaptive_quantities = loop.pilot().law().adaptiveQuantities();
  if (const SubsystemSwitch* subsystems = loop.pilot().law().subsystems()) {
    log.dwell_time = subsystems->text();
  }
  const Nanoseconds steps = (scenario.duration - 1) / scenario.world.control_period + 1;
  log.samples.reserve(static_cast<std::size_t>(std::max<Nanoseconds>(steps, 0)));
  flyToTheEnd(loop, [&](Nanoseconds, bool) {
    log.samples.push_back(loop.sample());
    if (progress) {
      progress(static_cast<double>(loop.plant().now()) / static_cast<double>(scenario.duration));
    }
  });
  log.refusals = refusalsOf(loop);
  log.crash_time = loop.plant().crashTime();
  if (log.crash_time) log.crash_reason = toString(loop.plant().plant().crash());
  return log;
}

FlightMetrics flyMeasured(const Scenario& scenario, const Vehicle& vehicle,
                          std::unique_ptr<ControlLaw> law) {
  ClosedLoop loop(scenario, vehicle, std::move(law));
  FlightMeter meter(metricsWindow(scenario), scenario.name);
  flyToTheEnd(loop, [&](Nanoseconds time, bool touching) {
    const Telemetry& telemetry = loop.pilot().law().telemetry();
    meter.add({time, loop.pilot().flying(), touching, telemetry.position_error,
               telemetry.attitude_error});
  });
  return meter.metrics(loop.plant().crashTime());
}

}  // namespace aqc
