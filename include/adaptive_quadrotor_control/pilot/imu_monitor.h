#pragma once

#include <Eigen/Core>
#include <optional>

#include "adaptive_quadrotor_control/math/time.h"

namespace aqc {

/// The latest sample of an IMU, and whether it may still be used. Times are those of the
/// samples themselves and of the odometry they go with; there is no clock in it.
class ImuMonitor {
 public:
  static constexpr Nanoseconds kOldest = 100'000'000;  // [ns]
  static constexpr int kConfirmations = 3;             // samples that tell of a clock's step

  /// A sample is usable until it is `oldest` behind the odometry; one that goes back by more than
  /// `new_start` is of a clock that was started anew [ns].
  explicit ImuMonitor(Nanoseconds oldest = kOldest, Nanoseconds new_start = kNewStart)
      : oldest_(oldest), new_start_(new_start) {}

  /// As it was at the start; counts stay.
  void forget() noexcept { started_ = usable_ = false; }

  /// A sample in B [m/s^2], and of an IMU with a gyroscope the body rate [rad/s] with it. False,
  /// and it is dropped and counted, when the force is not finite or it is older than the one
  /// before, unless so much that the clock was started anew. Of older ones in a row, none behind
  /// the one before, the last of kConfirmations is taken: their clock was set back by less, and
  /// they are no stragglers and no second source. A rate that is not finite counts as none.
  bool take(const Eigen::Vector3d& specific_force, Nanoseconds time,
            const std::optional<Eigen::Vector3d>& body_rate = std::nullopt) noexcept;

  /// What goes with odometry of the time `now`: null when the latest sample is older than usable,
  /// when it is of the time before a new start, or when none has ever come. A loss is counted once,
  /// when usable() turns false.
  const Eigen::Vector3d* at(Nanoseconds now) noexcept;

  /// Whether a sample not older than `now` has come.
  bool covers(Nanoseconds now) const noexcept {
    return started_ && time_ >= now && !startedAnew(time_, now, new_start_);
  }
  /// Whether odometry of the time `now` should wait for its sample: one is coming, as far as
  /// anybody knows, and is not here yet.
  bool awaits(Nanoseconds now) const noexcept { return usable_ && !covers(now); }
  /// Whether the last at() gave a sample.
  bool usable() const noexcept { return usable_; }
  Nanoseconds time() const noexcept { return time_; }  ///< of the latest sample
  /// Of the latest sample, while it is usable(); null without a gyroscope.
  const Eigen::Vector3d* bodyRate() const noexcept {
    return usable_ && body_rate_ ? &*body_rate_ : nullptr;
  }
  long dropped() const noexcept { return dropped_; }
  long losses() const noexcept { return losses_; }

 private:
  bool wasSetBack(Nanoseconds time) noexcept;

  Nanoseconds oldest_;
  Nanoseconds new_start_;
  Eigen::Vector3d specific_force_ = Eigen::Vector3d::Zero();
  std::optional<Eigen::Vector3d> body_rate_;
  Nanoseconds time_ = 0;
  bool started_ = false;
  bool usable_ = false;
  Nanoseconds late_time_ = 0;  // of the last sample that was older than the one before
  int late_ = 0;               // how many such came in a row
  long dropped_ = 0;
  long losses_ = 0;
};

}  // namespace aqc
