#include "adaptive_quadrotor_control/reference/polynomial_trajectory.h"

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <cmath>
#include <string>
#include <vector>

#include "support/heap_counter.h"
#include "support/refusal.h"
#include "support/trajectories.h"

namespace aqc {
namespace {

using test::at;
using test::exampleTrajectory;
using test::kInf;
using test::kNan;
using test::refusal;

TEST(PolynomialTrajectory, HoldsOutsideItsTime) {
  std::vector<Waypoint> waypoints{at(0, 0, 1), at(3, 1, 2, 1)};
  waypoints[0].velocity = waypoints[1].velocity = Eigen::Vector4d::Ones();
  const PolynomialTrajectory trajectory = minimumSnap(waypoints, {1.0});
  EXPECT_LE((trajectory.evaluate(0.0).derivative[1] - Eigen::Vector4d::Ones()).norm(), 1e-12);
  EXPECT_LE((trajectory.evaluate(1.0).derivative[1] - Eigen::Vector4d::Ones()).norm(), 1e-12);
  for (const double time : {-kInf, -1.0, -1e-300, kNan, std::nextafter(1.0, 2.0), 7.0, kInf}) {
    const FlatOutput output = trajectory.evaluate(time);
    const Eigen::Vector4d expected =
        time > 0.5 ? Eigen::Vector4d(3, 1, 2, 1) : Eigen::Vector4d(0, 0, 1, 0);
    EXPECT_EQ(output.derivative[0], expected) << time;
    for (std::size_t order = 1; order < 5; ++order) {
      EXPECT_EQ(output.derivative[order], Eigen::Vector4d::Zero()) << time;
    }
  }
}

TEST(PolynomialTrajectory, DerivativesAreThoseOfTheDerivativeBelow) {
  const PolynomialTrajectory trajectory = exampleTrajectory();
  const double h = 1e-4;
  for (double time = 0.01; time < trajectory.duration() - 0.01; time += 0.0137) {
    if (std::abs(time - 1.2) < 2 * h || std::abs(time - 2.0) < 2 * h) continue;
    const FlatOutput output = trajectory.evaluate(time);
    for (std::size_t order = 1; order < 5; ++order) {
      const auto below = [&](double offset) {
        return trajectory.evaluate(time + offset).derivative[order - 1];
      };
      const Eigen::Vector4d difference =
          (8.0 * (below(h) - below(-h)) - (below(2 * h) - below(-2 * h))) / (12.0 * h);
      EXPECT_LE((difference - output.derivative[order]).norm(),
                1e-8 * (1.0 + output.derivative[order].norm()));
    }
  }
}

TEST(PolynomialTrajectory, CostIsTheIntegralOfTheSquaredSnap) {
  const PolynomialTrajectory trajectory = exampleTrajectory();
  double integral = 0.0;
  double begin = 0.0;
  // Gauss-Legendre with four nodes is exact for the degree six that the squared snap has.
  const double nodes[] = {-0.8611363115940526, -0.3399810435848563, 0.3399810435848563,
                          0.8611363115940526};
  const double weights[] = {0.3478548451374538, 0.6521451548625461, 0.6521451548625461,
                            0.3478548451374538};
  for (const double duration : trajectory.segmentDurations()) {
    for (int i = 0; i < 4; ++i) {
      const double time = begin + duration * (1.0 + nodes[i]) / 2.0;
      integral +=
          weights[i] * duration / 2.0 * trajectory.evaluate(time).derivative[4].squaredNorm();
    }
    begin += duration;
  }
  EXPECT_NEAR(trajectory.snapCost(), integral, 1e-12 * integral);
}

TEST(PolynomialTrajectory, EvaluationAllocatesNothing) {
  if (!test::canCountHeap()) GTEST_SKIP() << "the allocator cannot be watched here";
  const PolynomialTrajectory trajectory = exampleTrajectory();
  const test::HeapCounter counter;
  Eigen::Vector4d sum = Eigen::Vector4d::Zero();
  for (double time = -1.0; time < 6.0; time += 0.01) {
    sum += trajectory.evaluate(time).derivative[4];
  }
  EXPECT_EQ(counter.count(), 0u);
  EXPECT_TRUE(sum.allFinite());
  static_assert(noexcept(trajectory.evaluate(0.0)));
}

TEST(PolynomialTrajectory, StretchingScalesDerivativesAndCost) {
  const PolynomialTrajectory trajectory = exampleTrajectory();
  const PolynomialTrajectory slow = trajectory.stretched(2.5);
  EXPECT_NEAR(slow.duration(), 2.5 * trajectory.duration(), 1e-12);
  EXPECT_NEAR(slow.snapCost(), trajectory.snapCost() * std::pow(2.5, -7),
              1e-12 * trajectory.snapCost());
  for (const double time : {0.3, 1.5, 3.0}) {
    for (std::size_t order = 0; order < 5; ++order) {
      const Eigen::Vector4d expected =
          trajectory.evaluate(time).derivative[order] * std::pow(2.5, -static_cast<double>(order));
      EXPECT_LE((slow.evaluate(2.5 * time).derivative[order] - expected).norm(),
                1e-10 * (1.0 + expected.norm()));
    }
  }
  for (const double factor : {0.0, -1.0, kInf, kNan}) {
    EXPECT_EQ(refusal([&] { trajectory.stretched(factor); }).find("the stretch factor is"), 0U);
  }
  EXPECT_EQ(refusal([&] { trajectory.stretched(-0.123456789); }),
            "the stretch factor is -0.123456789; it must be finite and > 0");
}

TEST(PolynomialTrajectory, IsFiniteDownToTheShortestSegmentAndRefusesShorterOnes) {
  std::vector<KnotState> knots(2, KnotState::Zero());
  knots[1].col(0).setConstant(100.0);
  const PolynomialTrajectory shortest(knots, {kShortestSegment});
  for (const double share : {0.0, 0.3, 1.0}) {
    for (const Eigen::Vector4d& derivative :
         shortest.evaluate(share * kShortestSegment).derivative) {
      EXPECT_TRUE(derivative.allFinite()) << share;
    }
  }
  EXPECT_TRUE(std::isfinite(shortest.snapCost()));
  for (const double duration : {0.9e-9, 1e-78, 1e-300}) {
    EXPECT_NE(refusal([&] { PolynomialTrajectory(knots, {duration}); }).find(">= 1e-09 s"),
              std::string::npos)
        << duration;
  }
  EXPECT_NE(refusal([&] { exampleTrajectory().stretched(1e-80); }).find(">= 1e-09 s"),
            std::string::npos);
}

TEST(PolynomialTrajectory, RefusesWhatIsNoTrajectory) {
  const std::vector<KnotState> two(2, KnotState::Zero());
  EXPECT_NE(refusal([&] { PolynomialTrajectory({}, {}); }), "");
  EXPECT_NE(refusal([&] { PolynomialTrajectory(two, {}); }), "");
  EXPECT_NE(refusal([&] { PolynomialTrajectory(two, {0.0}); }), "");
  std::vector<KnotState> bad = two;
  bad[1](2, 3) = kNan;
  EXPECT_EQ(refusal([&] { PolynomialTrajectory(bad, {1.0}); }).find("knot 1 is not finite"), 0U);
  bad[1](2, 3) = 1e300;
  EXPECT_NE(refusal([&] { PolynomialTrajectory(bad, {1e5}); }).find("overflow"), std::string::npos);
}

TEST(PolynomialTrajectory, RefusesToStretchBeyondAllTime) {
  const PolynomialTrajectory trajectory =
      minimumSnap({at(0, 0, 1), at(3, 1, 2), at(5, 1, 2)}, {1.0, 1.0});
  EXPECT_EQ(refusal([&] { trajectory.stretched(1.5e308); }),
            "the total duration is inf s; it must be finite");
}

}  // namespace
}  // namespace aqc
