#pragma once

#include <ros/ros.h>

#include <functional>
#include <optional>
#include <string>

#include "adaptive_quadrotor_control/ControllerState.h"
#include "adaptive_quadrotor_control/PlantStatus.h"
#include "adaptive_quadrotor_control/flight/collector.h"
#include "adaptive_quadrotor_control/model/vehicle.h"
#include "adaptive_quadrotor_control/simulation/scenario.h"
#include "ros/border/conversions.h"

namespace aqc {

/// Plays the parameter tree `scenario` against a running plant and controller, and collects the
/// flight.
///
/// Everything is sent before the plant is resumed and carries the time at which it acts: the set
/// points as one `command/trajectory`, switches of subsystems on `active_subsystem`, what happens
/// to the plant as service calls. Nothing depends on when this process happens to be scheduled.
class MissionNode {
 public:
  /// Throws ParameterError.
  MissionNode();

  /// Flies to the end. Throws std::runtime_error, saying what was waited for, when plant or
  /// controller do not answer, refuse an event, or fall silent in flight.
  FlightLog fly();

  const Scenario& scenario() const noexcept { return scenario_; }
  const Vehicle& vehicle() const noexcept { return vehicle_; }

 private:
  void onState(const msgs::ControllerState::ConstPtr& message);
  void onStatus(const msgs::PlantStatus::ConstPtr& message);
  void waitFor(const std::string& what, const std::function<bool()>& condition) const;
  void sendSetPoints();
  void sendSwitches();
  void sendEvents();
  void resume();
  void watch();
  template <class Service>
  void callPlant(const std::string& name, Service& service);

  ros::NodeHandle node_;
  Vehicle vehicle_;
  Scenario scenario_;
  ros::Publisher trajectory_publisher_;
  ros::Publisher switch_publisher_;
  ros::Subscriber state_subscriber_;
  ros::Subscriber status_subscriber_;

  msgs::PlantStatus::ConstPtr status_;     // latest
  msgs::ControllerState::ConstPtr state_;  // latest
  Nanoseconds begin_ = 0;                  // ROS time of the scenario's time zero
  std::optional<Collector> collector_;     // while it flies
};

}  // namespace aqc
