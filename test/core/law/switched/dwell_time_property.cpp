#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <vector>

#include "adaptive_quadrotor_control/law/switched/dwell_time.h"

namespace aqc {
namespace {

constexpr int kNominalSize = 100;  // rapidcheck's: the whole range from the first stream on

/// N_0 as a fraction with a denominator that doubles hold exactly, so that the definition can be
/// checked in whole numbers.
struct Bound {
  Nanoseconds dwell_time;
  Nanoseconds chatter_quarters;  // 4 N_0

  double chatter() const { return static_cast<double>(chatter_quarters) / 4.0; }

  // N <= N_0 + window / dwell_time
  bool holds(Nanoseconds switches, Nanoseconds window) const {
    return 4 * switches * dwell_time <= chatter_quarters * dwell_time + 4 * window;
  }
};

/// The definition itself: every window that begins at a switch and ends just behind one, with the
/// longest count for its length, so that all others follow.
bool everyWindowHolds(const std::vector<Nanoseconds>& switches, const Bound& bound) {
  for (std::size_t first = 0; first < switches.size(); ++first) {
    for (std::size_t last = first; last < switches.size(); ++last) {
      const auto count = static_cast<Nanoseconds>(last - first + 1);
      if (!bound.holds(count, switches[last] - switches[first])) return false;
    }
  }
  return true;
}

bool legalNext(std::vector<Nanoseconds> switches, Nanoseconds next, const Bound& bound) {
  switches.push_back(next);
  return everyWindowHolds(switches, bound);
}

Bound anyBound() {
  return {*rc::gen::resize(kNominalSize, rc::gen::inRange<Nanoseconds>(1, 60)),
          *rc::gen::resize(kNominalSize, rc::gen::inRange<Nanoseconds>(4, 24))};
}

std::vector<Nanoseconds> anyTimes() {
  const auto step_sizes = rc::gen::resize(kNominalSize, rc::gen::inRange<Nanoseconds>(0, 90));
  auto steps = *rc::gen::container<std::vector<Nanoseconds>>(step_sizes);
  Nanoseconds now = *rc::gen::inRange<Nanoseconds>(0, 1'700'000'000'000'000'000);
  for (Nanoseconds& step : steps) step = now += step;
  return steps;
}

// Neither more nor fewer switches than the definition allows pass, and the earliest time is right.
RC_GTEST_PROP(DwellTimeMonitor, IsTheDefinition, ()) {
  const Bound bound = anyBound();
  DwellTimeMonitor monitor(bound.dwell_time, bound.chatter());
  std::vector<Nanoseconds> accepted;
  for (const Nanoseconds now : anyTimes()) {
    RC_ASSERT(monitor.allows(now) == legalNext(accepted, now, bound));
    const Nanoseconds earliest = monitor.earliest(now);
    RC_ASSERT(earliest >= now);
    RC_ASSERT(legalNext(accepted, earliest, bound));
    RC_ASSERT(earliest == now || !legalNext(accepted, earliest - 1, bound));
    if (!monitor.allows(now)) continue;
    monitor.record(now);
    accepted.push_back(now);
  }
  RC_ASSERT(everyWindowHolds(accepted, bound));
  RC_CLASSIFY(accepted.size() > 5);
}

// Switches done against the dwell time (policy warn) count like any other.
RC_GTEST_PROP(DwellTimeMonitor, CountsSwitchesThatBrokeIt, ()) {
  const Bound bound = anyBound();
  DwellTimeMonitor monitor(bound.dwell_time, bound.chatter());
  std::vector<Nanoseconds> done;
  for (const Nanoseconds now : anyTimes()) {
    monitor.record(now);
    done.push_back(now);
    // The windows that end with the next switch; older ones may be broken for good.
    const auto legal = [&](Nanoseconds next) {
      for (std::size_t first = 0; first < done.size(); ++first) {
        const auto count = static_cast<Nanoseconds>(done.size() - first + 1);
        if (!bound.holds(count, next - done[first])) return false;
      }
      return true;
    };
    const Nanoseconds earliest = monitor.earliest(now);
    RC_ASSERT(legal(earliest));
    RC_ASSERT(earliest == now || !legal(earliest - 1));
  }
}

// Any N_0, not only one that is a short fraction: compared in exact arithmetic of extended width.
RC_GTEST_PROP(DwellTimeMonitor, NeverRoundsInFavourOfASwitch, ()) {
  const auto dwell_time = *rc::gen::inRange<Nanoseconds>(1, 1'000'000'000'000);
  const double chatter = 1.0 + static_cast<double>(*rc::gen::inRange(0, 1 << 30)) / (1 << 23) / 3.0;
  DwellTimeMonitor monitor(dwell_time, chatter);
  int burst = 0;
  while (monitor.allows(0)) {
    monitor.record(0);
    ++burst;
  }
  RC_ASSERT(burst == static_cast<int>(chatter));
  // The next switch needs (burst + 1 - N_0) dwell times: the smallest whole number that reaches it.
  const long double wait =
      (static_cast<long double>(burst) + 1.0L - chatter) * static_cast<long double>(dwell_time);
  const Nanoseconds earliest = monitor.earliest(0);
  RC_ASSERT(static_cast<long double>(earliest) >= wait - 1e-4L);
  RC_ASSERT(static_cast<long double>(earliest) < wait + 1.0L + 1e-4L);
}

}  // namespace
}  // namespace aqc
