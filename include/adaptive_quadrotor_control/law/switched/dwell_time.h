#pragma once

#include <string>
#include <vector>

#include "adaptive_quadrotor_control/math/time.h"

namespace aqc {

/// What a subsystem's Lyapunov equation says about switching (thesis, above eq. sw_law).
struct LyapunovSpectrum {
  double p_min;  ///< lambda_min(P)
  double p_max;  ///< lambda_max(P)
  double q_min;  ///< lambda_min(Q)

  double decay() const noexcept { return q_min / p_max; }  ///< varrho_sigma [1/s]
};

/// The average dwell time that the thesis asks for (eq. sw_law).
struct DwellTime {
  double mu;      ///< max lambda_max(P) / min lambda_min(P) over the subsystems, >= 1
  double varrho;  ///< min lambda_min(Q) / lambda_max(P) over the subsystems [1/s]
  double kappa;   ///< 0 < kappa < varrho [1/s]
  double least;   ///< theta* = ln(mu) / kappa [s]: the average dwell time must be longer

  /// On one line, with symbols and units.
  std::string text() const;
};

/// `kappa_ratio` is kappa / varrho, in (0, 1); the thesis flies 0.9. Throws std::invalid_argument
/// for another ratio, for no subsystem and for a spectrum that is not positive.
DwellTime averageDwellTime(const std::vector<LyapunovSpectrum>& subsystems, double kappa_ratio);

/// Watches the thesis's definition 1: over every window [t1, t2) the number of switches is at most
/// N_0 + (t2 - t1) / dwell_time.
///
/// A leaky bucket: every switch fills one dwell time in, time drains it, and N_0 dwell times fit.
/// That is the definition itself, not an estimate of it, in constant time and memory: of all
/// windows that end with the newest switch, the fullest one is what is in the bucket. Whole
/// nanoseconds, so nothing is lost to rounding. No function but the constructor throws or
/// allocates.
class DwellTimeMonitor {
 public:
  static constexpr Nanoseconds kLongest = 1'000'000'000'000'000;  ///< eleven days
  static constexpr double kMostChatter = 1000.0;

  /// `dwell_time` in [1, kLongest] ns. `chatter_bound` is N_0 in [1, kMostChatter]: one switch
  /// alone fills a window as short as one likes, so with N_0 < 1 no switch would ever be allowed.
  /// Throws std::invalid_argument.
  DwellTimeMonitor(Nanoseconds dwell_time, double chatter_bound);

  /// The first time >= `now` at which a switch keeps the definition.
  Nanoseconds earliest(Nanoseconds now) const noexcept;
  bool allows(Nanoseconds now) const noexcept { return earliest(now) <= now; }
  /// A switch happened at `now`, allowed or not. Time must not run backwards: a `now` before the
  /// last switch counts as the time of that switch.
  void record(Nanoseconds now) noexcept;
  /// Forgets every switch.
  void reset() noexcept;
  /// Remembers the switches that `old` remembers; they count as many as they did, whatever its
  /// dwell time was.
  void adopt(const DwellTimeMonitor& old) noexcept;

  Nanoseconds dwellTime() const noexcept { return dwell_time_; }
  double chatterBound() const noexcept { return chatter_bound_; }

 private:
  Nanoseconds dwell_time_;
  double chatter_bound_;
  Nanoseconds capacity_;  // N_0 dwell times, rounded down: contents are whole nanoseconds
  Nanoseconds fill_ = 0;  // right after the last switch
  Nanoseconds last_ = 0;  // of that switch
};

}  // namespace aqc
