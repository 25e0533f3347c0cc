#pragma once

#include <optional>

#include "adaptive_quadrotor_control/model/state.h"
#include "adaptive_quadrotor_control/pilot/guard_limits.h"
#include "adaptive_quadrotor_control/pilot/innovation.h"

namespace aqc {

/// Why odometry is not believed.
enum class Doubt {
  kNone,
  kNotFinite,
  kStampAhead,
  kNoUnitQuaternion,
  kAbsurd,
  kPositionJump,
  kVelocityJump,
  kTurnJump,
  kFrozen,
  kFirst,
};

/// The reason in a few words; null for kNone.
const char* textOf(Doubt doubt) noexcept;

/// Judges odometry, and samples of an IMU, before anybody uses them. It has no clock and nothing in
/// it allocates or throws.
class OdometryGate {
 public:
  explicit OdometryGate(const GateLimits& limits) : limits_(limits) {}

  /// What a message says by itself, whatever came before. Normalises a quaternion that is nearly
  /// of norm 1.
  Doubt look(State& state, Nanoseconds stamp, Nanoseconds now) const noexcept;

  /// Whether an IMU's sample [m/s^2], [rad/s] in B is one that a vehicle can feel: one absurd
  /// number in dead reckoning would make all later odometry look like a jump.
  bool believes(const Eigen::Vector3d& specific_force,
                const Eigen::Vector3d& body_rate) const noexcept;

  /// Whether it agrees with the motion as it must be after `silence` seconds without odometry, from
  /// which it is `innovation` away (an innovation gate). Messages that jump, agree with each other
  /// and come in a row are of a source that was reset: the last of so many (see
  /// GateLimits::confirmations) is believed, unless it is the attitude that jumped, which no reset
  /// of a map explains.
  Doubt compare(const State& state, const Innovation& innovation, double silence) noexcept;

  /// Whether it says exactly what the `last` message said that was believed. In the air nothing is
  /// so still: the source has frozen, whatever its stamps say.
  static bool frozen(const State& state, const State& last) noexcept;

  /// Whether it is the first message after a silence, or says exactly what that one said. One alone
  /// may be the first of a source that has frozen while nobody heard it.
  bool first(const State& state) noexcept;
  /// How much higher it says the vehicle is than it can be, after `silence` seconds in which an IMU
  /// told the motion: so much its source's ground has moved [m]. 0 where dead reckoning may err so.
  double unfeltRise(const Innovation& innovation, double silence) const noexcept;

  /// Whether the last compare() took a message as a source's reset.
  bool sourceReset() const noexcept { return reset_; }
  /// A message was believed: the silence is over.
  void believed() noexcept { first_.reset(); }
  /// The next message is the first one.
  void forget() noexcept { agreeing_ = 0; }

 private:
  Doubt jumped(const Innovation& innovation, double silence) const noexcept;

  GateLimits limits_;
  State candidate_;   // the last that jumped
  int agreeing_ = 0;  // how many such agreed with each other in a row
  bool reset_ = false;
  std::optional<State> first_;  // that was heard after a silence, and is not believed yet
};

}  // namespace aqc
