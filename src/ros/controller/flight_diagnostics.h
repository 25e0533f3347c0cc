#pragma once

#include <diagnostic_updater/diagnostic_updater.h>
#include <ros/ros.h>

#include <vector>

#include "adaptive_quadrotor_control/pilot/flight_monitor.h"

namespace aqc {

/// What a FlightMonitor finds, on /diagnostics once a wall-clock second (REP-107).
class FlightDiagnostics {
 public:
  /// `node_name` stands before every finding. The timer runs in the queue of `node`, where the
  /// monitor's counting must happen, too.
  FlightDiagnostics(const ros::NodeHandle& node, const ros::NodeHandle& private_node,
                    const std::string& node_name, FlightMonitor monitor);

  /// To count with. Every accepted odometry must be told to heardOdometry(), too.
  FlightMonitor& monitor() { return monitor_; }
  void heardOdometry() { last_odometry_ = ros::SteadyTime::now(); }

 private:
  void onTimer(const ros::WallTimerEvent& event);

  FlightMonitor monitor_;
  ros::SteadyTime last_odometry_;
  std::vector<Finding> findings_;
  diagnostic_updater::Updater updater_;
  ros::WallTimer timer_;
};

}  // namespace aqc
