#pragma once

#include <limits>

#include "adaptive_quadrotor_control/math/time.h"
#include "adaptive_quadrotor_control/reference/governor.h"

namespace aqc {

class ParameterReader;

/// What odometry and an IMU may say. Beyond it nothing is believed: see OdometryGate.
struct GateLimits {
  Nanoseconds stamp_ahead = 100'000'000;  ///< of a stamp ahead of now [ns]
  double position = 1e4;                  ///< of every coordinate [m]
  double velocity = 60.0;                 ///< [m/s]
  double body_rate = 40.0;                ///< [rad/s], of an IMU, too
  double specific_force = 200.0;          ///< of every component [m/s^2]
  double norm = 0.05;       ///< of a quaternion's norm from 1; within it, it is normalised
  double jump = 0.5;        ///< of the position from where the vehicle must be [m]
  double speed_jump = 3.0;  ///< of the velocity from what it must be [m/s]
  double turn_jump = 0.6;   ///< of the attitude from what it must be [rad]
  int confirmations = 20;   ///< jumped messages in a row that agree: the source was reset
};

/// When the guard steps in, and what it does then. Times in [s].
struct GuardLimits {
  bool auto_arm = false;  ///< arms and takes off by itself once a set point asks for height
  GateLimits gate;
  GovernorLimits governor;

  double odometry_late = 0.1;     ///< without odometry: the motion is reckoned
  double odometry_lost = 0.5;     ///< without odometry: descend, and do not wait for it
  double set_point_age = 0.0;     ///< the last set points are older: brake and hold; 0: never
  double set_point_bound = 1e3;   ///< of every coordinate of a set point [m]
  double trajectory_lead = 60.0;  ///< a trajectory may begin so far ahead

  double ground = 0.0;           ///< height of base_link's origin below which nothing flies [m]
  double clearance = 0.2;        ///< above where it stood; lower it only takes off and lands [m]
  double take_off_height = 1.0;  ///< above where it stood [m]
  double take_off_speed = 0.6;   ///< [m/s]
  double lift_off_time = 6.0;    ///< from the order to take off to the first 5 cm
  double landing_speed = 0.4;    ///< [m/s]
  double touch_down_time = 0.5;  ///< without sinking, before the rotors stop
  double descent_speed = 0.5;    ///< without odometry [m/s]
  double idle_speed = 0.0;       ///< of the rotors while armed [rad/s]

  double tumble_tilt = 1.75;  ///< [rad]: nobody flies like this
  double tumble_time = 0.1;
  double tip_tilt = 0.6;  ///< close to the ground [rad]
  double tip_time = 0.3;
  double overload = 0.95;        ///< mass carried / mass that the rotors can lift
  double overload_time = 2.0;    ///< then it lands while it can
  double saturation_time = 2.0;  ///< with all thrust asked for and the vehicle below its set point
  double rotor_loss = 0.5;       ///< moment that is not explained / a hovering rotor's
  double rotor_loss_time = 0.2;  ///< then it lands while it can
  double lag = 3.0;              ///< the vehicle is at the end of the governor's lead so long: hold
};

/// Reads limits by the names of the members, all optional, angles as `..._deg`, the maps `gate` and
/// `governor` included. Throws ParameterError.
GuardLimits readGuardLimits(const ParameterReader& reader);

}  // namespace aqc
