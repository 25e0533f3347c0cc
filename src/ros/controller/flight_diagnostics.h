#pragma once

#include <diagnostic_updater/diagnostic_updater.h>
#include <ros/ros.h>

#include <functional>
#include <string>
#include <vector>

#include "adaptive_quadrotor_control/pilot/flight_monitor.h"

namespace aqc {

/// What a pilot finds, on /diagnostics once a wall-clock second (REP-107).
class FlightDiagnostics {
 public:
  /// Judges at a ROS time, after so many seconds without odometry by the wall clock.
  using Judge = std::function<std::vector<Finding>(Nanoseconds now, double silence)>;

  /// `names` are those of the findings, in their order. `node_name` stands before every finding.
  /// `judge` is called in the queue of `node`.
  FlightDiagnostics(const ros::NodeHandle& node, const ros::NodeHandle& private_node,
                    const std::string& node_name, const std::vector<std::string>& names,
                    Judge judge);

  /// Every accepted odometry must be told.
  void heardOdometry() { last_odometry_ = ros::SteadyTime::now(); }

 private:
  void onTimer(const ros::WallTimerEvent& event);

  Judge judge_;
  ros::SteadyTime last_odometry_;
  std::vector<Finding> findings_;
  diagnostic_updater::Updater updater_;
  ros::WallTimer timer_;
};

}  // namespace aqc
