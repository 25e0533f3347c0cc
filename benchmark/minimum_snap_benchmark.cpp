#include "adaptive_quadrotor_control/reference/minimum_snap.h"

#include <benchmark/benchmark.h>

#include <cmath>
#include <cstddef>
#include <vector>

#include "adaptive_quadrotor_control/reference/time_allocation.h"

namespace aqc {
namespace {

/// Points on a rising curve that is neither straight nor symmetric.
std::vector<Waypoint> curve(std::size_t count) {
  std::vector<Waypoint> waypoints(count);
  for (std::size_t i = 0; i < count; ++i) {
    const auto u = static_cast<double>(i);
    waypoints[i].position = {4.0 * std::sin(0.7 * u), 3.0 * std::cos(1.1 * u), 1.0 + 0.3 * u};
    waypoints[i].yaw = 0.4 * u;
  }
  return waypoints;
}

std::vector<double> unequalDurations(std::size_t count) {
  std::vector<double> durations(count);
  for (std::size_t i = 0; i < count; ++i) {
    durations[i] = 1.0 + 0.5 * std::sin(static_cast<double>(i));
  }
  return durations;
}

void solve(benchmark::State& state) {
  const auto count = static_cast<std::size_t>(state.range(0));
  const std::vector<Waypoint> waypoints = curve(count);
  const std::vector<double> durations = unequalDurations(count - 1);
  for (auto _ : state) {
    benchmark::DoNotOptimize(minimumSnap(waypoints, durations));
  }
}
BENCHMARK(solve)->Arg(2)->Arg(10)->Arg(50)->Arg(200)->Unit(benchmark::kMicrosecond);

void solveWithinLimits(benchmark::State& state) {
  const std::vector<Waypoint> waypoints = curve(static_cast<std::size_t>(state.range(0)));
  const MotionLimits limits{5.0, 6.0, 0.6, 1.8};
  for (auto _ : state) {
    benchmark::DoNotOptimize(minimumSnapWithin(waypoints, limits));
  }
}
BENCHMARK(solveWithinLimits)->Arg(10)->Arg(50)->Unit(benchmark::kMicrosecond);

void solveWithinLimitsFromSpeed(benchmark::State& state) {
  std::vector<Waypoint> waypoints = curve(static_cast<std::size_t>(state.range(0)));
  waypoints.front().velocity = Eigen::Vector4d(1.0, 0.0, 0.0, 0.0);
  const MotionLimits limits{5.0, 6.0, 0.6, 1.8};
  for (auto _ : state) {
    benchmark::DoNotOptimize(minimumSnapWithin(waypoints, limits));
  }
}
BENCHMARK(solveWithinLimitsFromSpeed)->Arg(10)->Unit(benchmark::kMicrosecond);

void evaluate(benchmark::State& state) {
  const auto count = static_cast<std::size_t>(state.range(0));
  const PolynomialTrajectory trajectory = minimumSnap(curve(count), unequalDurations(count - 1));
  // An irrational step through the trajectory, so that no segment is favoured.
  const double step = trajectory.duration() * 0.6180339887;
  double time = 0.0;
  for (auto _ : state) {
    benchmark::DoNotOptimize(trajectory.evaluate(time));
    time += step;
    if (time > trajectory.duration()) {
      time -= trajectory.duration();
    }
  }
}
BENCHMARK(evaluate)->Arg(2)->Arg(10)->Arg(50);

}  // namespace
}  // namespace aqc

BENCHMARK_MAIN();
