#pragma once

#include <map>
#include <string>
#include <vector>

#include "adaptive_quadrotor_control/flight/metrics.h"
#include "adaptive_quadrotor_control/parameters/parameter_reader.h"
#include "adaptive_quadrotor_control/simulation/mission.h"
#include "adaptive_quadrotor_control/simulation/world.h"

namespace aqc {

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

/// What the metrics of its flights are about.
MetricsWindow metricsWindow(const Scenario& scenario);

/// Reads and validates a scenario; does not call reader.finish(). Throws ParameterError.
Scenario readScenario(const ParameterReader& reader);

/// The world of a scenario, for who needs nothing else: no mission is planned. The other parts are
/// taken as they are, whatever they hold; names that no scenario has are still left for
/// reader.finish() to refuse, which it does not call. Throws ParameterError.
World readWorldAlone(const ParameterReader& reader);

/// The scenario of a YAML file. Throws ParameterError.
Scenario loadScenario(const std::string& path);

}  // namespace aqc
