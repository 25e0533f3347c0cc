#pragma once

#include <algorithm>

#include "adaptive_quadrotor_control/simulation/sensor_channel.h"
#include "adaptive_quadrotor_control/simulation/timed_plant.h"

namespace aqc {

/// The way from a plant in a world with `sensors` to who hears them: of the offline flight and of
/// the plant node.
class SensorChannels {
 public:
  SensorChannels(const SensorFaults& faults, Nanoseconds start)
      : odometry_(faults.odometry, faults.seed, start), imu_(faults.imu, faults.seed, start) {}

  /// Measures what is due at the plant's time and hands over what has arrived until then:
  /// `hear_imu(ImuMessage)`, then `hear_odometry(OdometryMessage)`.
  template <class HearImu, class HearOdometry>
  void listen(const TimedPlant& plant, const HearImu& hear_imu, const HearOdometry& hear_odometry) {
    const Nanoseconds now = plant.now();
    const State state = plant.plant().state();
    imu_.observe(plant.plant().specificForce(), state.body_rate, now);
    odometry_.observe(state, now);
    while (const std::optional<ImuMessage> message = imu_.receive(now)) hear_imu(*message);
    while (const std::optional<OdometryMessage> message = odometry_.receive(now)) {
      hear_odometry(*message);
    }
  }

  /// Advances the plant by its steps to `until` and calls `listen()` after each of them but the
  /// last.
  template <class Listen>
  static void advance(TimedPlant& plant, Nanoseconds step, Nanoseconds until,
                      const Listen& listen) {
    while (plant.now() < until) {
      plant.advance(std::min(plant.now() + step, until));
      if (plant.now() < until) listen();
    }
  }

 private:
  OdometryChannel odometry_;
  ImuChannel imu_;
};

}  // namespace aqc
