#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <vector>

#include "adaptive_quadrotor_control/reference/minimum_snap.h"
#include "adaptive_quadrotor_control/reference/time_allocation.h"
#include "support/trajectories.h"

namespace aqc {
namespace {

/// A number in [low, high] that shrinks towards low.
double anyReal(double low, double high) {
  constexpr int kSteps = 1000000;
  return low + (high - low) * *rc::gen::inRange(0, kSteps + 1) / kSteps;
}

Eigen::Vector4d anyVector(double size) {
  return {anyReal(-size, size), anyReal(-size, size), anyReal(-size, size), anyReal(-size, size)};
}

struct Problem {
  std::vector<Waypoint> waypoints;
  std::vector<double> durations;

  PolynomialTrajectory solve() const { return minimumSnap(waypoints, durations); }
};

/// Two to nine waypoints, some coincident, with or without derivatives fixed at random.
Problem anyProblem(bool fix_derivatives) {
  Problem problem;
  const int count = *rc::gen::inRange(2, 10);
  for (int i = 0; i < count; ++i) {
    Waypoint waypoint;
    const bool is_coincident = i > 0 && *rc::gen::inRange(0, 8) == 7;
    waypoint.position = is_coincident
                            ? problem.waypoints.back().position
                            : Eigen::Vector3d(anyReal(-20, 20), anyReal(-20, 20), anyReal(0, 20));
    waypoint.yaw = anyReal(-7.0, 7.0);
    for (auto* derivative : {&waypoint.velocity, &waypoint.acceleration, &waypoint.jerk}) {
      if (fix_derivatives && *rc::gen::arbitrary<bool>()) {
        *derivative = anyVector(3.0);
      }
    }
    problem.waypoints.push_back(waypoint);
    if (i > 0) {
      // Evenly spread on a logarithmic scale.
      problem.durations.push_back(std::pow(10.0, anyReal(-1.0, 1.0)));
    }
  }
  return problem;
}

std::vector<double> knotTimes(const PolynomialTrajectory& trajectory) {
  std::vector<double> times{0.0};
  for (const double duration : trajectory.segmentDurations()) {
    times.push_back(times.back() + duration);
  }
  return times;
}

KnotState stateAt(const PolynomialTrajectory& trajectory, double time) {
  const FlatOutput output = trajectory.evaluate(time);
  KnotState state;
  for (int order = 0; order < 4; ++order) {
    state.col(order) = output.derivative[static_cast<std::size_t>(order)];
  }
  return state;
}

std::vector<KnotState> knotsOf(const PolynomialTrajectory& trajectory) {
  std::vector<KnotState> knots;
  for (const double time : knotTimes(trajectory)) {
    knots.push_back(stateAt(trajectory, time));
  }
  return knots;
}

/// Largest difference of all derivatives at the same fractions of both durations, relative to the
/// largest value of each order. `map` takes an output vector of the first to one of the second.
template <typename Map>
double difference(const PolynomialTrajectory& first, const PolynomialTrajectory& second,
                  const Map& map) {
  constexpr int kSamples = 97;
  double worst = 0.0;
  for (std::size_t order = 0; order < 4; ++order) {
    double error = 0.0;
    double size = 1e-9;
    for (int i = 0; i <= kSamples; ++i) {
      const double u = static_cast<double>(i) / kSamples;
      const Eigen::Vector4d expected =
          map(first.evaluate(u * first.duration()).derivative[order], order);
      const Eigen::Vector4d actual = second.evaluate(u * second.duration()).derivative[order];
      error = std::max(error, (actual - expected).norm());
      size = std::max(size, expected.norm());
    }
    worst = std::max(worst, error / size);
  }
  return worst;
}

RC_GTEST_PROP(MinimumSnapProperty, PassesAllWaypoints, ()) {
  const Problem problem = anyProblem(true);
  const PolynomialTrajectory trajectory = problem.solve();
  const std::vector<KnotState> knots = knotsOf(trajectory);
  for (std::size_t i = 0; i < knots.size(); ++i) {
    const Waypoint& waypoint = problem.waypoints[i];
    RC_ASSERT((knots[i].col(0).head<3>() - waypoint.position).norm() <= 1e-9);
    RC_ASSERT(std::abs(std::remainder(knots[i](3, 0) - waypoint.yaw, 2.0 * M_PI)) <= 1e-9);
    if (i > 0) {
      RC_ASSERT(std::abs(knots[i](3, 0) - knots[i - 1](3, 0)) <= M_PI + 1e-9);
    }
  }
}

RC_GTEST_PROP(MinimumSnapProperty, MeetsFixedDerivatives, ()) {
  const Problem problem = anyProblem(true);
  const std::vector<KnotState> knots = knotsOf(problem.solve());
  for (std::size_t i = 0; i < knots.size(); ++i) {
    const Waypoint& waypoint = problem.waypoints[i];
    const bool is_end = i == 0 || i + 1 == knots.size();
    int order = 0;
    for (const auto* fixed : {&waypoint.velocity, &waypoint.acceleration, &waypoint.jerk}) {
      ++order;
      if (*fixed || is_end) {
        const Eigen::Vector4d expected = fixed->value_or(Eigen::Vector4d::Zero());
        RC_ASSERT((knots[i].col(order) - expected).cwiseAbs().maxCoeff() <= 1e-9);
      }
    }
  }
}

RC_GTEST_PROP(MinimumSnapProperty, IsContinuousToTheJerk, ()) {
  const PolynomialTrajectory trajectory = anyProblem(true).solve();
  for (const double time : knotTimes(trajectory)) {
    const double before = std::nextafter(time, -1.0);
    if (before < 0.0) continue;
    const FlatOutput left = trajectory.evaluate(before);
    const FlatOutput right = trajectory.evaluate(time);
    for (std::size_t order = 0; order < 4; ++order) {
      const double allowed = 1e-12 * (1.0 + right.derivative[order].norm()) +
                             2.0 * (time - before) * left.derivative[order + 1].norm();
      RC_ASSERT((left.derivative[order] - right.derivative[order]).norm() <= allowed);
    }
  }
}

RC_GTEST_PROP(MinimumSnapProperty, NoFeasiblePerturbationCostsLess, ()) {
  const Problem problem = anyProblem(true);
  const PolynomialTrajectory optimum = problem.solve();
  std::vector<KnotState> knots = knotsOf(optimum);
  const double size = std::pow(10.0, anyReal(-4.0, 1.0));
  bool is_free = false;
  for (std::size_t i = 1; i + 1 < knots.size(); ++i) {
    const Waypoint& waypoint = problem.waypoints[i];
    int order = 0;
    for (const auto* fixed : {&waypoint.velocity, &waypoint.acceleration, &waypoint.jerk}) {
      ++order;
      if (!*fixed) {
        is_free = true;
        knots[i].col(order) += anyVector(size);
      }
    }
  }
  RC_PRE(is_free);
  const PolynomialTrajectory perturbed(knots, problem.durations);
  RC_ASSERT(perturbed.snapCost() >= optimum.snapCost() * (1.0 - 1e-10));
}

RC_GTEST_PROP(MinimumSnapProperty, CostGrowsWithTheSquareOfThePerturbation, ()) {
  // At a minimum the cost has no linear part: opposite perturbations raise it alike.
  const Problem problem = anyProblem(false);
  RC_PRE(problem.waypoints.size() >= 3U);
  const PolynomialTrajectory optimum = problem.solve();
  std::vector<KnotState> plus = knotsOf(optimum);
  std::vector<KnotState> minus = plus;
  const auto inner = *rc::gen::inRange<std::size_t>(1, plus.size() - 1);
  const int order = *rc::gen::inRange(1, 4);
  const Eigen::Vector4d step = anyVector(1.0) + Eigen::Vector4d::Constant(1.5);
  plus[inner].col(order) += step;
  minus[inner].col(order) -= step;
  const double up = PolynomialTrajectory(plus, problem.durations).snapCost();
  const double down = PolynomialTrajectory(minus, problem.durations).snapCost();
  RC_ASSERT(std::abs(up - down) <= 1e-9 * (up + down));
  RC_ASSERT(up > optimum.snapCost());
}

RC_GTEST_PROP(MinimumSnapProperty, MovesAlongWithATranslation, ()) {
  const Problem problem = anyProblem(true);
  const Eigen::Vector3d offset = anyVector(50.0).head<3>();
  Problem moved = problem;
  for (Waypoint& waypoint : moved.waypoints) waypoint.position += offset;
  const double error =
      difference(problem.solve(), moved.solve(), [&](Eigen::Vector4d value, std::size_t order) {
        if (order == 0) value.head<3>() += offset;
        return value;
      });
  RC_ASSERT(error <= 1e-9);
}

RC_GTEST_PROP(MinimumSnapProperty, TurnsAlongWithARotationAboutTheVertical, ()) {
  const Problem problem = anyProblem(true);
  const double angle = anyReal(-3.0, 3.0);
  const Eigen::Matrix3d rotation =
      Eigen::AngleAxisd(angle, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  const auto rotate = [&](Eigen::Vector4d value) {
    value.head<3>() = (rotation * value.head<3>()).eval();
    return value;
  };
  Problem turned = problem;
  for (Waypoint& waypoint : turned.waypoints) {
    waypoint.position = rotation * waypoint.position;
    waypoint.yaw += angle;
    for (auto* derivative : {&waypoint.velocity, &waypoint.acceleration, &waypoint.jerk}) {
      if (*derivative) *derivative = rotate(**derivative);
    }
  }
  const double error = difference(problem.solve(), turned.solve(),
                                  [&](const Eigen::Vector4d& value, std::size_t order) {
                                    Eigen::Vector4d expected = rotate(value);
                                    if (order == 0) expected(3) += angle;
                                    return expected;
                                  });
  RC_ASSERT(error <= 1e-9);
}

RC_GTEST_PROP(MinimumSnapProperty, ScalesWithTime, ()) {
  const Problem problem = anyProblem(true);
  const double factor = std::pow(10.0, anyReal(-2.0, 2.0));
  Problem slow = problem;
  for (double& duration : slow.durations) duration *= factor;
  for (Waypoint& waypoint : slow.waypoints) {
    double scale = 1.0;
    for (auto* derivative : {&waypoint.velocity, &waypoint.acceleration, &waypoint.jerk}) {
      scale /= factor;
      if (*derivative) **derivative *= scale;
    }
  }
  const PolynomialTrajectory original = problem.solve();
  const PolynomialTrajectory scaled = slow.solve();
  const double expected = original.snapCost() * std::pow(factor, -7.0);
  RC_ASSERT(std::abs(scaled.snapCost() - expected) <= 1e-9 * expected);
  const double error = difference(original.stretched(factor), scaled,
                                  [](const Eigen::Vector4d& value, std::size_t) { return value; });
  RC_ASSERT(error <= 1e-8);
}

RC_GTEST_PROP(MinimumSnapProperty, BackwardsIsTheSamePath, ()) {
  Problem problem = anyProblem(false);
  for (Waypoint& waypoint : problem.waypoints) waypoint.yaw = anyReal(-1.5, 1.5);
  Problem backwards = problem;
  std::reverse(backwards.waypoints.begin(), backwards.waypoints.end());
  std::reverse(backwards.durations.begin(), backwards.durations.end());
  const PolynomialTrajectory forth = problem.solve();
  const PolynomialTrajectory back = backwards.solve();
  for (int i = 1; i < 50; ++i) {
    const double time = forth.duration() * i / 50.0;
    const Eigen::Vector4d expected = forth.evaluate(time).derivative[0];
    const Eigen::Vector4d actual = back.evaluate(back.duration() - time).derivative[0];
    RC_ASSERT((actual - expected).norm() <= 1e-8 * (1.0 + expected.norm()));
  }
}

RC_GTEST_PROP(MinimumSnapProperty, LimitsHoldOnAFineGridAndNotMuchFaster, ()) {
  const Problem problem = anyProblem(false);
  const MotionLimits limits{anyReal(0.5, 20.0), anyReal(0.5, 20.0), anyReal(0.1, 1.4),
                            anyReal(1.1, 4.0)};
  const PolynomialTrajectory trajectory = minimumSnapWithin(problem.waypoints, limits);
  const auto worst = [&limits](const PolynomialTrajectory& flight) {
    constexpr int kSteps = 20000;
    return test::worstUse(flight, limits, kSteps);
  };
  RC_ASSERT(worst(trajectory) <= 1.0);
  const auto& durations = trajectory.segmentDurations();
  if (*std::max_element(durations.begin(), durations.end()) > 0.11) {
    RC_ASSERT(worst(trajectory.stretched(0.98)) > 1.0);
  }
}

}  // namespace
}  // namespace aqc
