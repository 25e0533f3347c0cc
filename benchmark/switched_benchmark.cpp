#include <benchmark/benchmark.h>

#include <vector>

#include "adaptive_quadrotor_control/law/switched/switched.h"
#include "adaptive_quadrotor_control/parameters/parameter_reader.h"
#include "adaptive_quadrotor_control/pilot/flight_controller.h"
#include "support/fixtures.h"

namespace aqc {
namespace {

/// One whole control step of the switched law with `range` subsystems: accelerometer, law and
/// allocation. The states are those near hover that the law is meant for.
void switchedStep(benchmark::State& state) {
  YAML::Node tree = loadYamlFile(test::configFile("controller/switched"));
  const YAML::Node first = tree["subsystems"][0];
  tree["subsystems"] = YAML::Node(YAML::NodeType::Sequence);
  for (int i = 0; i < state.range(0); ++i) tree["subsystems"].push_back(YAML::Clone(first));
  const Vehicle vehicle = test::pelican();
  FlightController controller(vehicle, makeLaw(ParameterReader(tree, "switched"), vehicle));

  test::Dice dice(1);
  std::vector<Sensed> moments(256);
  for (Sensed& moment : moments) {
    State& s = moment.state;
    moment.specific_force = Eigen::Vector3d(0.1, 0.0, kGravity);
    s.position = dice.vector(0.1);
    s.velocity = dice.vector(0.1);
    s.attitude = Eigen::Quaterniond(
        Eigen::AngleAxisd(dice.between(-0.2, 0.2), dice.vector(1.0).normalized()));
    s.body_rate = dice.vector(0.2);
  }
  const SetPoint set_point;
  std::size_t next = 0;
  for (auto _ : state) {
    benchmark::DoNotOptimize(controller.step(moments[next], &set_point, 1e-3).speeds.data());
    benchmark::ClobberMemory();
    next = (next + 1) % moments.size();
  }
  state.SetLabel("wanted: at most 400 ns with 3 subsystems");
}
BENCHMARK(switchedStep)->Arg(1)->Arg(3)->Arg(kMaxSubsystems);

}  // namespace
}  // namespace aqc
