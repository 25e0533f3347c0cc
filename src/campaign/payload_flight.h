#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "adaptive_quadrotor_control/model/vehicle.h"
#include "adaptive_quadrotor_control/simulation/scenario.h"

namespace aqc {

/// What all flights of a payload campaign have in common.
struct PayloadConditions {
  bool imu = true;     ///< there is an accelerometer
  bool wrong = false;  ///< vehicle file and sensors are wrong in everything
};

/// A flight with a payload, all drawn from its seed.
struct PayloadFlight {
  std::uint64_t seed = 0;
  Scenario scenario;
  Vehicle airframe;                   ///< the true one
  std::vector<TimeWindow> uncounted;  ///< errors in these are not the law's
  std::string text;                   ///< what was drawn
};

/// 30 s from the ground on: a hover at 2 m, steps of up to 4 m or a circle of 2 m at 0.4 to 1
/// rad/s. A payload of up to 0.6 times the empty mass hangs up to 3 cm aside in x and y and 8 to 25
/// cm below, from 6 to 10 s until 18 to 24 s; from 8 to 20 s on there is a wind of up to 8 m/s.
/// Motion capture (1 mm, 1 cm/s, 0.05 deg) or visual-inertial odometry (2 mm, 3 cm/s, 0.2 deg, and
/// slowly 2 cm and 0.45 deg in all), 0, 10 or 20 ms late, and with it the body rate (0.01 rad/s);
/// an IMU (0.1 m/s^2, 0.01 rad/s). Control runs at 250 Hz.
///
/// With everything wrong the airframe's force constant is 0.9 to 1.15 times what `vehicle` says,
/// the lag of its rotors 0.6 to 1.6, its inertia 0.8 to 2 and its mass 0.95 to 1.1 times; each axis
/// of the accelerometer is biased by up to 0.2 m/s^2, the IMU is up to 5 ms and the odometry up to
/// 20 ms late. All else is as it is without.
///
/// The same seed, vehicle and conditions give the same flight; conditions do not change the rest.
PayloadFlight drawPayloadFlight(std::uint64_t seed, const Vehicle& vehicle,
                                const PayloadConditions& conditions);

}  // namespace aqc
