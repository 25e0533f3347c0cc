#pragma once

#include <Eigen/Core>
#include <map>
#include <string>
#include <vector>

#include "adaptive_quadrotor_control/law/switched/switch_schedule.h"
#include "adaptive_quadrotor_control/model/state.h"
#include "adaptive_quadrotor_control/reference/set_point_schedule.h"
#include "adaptive_quadrotor_control/simulation/timed_plant.h"

namespace aqc {

class ParameterReader;

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
  Nanoseconds duration = 0;
  Nanoseconds control_period = 0;  ///< a whole number of plant steps
  Nanoseconds plant_step = 0;
  State start;
  std::vector<TimedSetPoint> set_points;  ///< by time
  std::vector<PlantEvent> events;         ///< by time
  std::vector<SwitchOrder> switches;      ///< by time; for laws with several subsystems
  std::vector<Cargo> cargo;               ///< payloads that lie about at the start
  std::vector<Box> walls;
  bool ground = true;  ///< at z = 0; false: free flight everywhere, and nothing lies about
  Nanoseconds metrics_from = 0;                ///< RMS errors count from here to the end
  std::map<std::string, RmsErrors> published;  ///< by controller

  /// When the payload, or the body that stands for one, last changed, or 0.
  Nanoseconds lastPayloadChange() const;
};

/// Reads and validates a scenario; does not call reader.finish(). Throws ParameterError.
Scenario readScenario(const ParameterReader& reader);

/// The scenario of a YAML file. Throws ParameterError.
Scenario loadScenario(const std::string& path);

}  // namespace aqc
