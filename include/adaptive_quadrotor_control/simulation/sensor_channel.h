#pragma once

#include <Eigen/Core>
#include <deque>
#include <optional>
#include <vector>

#include "adaptive_quadrotor_control/model/state.h"
#include "adaptive_quadrotor_control/simulation/random.h"
#include "adaptive_quadrotor_control/simulation/sensor_faults.h"

namespace aqc {

/// Odometry on its way to a pilot.
struct OdometryMessage {
  State state;
  Nanoseconds stamp = 0;    ///< what it says of its time
  Nanoseconds arrival = 0;  ///< when a pilot hears it
};

/// A sample of accelerometer and gyroscope at the origin of B, in B.
struct ImuMessage {
  Eigen::Vector3d specific_force = Eigen::Vector3d::Zero();  ///< [m/s^2]
  Eigen::Vector3d body_rate = Eigen::Vector3d::Zero();       ///< [rad/s]
  Nanoseconds stamp = 0;
  Nanoseconds arrival = 0;
};

/// Messages by their arrival; those of one arrival in the order in which they were sent.
template <class Message>
class MessageQueue {
 public:
  void send(const Message& message) {
    auto place = waiting_.end();
    while (place != waiting_.begin() && (place - 1)->arrival > message.arrival) --place;
    waiting_.insert(place, message);
  }
  /// The next one that has arrived at `now`, once.
  std::optional<Message> receive(Nanoseconds now) {
    if (waiting_.empty() || waiting_.front().arrival > now) return std::nullopt;
    const Message message = waiting_.front();
    waiting_.pop_front();
    return message;
  }

 private:
  std::deque<Message> waiting_;
};

/// Makes of the true motion the odometry that a pilot hears. No clock is in it: whoever simulates
/// says what time it is. The first measurement is due at `start`, from which windows count.
class OdometryChannel {
 public:
  OdometryChannel(const OdometryFaults& faults, std::uint64_t seed, Nanoseconds start);

  /// The true state at `now`, which does not go back. Measures when that is due.
  void observe(const State& truth, Nanoseconds now);
  /// The next message that has arrived at `now`, once.
  std::optional<OdometryMessage> receive(Nanoseconds now) { return queue_.receive(now); }

 private:
  // The estimator's world against the true one.
  struct Frame {
    double yaw = 0.0;
    Eigen::Vector3d shift = Eigen::Vector3d::Zero();
  };

  void moveFrame(double yaw, const Eigen::Vector3d& shift, const Eigen::Vector3d& pivot);
  void drift(const Eigen::Vector3d& pivot);
  void jump(Nanoseconds age, const Eigen::Vector3d& pivot);
  State measured(const State& truth, Nanoseconds age);
  void addNoise(State& state);
  void addWander(State& state);
  void send(const State& state, Nanoseconds now);

  OdometryFaults faults_;
  Nanoseconds start_;
  Nanoseconds due_;
  Random noise_;
  Random link_;
  Random slow_;
  bool wanders_;
  Eigen::Vector3d wander_ = Eigen::Vector3d::Zero();  // of the position [m]
  Eigen::Vector3d lean_ = Eigen::Vector3d::Zero();    // of the attitude [rad]
  Frame frame_;
  std::vector<std::optional<Frame>> jumped_;  // by how much each jump that is on has moved it
  std::optional<State> frozen_;
  Nanoseconds last_arrival_;
  MessageQueue<OdometryMessage> queue_;
};

/// The same for accelerometer and gyroscope.
class ImuChannel {
 public:
  ImuChannel(const ImuFaults& faults, std::uint64_t seed, Nanoseconds start);

  void observe(const Eigen::Vector3d& specific_force, const Eigen::Vector3d& body_rate,
               Nanoseconds now);
  std::optional<ImuMessage> receive(Nanoseconds now) { return queue_.receive(now); }

 private:
  ImuFaults faults_;
  Nanoseconds start_;
  Nanoseconds due_;
  Random noise_;
  MessageQueue<ImuMessage> queue_;
};

}  // namespace aqc
