#pragma once

#include <visualization_msgs/Marker.h>

#include <Eigen/Core>
#include <deque>
#include <vector>

#include "adaptive_quadrotor_control/math/time.h"
#include "adaptive_quadrotor_control/reference/set_point_schedule.h"

namespace aqc {

/// Where the vehicle and its set point have been, thinned out, and how far apart they were.
class FlightTrail {
 public:
  static constexpr double kSpacing = 0.04;         ///< between points kept [m]
  static constexpr double kTeleport = 1.0;         ///< the line breaks at longer jumps [m]
  static constexpr std::size_t kMaxPoints = 6000;  ///< older ones are forgotten

  /// The error colours the point; without a set point it is 0.
  void add(const Eigen::Vector3d& position, double error);
  void clear() { points_.clear(); }
  std::size_t size() const { return points_.size(); }

  /// Lines in `world`, coloured by errorColour(). Namespace "flown".
  visualization_msgs::Marker marker() const;

 private:
  struct Point {
    Eigen::Vector3d position;
    double error;
  };
  std::deque<Point> points_;
};

/// The path of the reference: set points as they were flown, then those still to come.
class ReferenceTrail {
 public:
  static constexpr double kSpacing = 0.05;  ///< [m]

  /// Everything planned, in place of what was planned before.
  void plan(std::vector<TimedSetPoint> set_points);
  /// The set point that is active at `now`.
  void add(const Eigen::Vector3d& position, Nanoseconds now);
  void clear();

  /// Lines in `world`: past bright, future faint. Namespace "reference".
  visualization_msgs::Marker marker() const;

 private:
  std::deque<Eigen::Vector3d> past_;
  std::vector<TimedSetPoint> planned_;
  Nanoseconds now_ = 0;
};

}  // namespace aqc
