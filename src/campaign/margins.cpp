#include "campaign/margins.h"

#include <cmath>
#include <functional>

#include "adaptive_quadrotor_control/math/number_text.h"
#include "adaptive_quadrotor_control/simulation/closed_loop.h"
#include "campaign/fault_result.h"

namespace aqc {
namespace {

constexpr double kHover = 6.0;               // [s], then the step
constexpr double kEnd = 20.0;                // [s]
const Eigen::Vector3d kGoal(2.0, 0.0, 1.1);  // [m]
constexpr double kNear = 0.5;                // [m]
constexpr double kDelays[] = {1e-3, 0.5};    // [s]
constexpr double kRates[] = {300.0, 1.0};    // [Hz]
constexpr double kGaps[] = {0.01, 30.0};     // [s]
constexpr double kNoises[] = {1e-4, 1.0};    // [m]
constexpr double kExactness = 1.01;

using Spoil = std::function<void(SensorFaults& sensors, double value)>;

FaultFlight stepFlight(const Vehicle& vehicle) {
  FaultFlight flight = emptyFlight(1, vehicle);
  flight.scenario.duration = fromSeconds(kEnd);
  SetPoint goal;
  goal.position = kGoal;
  flight.orders = {{fromSeconds(kHover), Order::Kind::kPlan, {{fromSeconds(kHover), goal}}}};
  flight.asked.extend(goal.position);
  return flight;
}

// What is borne to one part in a hundred, between a value that is and one that is not; `borne`
// itself when not even that is, and `lost` when all is borne.
double mostBorne(const Vehicle& vehicle, const ControlLaw& law, const PilotLimits& limits,
                 const double (&range)[2], bool may_land, const Spoil& spoil) {
  const auto bears = [&](double value) {
    FaultFlight flight = stepFlight(vehicle);
    spoil(*flight.scenario.world.sensors, value);
    if (may_land) flight.scenario.duration = fromSeconds(kEnd + kGaps[1]);
    Eigen::Vector3d end = Eigen::Vector3d::Zero();
    const FaultResult result =
        flyFaults(flight, vehicle, law.clone(), limits,
                  [&](const ClosedLoop& loop) { end = loop.plant().plant().state().position; });
    const bool there = (end - kGoal).norm() < kNear;
    return (result.verdict == Verdict::kHeld && (may_land || there)) ||
           (result.verdict == Verdict::kLanded && may_land);
  };
  double borne = range[0];
  double lost = range[1];
  if (!bears(borne)) return std::nan("");
  if (bears(lost)) return lost;
  while (std::max(lost / borne, borne / lost) > kExactness) {
    const double middle = std::sqrt(borne * lost);
    (bears(middle) ? borne : lost) = middle;
  }
  return borne;
}

}  // namespace

Margins measureMargins(const Vehicle& vehicle, const ControlLaw& law, const PilotLimits& limits) {
  const auto most = [&](const double(&range)[2], bool may_land, const Spoil& spoil) {
    return mostBorne(vehicle, law, limits, range, may_land, spoil);
  };
  Margins margins;
  margins.delay = most(kDelays, false, [](SensorFaults& sensors, double delay) {
    sensors.odometry.delay = fromSeconds(delay);
  });
  margins.rate = most(kRates, false, [](SensorFaults& sensors, double rate) {
    sensors.odometry.period = fromSeconds(1.0 / rate);
  });
  margins.gap = most(kGaps, true, [](SensorFaults& sensors, double gap) {
    const TimeWindow window{fromSeconds(kHover + 1.0), fromSeconds(kHover + 1.0 + gap)};
    sensors.odometry.gaps = sensors.imu.gaps = {window};
  });
  margins.noise = most(kNoises, false, [](SensorFaults& sensors, double noise) {
    sensors.odometry.noise = {noise, kNoisePerMetre[0] * noise, kNoisePerMetre[1] * noise,
                              kNoisePerMetre[2] * noise};
  });
  return margins;
}

std::string marginsHeading() {
  return "| law | delay | odometry rate | gap without IMU | noise |\n| --- | --- | --- | --- | --- "
         "|\n";
}

std::string marginsRow(const std::string& name, const Margins& margins) {
  const double noise = margins.noise;
  return formatted(
      "| `%s` | %.1f ms | %.1f Hz | %.2f s | %.3f m, %.2f m/s, %.1f deg, %.2f rad/s |\n",
      name.c_str(), margins.delay * 1e3, margins.rate, margins.gap, noise,
      kNoisePerMetre[0] * noise, kNoisePerMetre[1] * noise * 180.0 / M_PI,
      kNoisePerMetre[2] * noise);
}

}  // namespace aqc
