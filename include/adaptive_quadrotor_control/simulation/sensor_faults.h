#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <limits>
#include <vector>

#include "adaptive_quadrotor_control/math/time.h"

namespace aqc {

class ParameterReader;

/// A part of a flight; times count from its start.
struct TimeWindow {
  Nanoseconds from = 0;
  Nanoseconds until = std::numeric_limits<Nanoseconds>::max();  ///< not in it any more

  bool contains(Nanoseconds time) const noexcept { return from <= time && time < until; }
};

/// Standard deviations of the white noise on each axis.
struct OdometryNoise {
  double position = 0.0;   ///< [m]
  double velocity = 0.0;   ///< [m/s]
  double attitude = 0.0;   ///< about each axis of B [rad]
  double body_rate = 0.0;  ///< [rad/s]
};

/// Slow errors that come and go, as of visual-inertial odometry over known ground: a Gauss-Markov
/// process of first order on each axis, in its steady state from the start.
struct OdometryWander {
  double position = 0.0;  ///< standard deviation on each axis of W [m]
  double attitude = 0.0;  ///< about each axis of B [rad]
  double time = 1.0;      ///< after which an error is forgotten, tau [s], > 0
};

/// The estimator's world moves against the true one: about the vertical through the vehicle, then
/// along. Positions, velocities and attitudes stay consistent with each other.
struct OdometryJump {
  TimeWindow window;                                   ///< without an end: for ever
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  ///< [m]
  double yaw = 0.0;                                    ///< [rad]
};

/// Stamps are wrong by `offset` for measurements of the window.
struct StampError {
  TimeWindow window;
  Nanoseconds offset = 0;
};

/// What is wrong with the way from the true state to the odometry that a pilot hears.
struct OdometryFaults {
  Nanoseconds period = 0;   ///< between measurements, > 0; rounded up to steps of the plant
  Nanoseconds delay = 0;    ///< from measurement to arrival, >= 0
  Nanoseconds jitter = 0;   ///< the delay is longer by 0 up to this, evenly; the order stays
  double dropped = 0.0;     ///< share of messages that never arrive, 0 to 1
  double duplicated = 0.0;  ///< share that arrives twice
  double reordered = 0.0;   ///< share that is one and a half periods late, after the next one
  OdometryNoise noise;
  OdometryWander wander;
  double position_drift = 0.0;      ///< random walk, as of visual-inertial odometry [m/sqrt(s)]
  double yaw_drift = 0.0;           ///< [rad/sqrt(s)]
  std::vector<TimeWindow> gaps;     ///< nothing is measured
  std::vector<TimeWindow> freezes;  ///< the state is that of the first measurement in it
  std::vector<TimeWindow> not_a_number;  ///< every number is NaN
  std::vector<OdometryJump> jumps;
  std::vector<StampError> stamps;
};

/// What is wrong with accelerometer and gyroscope; vectors in B.
struct ImuFaults {
  Nanoseconds period = 0;  ///< as of odometry
  Nanoseconds delay = 0;
  double force_noise = 0.0;  ///< standard deviation on each axis of the specific force [m/s^2]
  double rate_noise = 0.0;   ///< of the angular rate [rad/s]
  Eigen::Vector3d force_bias = Eigen::Vector3d::Zero();  ///< [m/s^2]
  Eigen::Vector3d rate_bias = Eigen::Vector3d::Zero();   ///< [rad/s]
  std::vector<TimeWindow> gaps;                          ///< silence
  std::vector<StampError> stamps;
};

/// The section `sensors` of a scenario. The same seed gives the same flight to the last bit.
struct SensorFaults {
  std::uint64_t seed = 0;
  OdometryFaults odometry;
  ImuFaults imu;
};

/// Reads a section:
///
///     seed: 1                     a whole number >= 0
///     clock_steps: [{at, by}]     stamps of odometry and IMU are wrong by so much [s] from then on
///     odometry:
///       rate, delay, jitter       [Hz, s, s]; the rate is that of control when not given
///       dropped, duplicated, reordered       shares, 0 to 1
///       noise: {position, velocity, attitude_deg, body_rate}     standard deviations
///       wander: {position, attitude_deg, time}   slow, bounded errors; time in s, 1 if not given
///       drift: {position, yaw_deg}           in a second; grows with the root of time
///       gaps, freezes, not_a_number: [{from, until}]
///       jumps: [{from, until, position: [x, y, z], yaw_deg}]     for ever without `until`
///       stamps: [{from, until, offset}]      [s]
///     imu:
///       rate, delay
///       noise: {specific_force, body_rate}
///       bias: {specific_force: [x, y, z], body_rate: [x, y, z]}
///       gaps: [{from, until}]
///
/// All but the seed may be left out. Throws ParameterError.
SensorFaults readSensorFaults(const ParameterReader& reader, Nanoseconds control_period);

}  // namespace aqc
