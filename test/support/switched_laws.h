#pragma once

#include <yaml-cpp/yaml.h>

#include <Eigen/Core>
#include <memory>

#include "adaptive_quadrotor_control/law/switched/switched.h"
#include "adaptive_quadrotor_control/parameters/parameter_reader.h"
#include "support/fixtures.h"

/// Switched laws and a situation to try them in.
namespace aqc::test {

/// config/controller/switched.yaml.
inline YAML::Node thesisTree() {
  return loadYamlFile(configFile("controller/switched"));
}

/// Numbers for work by hand: K_1 = K_2 = I and Q = 2 I give P = [3 1; 1 2] an axis, r = e + 2 de,
/// lambda_max(P) = (5 + sqrt 5) / 2.
inline YAML::Node plainTree() {
  return YAML::Load(R"(
law: switched
boundary_layer: 0.5
acceleration_cut_off: 10.0
chatter_bound: 4
switching_policy: refuse
subsystems:
  - &plain
    error_gain: [1, 1, 1, 1]
    rate_gain: [1, 1, 1, 1]
    input_gain: [2, 3, 4, 5]
    weight: [2, 2, 2, 2, 2, 2, 2, 2]
    leak: [1.0, 2.0, 3.0, 4.0]
    gamma_drive: 0.01
    zeta_drive: 0.02
    initial_theta: [0.1, 0.2, 0.3, 0.4]
    initial_zeta: 0.5
    initial_gamma: 0.25
  - *plain
)");
}

/// lambda_min(Q) / lambda_max(P) of plainTree().
constexpr double kVarrho = 2.0 / 3.618033988749895;

inline std::unique_ptr<Switched> makeLaw(const YAML::Node& tree) {
  const ParameterReader reader(tree, "switched");
  reader.text("law");
  auto law = std::make_unique<Switched>(reader, pelican());
  reader.finish();
  return law;
}

/// 0.3 m too high, climbing 0.4 m/s too fast: ||xi|| = 0.5, r_z = 0.3 + 0.8 = 1.1.
inline State tooHigh() {
  State state;
  state.position = {7.0, -8.0, 1.3};
  state.velocity = {0.0, 0.0, 0.6};
  return state;
}

/// At 1 m, climbing with 0.2 m/s and 0.5 m/s^2.
inline SetPoint climb() {
  SetPoint set_point;
  set_point.position.z() = 1.0;
  set_point.velocity.z() = 0.2;
  set_point.acceleration.z() = 0.5;
  return set_point;
}

/// What an accelerometer reads on the way up with 2 m/s^2.
inline const Eigen::Vector3d kClimbing(0.0, 0.0, kGravity + 2.0);

}  // namespace aqc::test
