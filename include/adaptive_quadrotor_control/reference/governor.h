#pragma once

#include <Eigen/Core>
#include <limits>

#include "adaptive_quadrotor_control/reference/set_point.h"

namespace aqc {

class ParameterReader;

/// How the reference may move and how far it may run ahead of the vehicle; each > 0 but `floor`,
/// and at the most 1e6.
struct GovernorLimits {
  double horizontal_speed = 4.0;       ///< [m/s]
  double climb_speed = 2.0;            ///< [m/s]
  double descent_speed = 1.5;          ///< [m/s]
  double acceleration = 4.0;           ///< horizontal [m/s^2]
  double vertical_acceleration = 3.0;  ///< up and down [m/s^2]
  double jerk = 20.0;                  ///< horizontal and, apart from it, vertical [m/s^3]
  double yaw_rate = 1.5;               ///< [rad/s]
  double yaw_acceleration = 4.0;       ///< [rad/s^2]; takes 0.1 s to build up
  double lead = 1.0;  ///< longest distance from the vehicle, horizontally and vertically apart [m]
  double floor = -std::numeric_limits<double>::infinity();  ///< lowest height in W to go to [m]
};

/// Reads limits by the names of the fields, all optional. Throws ParameterError.
GovernorLimits readGovernorLimits(const ParameterReader& reader);

/// Stands between where the vehicle is wanted, which may be far away and jump, and the control law,
/// which is to be given a smooth motion nearby.
///
/// Speed, acceleration and jerk of the reference keep the limits at every step, whatever is wanted:
/// of (x, y) by the length of the vector, of z and of yaw each by itself. A wanted motion that
/// keeps them, with its speed not above the limit after its acceleration is let go at the jerk
/// allowed either, is given to the law as it is once the reference has caught up with it. The
/// reference goes to other points by a square-root controller and stops there without overshoot.
///
/// The controller is in the form of shape_pos_vel_accel_xy() of ArduPilot's AP_Math library, with
/// the acceleration that the braking curve itself needs fed forward.
class ReferenceGovernor {
 public:
  /// The limits must be in the ranges given in GovernorLimits.
  explicit ReferenceGovernor(const GovernorLimits& limits) noexcept : limits_(limits) {}

  /// Begins anew with position, velocity, yaw and yaw rate of `at`, without acceleration. What is
  /// faster than the limits brakes within the limits of acceleration and jerk.
  void restart(const SetPoint& at) noexcept;

  /// Adds `position` [m] and `yaw` [rad] to the reference and turns its velocity, acceleration and
  /// jerk by `yaw`: for odometry that was reset.
  void shift(const Eigen::Vector3d& position, double yaw) noexcept;

  /// The reference `dt` [s] later, on its way to `wanted`, the set point of that time. Steps of up
  /// to 0.025 s are taken at once, longer ones in pieces, more than 2 s as 2 s. Unless started, it
  /// begins at rest at `actual` with the yaw wanted.
  ///
  /// `actual` is the vehicle's position in W [m]. The reference slows down when the vehicle is more
  /// than half of `lead` behind it, and is never further away than `lead`, in the horizontal by the
  /// length of the vector and in z by itself: it is put back where the
  /// limits of motion do not suffice. `thrust_to_weight`, the largest thrust over the estimated
  /// weight, bounds acceleration to what the rotors can do with a tenth kept for steering. A wanted
  /// height below `floor` or GovernorLimits::floor [m] means the higher one of these.
  ///
  /// A `wanted` that is not valid() means to stay at the last valid one, and before there was any,
  /// where the reference began. Numbers of `actual`, `thrust_to_weight` and `floor` that are not
  /// numbers bound nothing; a `dt` that is not > 0 changes nothing.
  const SetPoint& follow(const SetPoint& wanted, const Eigen::Vector3d& actual,
                         double thrust_to_weight, double floor, double dt) noexcept;
  const SetPoint& setPoint() const noexcept { return reference_; }

 private:
  void take(const SetPoint& wanted, double floor) noexcept;
  void step(const Eigen::Vector3d& actual, double thrust_to_weight, double dt) noexcept;
  void stayNear(const Eigen::Vector3d& actual) noexcept;

  GovernorLimits limits_;
  SetPoint reference_;
  SetPoint wanted_;  // the last valid one
  bool started_ = false;
};

}  // namespace aqc
