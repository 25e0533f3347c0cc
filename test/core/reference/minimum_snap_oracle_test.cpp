#include <gtest/gtest.h>

#include <Eigen/Core>
#include <algorithm>
#include <random>
#include <vector>

#include "support/dense_snap.h"
#include "support/trajectories.h"

namespace aqc {
namespace {

using test::denseValue;
using test::randomVector;
using test::randomWaypoint;

/// Compares position to snap with the oracle, relative to the largest value of each order.
void expectDenseOptimum(const std::vector<Waypoint>& waypoints,
                        const std::vector<double>& durations,
                        EndDerivatives ends = EndDerivatives::kRest) {
  const PolynomialTrajectory trajectory = minimumSnap(waypoints, durations, ends);
  const test::DenseMatrix dense =
      test::denseOptimum(waypoints, durations, ends == EndDerivatives::kRest);
  for (int order = 0; order < 5; ++order) {
    double error = 0.0;
    double largest = 1e-3;
    double begin = 0.0;
    for (std::size_t segment = 0; segment < durations.size(); ++segment) {
      for (const double u : {0.0, 0.13, 0.37, 0.5, 0.62, 0.91, 0.999}) {
        const double t = u * durations[segment];
        const Eigen::Vector4d expected = denseValue(dense, segment, t, order);
        const Eigen::Vector4d actual =
            trajectory.evaluate(begin + t).derivative[static_cast<std::size_t>(order)];
        error = std::max(error, (actual - expected).cwiseAbs().maxCoeff());
        largest = std::max(largest, expected.cwiseAbs().maxCoeff());
      }
      begin += durations[segment];
    }
    EXPECT_LE(error, 1e-9 * largest) << "order " << order;
  }
}

class DenseOracle : public testing::TestWithParam<int> {};

TEST_P(DenseOracle, AgreesWithFreeInnerDerivatives) {
  std::mt19937 random(static_cast<unsigned>(GetParam()));
  std::uniform_real_distribution<double> duration(0.4, 3.0);
  std::vector<Waypoint> waypoints(static_cast<std::size_t>(GetParam()));
  for (Waypoint& waypoint : waypoints) {
    waypoint = randomWaypoint(random);
  }
  std::vector<double> durations(waypoints.size() - 1);
  for (double& value : durations) {
    value = duration(random);
  }
  expectDenseOptimum(waypoints, durations);
}

TEST_P(DenseOracle, AgreesWithAnyMixtureOfFixedDerivatives) {
  std::mt19937 random(static_cast<unsigned>(100 + GetParam()));
  std::uniform_real_distribution<double> duration(0.4, 3.0);
  for (int repetition = 0; repetition < 8; ++repetition) {
    std::vector<Waypoint> waypoints(static_cast<std::size_t>(GetParam()));
    std::vector<double> durations(waypoints.size() - 1);
    for (Waypoint& waypoint : waypoints) {
      waypoint = randomWaypoint(random);
      for (auto* derivative : {&waypoint.velocity, &waypoint.acceleration, &waypoint.jerk}) {
        if (random() % 2 == 0) {
          *derivative = randomVector(random, 4.0);
        }
      }
    }
    for (double& value : durations) {
      value = duration(random);
    }
    expectDenseOptimum(waypoints, durations);
    if (waypoints.size() >= 4) {
      expectDenseOptimum(waypoints, durations, EndDerivatives::kFree);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Waypoints, DenseOracle, testing::Values(2, 3, 4, 5, 7));

}  // namespace
}  // namespace aqc
