#include "adaptive_quadrotor_control/pilot/plan_gate.h"

#include <algorithm>
#include <stdexcept>
#include <string>

#include "adaptive_quadrotor_control/math/number_text.h"

namespace aqc {

void requireValid(const std::vector<TimedSetPoint>& set_points) {
  for (std::size_t i = 0; i < set_points.size(); ++i) {
    if (set_points[i].set_point.valid()) continue;
    throw std::invalid_argument("set point " + std::to_string(i) +
                                " holds a number that is not finite; all must be");
  }
}

void requireSafe(const std::vector<TimedSetPoint>& set_points, Nanoseconds now, Nanoseconds stamp,
                 Nanoseconds oldest, const GuardLimits& limits) {
  if (stamp > 0 && now - stamp > oldest) {
    throw std::invalid_argument("it is " + numberText(toSeconds(now - stamp)) + " s old; at most " +
                                numberText(toSeconds(oldest)) + " s is allowed");
  }
  if (!set_points.empty() && toSeconds(set_points.front().time - now) > limits.trajectory_lead) {
    throw std::invalid_argument(
        "it begins in " + numberText(toSeconds(set_points.front().time - now)) + " s; at most " +
        numberText(limits.trajectory_lead) + " s ahead is allowed");
  }
  for (const TimedSetPoint& timed : set_points) {
    const SetPoint& point = timed.set_point;
    const double most =
        std::max({point.position.cwiseAbs().maxCoeff(), point.velocity.cwiseAbs().maxCoeff(),
                  point.acceleration.cwiseAbs().maxCoeff()});
    if (most <= limits.set_point_bound) continue;
    throw std::invalid_argument("a set point says " + numberText(most) + "; at most " +
                                numberText(limits.set_point_bound) + " (m, m/s, m/s^2) is allowed");
  }
}

}  // namespace aqc
