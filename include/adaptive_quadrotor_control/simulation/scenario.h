#pragma once

#include <Eigen/Core>
#include <map>
#include <string>
#include <vector>

#include "adaptive_quadrotor_control/parameters/parameter_reader.h"
#include "adaptive_quadrotor_control/simulation/mission.h"
#include "adaptive_quadrotor_control/simulation/world.h"

namespace aqc {

/// Root-mean-square errors of a flight.
struct RmsErrors {
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  ///< [m]
  Eigen::Vector3d attitude = Eigen::Vector3d::Zero();  ///< of e_q: roll, pitch, yaw [deg]
};

/// What is flown: the whole of a config/scenario/*.yaml file.
struct Scenario {
  std::string name;
  std::string title;
  std::string vehicle;                   ///< name of a vehicle file
  std::vector<std::string> controllers;  ///< names of controller files, flown by default
  World world;
  Mission mission;
  Nanoseconds duration = 0;
  Nanoseconds metrics_from = 0;                ///< RMS errors count from here to the end
  std::map<std::string, RmsErrors> published;  ///< by controller

  /// When the payload, or the body that stands for one, last changed, or 0.
  Nanoseconds lastPayloadChange() const;
};

/// Reads and validates a scenario; does not call reader.finish(). Throws ParameterError.
Scenario readScenario(const ParameterReader& reader);

/// The world of a scenario, for who needs nothing else: no mission is planned. The other parts are
/// taken as they are, whatever they hold; names that no scenario has are still left for
/// reader.finish() to refuse, which it does not call. Throws ParameterError.
World readWorldAlone(const ParameterReader& reader);

/// The scenario of a YAML file. Throws ParameterError.
Scenario loadScenario(const std::string& path);

}  // namespace aqc
