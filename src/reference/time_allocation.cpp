#include "adaptive_quadrotor_control/reference/time_allocation.h"

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>

#include "adaptive_quadrotor_control/math/constants.h"
#include "reference/argument_checks.h"
#include "reference/invalid_argument.h"

namespace aqc {
namespace {

constexpr double kShortestDuration = 0.1;  // [s]
// What refining a peak may miss of it, so that the limits hold strictly.
constexpr double kStretchMargin = 1.0 + 1e-6;

void requireLimit(double value, double low, double high, const char* name, const char* allowed) {
  if (!std::isfinite(value) || value <= low || value >= high) {
    throwInvalidArgument("the ", name, " limit is ", value, "; it must be ", allowed);
  }
}

void requireLimits(const MotionLimits& limits) {
  constexpr double kUnbounded = HUGE_VAL;
  requireLimit(limits.speed, 0.0, kUnbounded, "speed", "finite and > 0 m/s");
  requireLimit(limits.acceleration, 0.0, kUnbounded, "acceleration", "finite and > 0 m/s^2");
  requireLimit(limits.tilt, 0.0, M_PI / 2.0, "tilt", "in (0, pi/2) rad");
  requireLimit(limits.thrust_to_weight, 1.0, kUnbounded, "thrust-to-weight", "finite and > 1");
}

enum Limit { kSpeed, kAcceleration, kTilt, kThrust, kLimitCount };

// For every limit the factor by which time must be stretched for it to hold in this state. A
// stretch f divides the velocity by f and the acceleration by f^2, so that each limit becomes a
// condition on f that can be solved.
Eigen::Array4d stretchOf(const Eigen::Vector3d& velocity, const Eigen::Vector3d& acceleration,
                         const MotionLimits& limits) {
  const double squared_norm = acceleration.squaredNorm();
  const double up = acceleration.z();
  const double horizontal = acceleration.head<2>().norm();
  const double thrust_range = limits.thrust_to_weight * limits.thrust_to_weight - 1.0;
  Eigen::Array4d stretch;
  stretch[kSpeed] = velocity.norm() / limits.speed;
  stretch[kAcceleration] = std::sqrt(std::sqrt(squared_norm) / limits.acceleration);
  // horizontal / f^2 <= tan(tilt) (up / f^2 + g)
  stretch[kTilt] = std::sqrt(std::max(horizontal / std::tan(limits.tilt) - up, 0.0) / kGravity);
  // |a|^2 / f^4 + 2 g up / f^2 <= g^2 (ratio^2 - 1), a quadratic inequality in f^2
  const double root = std::sqrt(up * up + squared_norm * thrust_range);
  stretch[kThrust] = std::sqrt(std::max(up + root, 0.0) / (kGravity * thrust_range));
  return stretch;
}

Eigen::Array4d stretchAt(const PolynomialTrajectory& trajectory, double time,
                         const MotionLimits& limits) {
  const FlatOutput output = trajectory.evaluate(time);
  return stretchOf(output.derivative[1].head<3>(), output.derivative[2].head<3>(), limits);
}

// Largest stretch for one limit between two times that enclose a single peak, by golden section.
double refinedPeak(const PolynomialTrajectory& trajectory, const MotionLimits& limits, int limit,
                   double low, double high) {
  constexpr int kSteps = 22;  // narrows the bracket to 3e-5 and so the peak to 1e-9 of its height
  constexpr double kGolden = 0.61803398874989485;
  const auto value = [&](double time) { return stretchAt(trajectory, time, limits)[limit]; };
  double left = high - kGolden * (high - low);
  double right = low + kGolden * (high - low);
  double left_value = value(left);
  double right_value = value(right);
  for (int step = 0; step < kSteps; ++step) {
    if (left_value > right_value) {
      high = right;
      right = left;
      right_value = left_value;
      left = high - kGolden * (high - low);
      left_value = value(left);
    } else {
      low = left;
      left = right;
      left_value = right_value;
      right = low + kGolden * (high - low);
      right_value = value(right);
    }
  }
  return std::max(left_value, right_value);
}

// Raises `required` to the largest stretch asked for in a segment. The squared speed is of degree
// twelve and so has few peaks: the samples stand close enough to tell them apart, and only those
// high enough to matter are refined, each limit for itself as only then it is smooth.
double segmentStretch(const PolynomialTrajectory& trajectory, const MotionLimits& limits,
                      double begin, double duration, double required) {
  constexpr int kIntervals = 64;
  constexpr double kMatters = 0.9;
  const auto time = [&](int i) { return begin + duration * i / kIntervals; };
  std::array<Eigen::Array4d, kIntervals + 1> samples;
  for (int i = 0; i <= kIntervals; ++i) {
    Eigen::Array4d& sample = samples[static_cast<std::size_t>(i)];
    sample = stretchAt(trajectory, time(i), limits);
    required = std::max(required, sample.maxCoeff());
  }
  for (int i = 0; i <= kIntervals; ++i) {
    const int before = std::max(i - 1, 0);
    const int after = std::min(i + 1, kIntervals);
    const Eigen::Array4d& sample = samples[static_cast<std::size_t>(i)];
    for (int limit = 0; limit < kLimitCount; ++limit) {
      const double height = sample[limit];
      if (height > kMatters * required &&
          height >= samples[static_cast<std::size_t>(before)][limit] &&
          height >= samples[static_cast<std::size_t>(after)][limit]) {
        required =
            std::max(required, refinedPeak(trajectory, limits, limit, time(before), time(after)));
      }
    }
  }
  return required;
}

std::vector<double> scaled(std::vector<double> durations, double factor) {
  for (double& duration : durations) duration *= factor;
  return durations;
}

bool hasMotionFixed(const std::vector<Waypoint>& waypoints) {
  const auto moves = [](const std::optional<Eigen::Vector4d>& derivative) {
    return derivative && !derivative->isZero(0.0);
  };
  return std::any_of(waypoints.begin(), waypoints.end(), [&](const Waypoint& waypoint) {
    return moves(waypoint.velocity) || moves(waypoint.acceleration) || moves(waypoint.jerk);
  });
}

void requireFixedWithin(const std::vector<Waypoint>& waypoints, const MotionLimits& limits) {
  constexpr std::array<const char*, kLimitCount> kNames{"speed", "acceleration", "tilt",
                                                        "thrust-to-weight"};
  for (std::size_t i = 0; i < waypoints.size(); ++i) {
    const Eigen::Vector4d velocity = waypoints[i].velocity.value_or(Eigen::Vector4d::Zero());
    const Eigen::Vector4d acceleration =
        waypoints[i].acceleration.value_or(Eigen::Vector4d::Zero());
    const Eigen::Array4d stretch = stretchOf(velocity.head<3>(), acceleration.head<3>(), limits);
    int limit = 0;
    if (stretch.maxCoeff(&limit) > 1.0) {
      throwInvalidArgument("waypoint ", i, " has the fixed velocity (", velocity.transpose(),
                           ") and acceleration (", acceleration.transpose(), "), beyond the ",
                           kNames[static_cast<std::size_t>(limit)],
                           " limit; fixed derivatives must be within all limits");
    }
  }
}

// Below this factor the mean speed in some segment would be beyond the limit, or the longest
// segment shorter than any may be.
double smallestFactor(const std::vector<Waypoint>& waypoints, const MotionLimits& limits,
                      const std::vector<double>& durations) {
  double factor = kShortestDuration / *std::max_element(durations.begin(), durations.end());
  for (std::size_t i = 0; i < durations.size(); ++i) {
    const double distance = (waypoints[i + 1].position - waypoints[i].position).norm();
    factor = std::max(factor, distance / (limits.speed * durations[i]));
  }
  return factor;
}

// The trajectory with the smallest factor on the durations with which the limits hold. Solves
// anew for every factor, as scaling in time would change the fixed derivatives.
PolynomialTrajectory solveWithin(const std::vector<Waypoint>& waypoints, const MotionLimits& limits,
                                 EndDerivatives ends, const std::vector<double>& durations) {
  constexpr double kLargestFactor = 1000.0;
  constexpr double kGrowth = 1.1;
  constexpr double kTolerance = 1.001;
  const auto solve = [&](double factor) {
    return minimumSnap(waypoints, scaled(durations, factor), ends);
  };
  const auto holds = [&](const PolynomialTrajectory& trajectory) {
    return requiredStretch(trajectory, limits) * kStretchMargin <= 1.0;
  };
  double factor = smallestFactor(waypoints, limits, durations);
  PolynomialTrajectory best = solve(factor);
  if (holds(best)) return best;
  double too_small = factor;
  do {
    too_small = factor;
    factor *= kGrowth;
    if (factor > kLargestFactor) {
      throwInvalidArgument("no durations up to ", kLargestFactor, " times the estimated ones keep ",
                           "the limits with these fixed derivatives; lower them or free some");
    }
    best = solve(factor);
  } while (!holds(best));
  while (factor > kTolerance * too_small) {
    const double middle = std::sqrt(factor * too_small);
    PolynomialTrajectory trajectory = solve(middle);
    if (holds(trajectory)) {
      factor = middle;
      best = std::move(trajectory);
    } else {
      too_small = middle;
    }
  }
  return best;
}

}  // namespace

std::vector<double> estimateDurations(const std::vector<Waypoint>& waypoints,
                                      const MotionLimits& limits) {
  requireWaypoints(waypoints);
  requireLimits(limits);
  // Peaks of the minimum-snap profile 35 s^4 - 84 s^5 + 70 s^6 - 20 s^7 of unit length and time.
  constexpr double kPeakSpeed = 35.0 / 16.0;
  const double peak_acceleration = 84.0 / (5.0 * std::sqrt(5.0));
  // An acceleration up to this keeps tilt and thrust within their limits in any direction.
  const double acceleration = std::min({limits.acceleration, kGravity * std::sin(limits.tilt),
                                        kGravity * (limits.thrust_to_weight - 1.0)});
  std::vector<double> durations;
  durations.reserve(waypoints.size() - 1);
  for (std::size_t i = 1; i < waypoints.size(); ++i) {
    const double distance = (waypoints[i].position - waypoints[i - 1].position).norm();
    durations.push_back(std::max({kShortestDuration, kPeakSpeed * distance / limits.speed,
                                  std::sqrt(peak_acceleration * distance / acceleration)}));
  }
  return durations;
}

double requiredStretch(const PolynomialTrajectory& trajectory, const MotionLimits& limits) {
  requireLimits(limits);
  double required = 0.0;
  double begin = 0.0;
  for (const double duration : trajectory.segmentDurations()) {
    required = segmentStretch(trajectory, limits, begin, duration, required);
    begin += duration;
  }
  return required;
}

PolynomialTrajectory minimumSnapWithin(const std::vector<Waypoint>& waypoints,
                                       const MotionLimits& limits, EndDerivatives ends) {
  const std::vector<double> durations = estimateDurations(waypoints, limits);
  if (durations.empty()) return minimumSnap(waypoints, durations, ends);
  if (hasMotionFixed(waypoints)) {
    requireFixedWithin(waypoints, limits);
    return solveWithin(waypoints, limits, ends, durations);
  }
  const PolynomialTrajectory trajectory = minimumSnap(waypoints, durations, ends);
  const double shortest = kShortestDuration / *std::max_element(durations.begin(), durations.end());
  return trajectory.stretched(
      std::max(shortest, requiredStretch(trajectory, limits) * kStretchMargin));
}

}  // namespace aqc
