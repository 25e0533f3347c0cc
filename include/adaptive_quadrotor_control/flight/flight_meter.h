#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>

#include "adaptive_quadrotor_control/flight/metrics.h"
#include "adaptive_quadrotor_control/math/time.h"

namespace aqc {

/// Measures a flight step by step, while it is flown, without keeping it. The metrics are those of
/// the flight's log to the last bit: measure() reads a log through this class.
class FlightMeter {
 public:
  /// What it must know of one control step.
  struct Step {
    Nanoseconds time;
    bool flying;                            ///< a set point was active
    bool touching;                          ///< the ground
    const Eigen::Vector3d& position_error;  ///< e_p in W [m]; not read unless flying
    const Eigen::Vector3d& attitude_error;  ///< e_q in B [rad]; not read unless flying
  };

  /// `name` of the flight: for error messages.
  FlightMeter(const MetricsWindow& window, std::string name);

  /// Takes in the next step; times must not fall. Allocates nothing.
  void add(const Step& step) noexcept;

  /// Of the steps so far, for a flight that crashed then, if it did. Throws std::invalid_argument
  /// when no step with a set point fell into the window or into its last 5 s.
  FlightMetrics metrics(const std::optional<Nanoseconds>& crash_time) const;

 private:
  MetricsWindow window_;
  std::string name_;
  Eigen::Array3d position_ = Eigen::Array3d::Zero();  // sum of squares in the window
  Eigen::Array3d attitude_ = Eigen::Array3d::Zero();  // the same
  int count_ = 0;                                     // of steps in them
  double peak_ = 0.0;
  double settled_ = 0.0;  // sum
  int settled_count_ = 0;
  std::optional<Eigen::Vector2d> lateral_error_;  // of the last step that flew
  std::optional<Nanoseconds> grounded_from_;      // until the last step
};

}  // namespace aqc
