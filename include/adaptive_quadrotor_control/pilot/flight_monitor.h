#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "adaptive_quadrotor_control/law/control_law.h"
#include "adaptive_quadrotor_control/math/time.h"
#include "adaptive_quadrotor_control/pilot/load_watch.h"

namespace aqc {

enum class Health { kOk, kWarn, kError };

/// One line of a pilot's health report.
struct Finding {
  std::string name;
  Health health = Health::kOk;
  std::string reason;                                       ///< a sentence, also when all is well
  std::vector<std::pair<std::string, std::string>> values;  ///< with their units
};

/// From where on a number is worth a warning, and from where on an error.
struct Threshold {
  double warn;
  double error;
};

struct MonitorLimits {
  Threshold rate_deviation{0.1, 0.3};    ///< share of the nominal rate
  Threshold jitter{1.5, 5.0};            ///< of the longest step, in periods beyond the nominal one
  Threshold odometry_age{0.05, 0.2};     ///< [s]
  Threshold silence{0.5, 1.0};           ///< without odometry by the wall clock [s]
  Threshold distance{1.0, 3.0};          ///< from the set point [m]
  Threshold saturation{0.05, 0.5};       ///< share of the steps
  Threshold dropped_odometry{0.0, 0.5};  ///< share of the messages
  Threshold lift{0.8, 0.95};             ///< mass carried / mass that the rotors can lift
};

/// Judges a flight by what the control loop sees, from one judgement to the next. Counting
/// allocates nothing and reads no clock.
class FlightMonitor {
 public:
  /// `period` is the nominal one of the control loop.
  explicit FlightMonitor(Nanoseconds period, const MonitorLimits& limits = {});

  /// Odometry stamped `stamp` was accepted at `now`.
  void countOdometry(Nanoseconds stamp, Nanoseconds now) noexcept;
  void countDroppedOdometry() noexcept { ++dropped_odometry_; }
  /// Set points were accepted at `now`.
  void countSetPoint(Nanoseconds now) noexcept { set_point_time_ = now; }
  void countDroppedSetPoint() noexcept { ++dropped_set_points_; }
  /// The clock of the odometry was started anew, and the controller with it.
  void countNewStart() noexcept {
    ++new_starts_;
    heavy_since_ = -1;
  }
  /// A control step at `now`. Only steps that fly tell about rotors and mass.
  void countStep(Nanoseconds now, bool flying, const Telemetry& telemetry, bool saturated,
                 const Load& load) noexcept;
  /// For 0.42 s without a break the load has been above MonitorLimits::lift: a payload that swings,
  /// whose pull comes and goes, is none that cannot be lifted.
  bool overloaded() const noexcept { return overloaded_; }

  /// What to say at `now` about the time since the last call; then counting begins anew.
  /// `silence` is how long no odometry has come by the wall clock [s]: a simulated clock stands
  /// still together with its simulator. In the order of names().
  std::vector<Finding> judge(Nanoseconds now, double silence);
  static std::vector<std::string> names();

 private:
  Finding judgeLoop() const;
  Finding judgeOdometry(Nanoseconds now, double silence) const;
  Finding judgeSetPoint(Nanoseconds now) const;
  Finding judgeRotors() const;
  Finding judgeMessages() const;
  Finding judgePayload() const;

  Nanoseconds period_;
  MonitorLimits limits_;

  // Latest; -1 for none yet.
  Nanoseconds step_time_ = -1;
  Nanoseconds odometry_stamp_ = -1;
  Nanoseconds set_point_time_ = -1;
  bool flying_ = false;
  double distance_ = 0.0;  // from the set point [m]
  Load load_;
  Nanoseconds heavy_since_ = -1;  // -1: it is not
  bool overloaded_ = false;

  // Since the last judgement.
  std::uint32_t intervals_ = 0;
  Nanoseconds interval_sum_ = 0;
  Nanoseconds longest_interval_ = 0;
  Nanoseconds oldest_odometry_ = 0;
  std::uint32_t odometry_ = 0;
  std::uint32_t dropped_odometry_ = 0;
  std::uint32_t dropped_set_points_ = 0;
  std::uint32_t new_starts_ = 0;
  std::uint32_t flying_steps_ = 0;
  std::uint32_t saturated_steps_ = 0;
  Load overload_;  // of the last step that was overloaded()
  bool was_overloaded_ = false;
};

}  // namespace aqc
