#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "support/dense_snap.h"
#include "support/trajectories.h"

namespace aqc {
namespace {

using test::at;
using test::DenseMatrix;
using test::powers;
using test::randomWaypoint;
using test::Real;

// Very unequal durations. For free inner derivatives the optimum is the spline that is six times
// continuously differentiable, which gives linear conditions without squared weights: solved
// densely in unit time per segment and with rows of equal size they serve as oracle.
DenseMatrix splineKnots(const std::vector<Waypoint>& waypoints,
                        const std::vector<double>& durations) {
  const std::size_t segments = durations.size();
  const auto size = static_cast<Eigen::Index>(segments) * 8;
  DenseMatrix system = DenseMatrix::Zero(size, size);
  DenseMatrix rhs = DenseMatrix::Zero(size, 4);
  Eigen::Index row = 0;
  for (std::size_t s = 0; s < segments; ++s) {
    const auto base = static_cast<Eigen::Index>(s) * 8;
    for (int order = 1; order <= 3; ++order) {
      if (s == 0) system.row(row++).segment(base, 8) = powers(0, order);
      if (s + 1 == segments) system.row(row++).segment(base, 8) = powers(1, order);
    }
    const Eigen::Vector3d step = waypoints[s + 1].position - waypoints[s].position;
    system(row++, base) = 1;  // positions relative to the start of each segment
    rhs.row(row).head<3>() = step.cast<Real>();
    rhs(row, 3) = static_cast<Real>(waypoints[s + 1].yaw - waypoints[s].yaw);
    system.row(row++).segment(base, 8) = powers(1, 0);
    for (int order = 1; order <= 6 && s + 1 < segments; ++order) {
      const Real here = std::pow(static_cast<Real>(durations[s]), static_cast<Real>(-order));
      const Real there = std::pow(static_cast<Real>(durations[s + 1]), static_cast<Real>(-order));
      const Real larger = std::max(here, there);
      system.row(row).segment(base, 8) = powers(1, order) * (here / larger);
      system.row(row).segment(base + 8, 8) = -powers(0, order) * (there / larger);
      ++row;
    }
  }
  EXPECT_EQ(row, size);
  return system.partialPivLu().solve(rhs);
}

void expectSpline(const std::vector<Waypoint>& waypoints, const std::vector<double>& durations,
                  double tolerance) {
  const PolynomialTrajectory trajectory = minimumSnap(waypoints, durations);
  const DenseMatrix spline = splineKnots(waypoints, durations);
  double time = 0.0;
  for (std::size_t s = 1; s < durations.size(); ++s) {
    time += durations[s - 1];
    const FlatOutput output = trajectory.evaluate(time);
    const double near = std::min(durations[s - 1], durations[s]);
    for (int order = 1; order <= 3; ++order) {
      const Eigen::Vector4d expected =
          test::denseValue(spline, s, 0.0, order) * std::pow(durations[s], -order);
      const Eigen::Vector4d actual = output.derivative[static_cast<std::size_t>(order)];
      // Relative to what moving the segment's own distance makes for.
      const double size = std::max(expected.norm(), std::pow(near, -order) * 1e-12);
      EXPECT_LE((actual - expected).norm(), tolerance * size)
          << "knot " << s << " order " << order << ": " << actual.transpose() << " instead of "
          << expected.transpose();
    }
  }
}

TEST(MinimumSnap, AgreesWithTheSmoothSpline) {
  std::mt19937 random(3);
  std::vector<Waypoint> waypoints(6);
  for (Waypoint& waypoint : waypoints) waypoint = randomWaypoint(random);
  expectSpline(waypoints, {1.0, 0.5, 2.0, 1.0, 0.7}, 1e-10);
}

struct MixedCase {
  std::vector<double> durations;
  double derivatives[6][3];  // velocity, acceleration, jerk at the inner waypoints
};

/// Solutions of the same spline conditions in exact rational arithmetic, for the positions of the
/// test below. All inputs are binary fractions, so that none is rounded.
std::vector<MixedCase> exactMixedCases() {
  constexpr double kLong = 1024.0;
  constexpr double kShort = 1.0 / 1024.0;
  return {{{kLong, kShort, kLong, kShort, kLong, kShort, kShort},
           {{-3.096149913190735e+07, 6.340956392323811e+10, 3.397234574988543e+08},
            {3.096206512934547e+07, 6.340989568349796e+10, 3.397215546676632e+08},
            {-1.204193522996415e+08, 2.466174936617781e+11, 8.947895066181767e+08},
            {1.204184705218826e+08, 2.466183674752274e+11, 8.947804375166352e+08},
            {-1.526255329600041e+03, 6.893873074212374e+06, -8.426758455027202e+09},
            {1.268389185498904e+03, -8.405024737644685e+05, -5.892801902300013e+09}}},
          {{kShort, kLong, kShort, kShort, kLong, 1.0, kLong},
           {{3.583996695990452e+04, 8.808014040205880e+07, 1.127419561044800e+11},
            {2.581220830639399e+04, -6.550111259024548e+06, -1.503607505345463e+10},
            {1.224588787358116e+04, -2.123368032919715e+07, -1.503587440165099e+10},
            {-1.565975980066682e+04, -3.591705344921834e+07, -1.503567374821671e+10},
            {1.927132673361217e+11, -3.860518156317604e+11, 1.872157687899303e+09},
            {-1.924000144414243e+11, -3.841723018429921e+11, 1.886834159467453e+09}}},
          {{kShort, 1.0, kLong, 1.0, kShort, 1.0, kLong},
           {{3.582467334057212e+04, 8.796739833352397e+07, 1.123091396637528e+11},
            {-9.397666073601171e+09, -4.500755995384222e+10, -8.395244534146011e+10},
            {1.865143574418017e+07, -1.003032582999724e+08, 2.696252929767730e+08},
            {-3.382352507752582e+04, 1.370173899592852e+07, -1.743227468140183e+07},
            {-2.045125846644162e+04, 1.368463690947761e+07, -1.759271967685663e+07},
            {-8.727290202715341e+06, -3.644521718208341e+07, -5.792262572546776e+07}}},
          {{kLong, kShort, kLong, 1.0, 1.0, kShort, kLong},
           {{2.767128377505431e+02, -4.241982421929438e+04, -2.073414026952805e+02},
            {2.352871292935538e+02, -4.242002670036286e+04, -2.073398255571338e+02},
            {5.619814100282803e+02, -1.671521229035352e+03, 1.634132927423974e+03},
            {-2.888207037204863e+02, -2.672824884354579e+01, 1.653653626931706e+03},
            {5.112063339910256e+02, 1.624893181744886e+03, 1.642926150005133e+03},
            {5.127939271430464e+02, 1.626497589483763e+03, 1.642900899242864e+03}}}};
}

TEST(MinimumSnap, MillisecondAndThousandSecondSegmentsMix) {
  std::vector<Waypoint> waypoints;
  for (const double x : {0.0, 10.0, 10.25, 30.0, 29.5, 3.0, 3.5, 4.0}) {
    waypoints.push_back(at(x, -2.0 * x, 1.0));
  }
  for (const MixedCase& exact : exactMixedCases()) {
    const PolynomialTrajectory trajectory = minimumSnap(waypoints, exact.durations);
    double time = 0.0;
    for (std::size_t i = 0; i < 6; ++i) {
      time += exact.durations[i];
      const FlatOutput output = trajectory.evaluate(time);
      for (std::size_t order = 1; order <= 3; ++order) {
        const double expected = exact.derivatives[i][order - 1];
        const Eigen::Vector4d& actual = output.derivative[order];
        EXPECT_NEAR(actual(0), expected, 1e-7 * std::abs(expected)) << i << ' ' << order;
        EXPECT_NEAR(actual(1), -2.0 * expected, 2e-7 * std::abs(expected)) << i << ' ' << order;
      }
    }
    EXPECT_LE((trajectory.evaluate(time).derivative[0].head<3>() - waypoints[6].position).norm(),
              1e-9);
  }
}

TEST(MinimumSnap, AllSegmentsShortOrAllLong) {
  std::mt19937 random(5);
  std::vector<Waypoint> waypoints(8);
  for (Waypoint& waypoint : waypoints) waypoint = randomWaypoint(random);
  expectSpline(waypoints, std::vector<double>(7, 1e-3), 1e-10);
  expectSpline(waypoints, std::vector<double>(7, 1e3), 1e-10);
}

TEST(MinimumSnap, ContinuousToTheJerkOnMixedSegments) {
  const std::vector<Waypoint> waypoints{at(0, 0, 0), at(1, 2, 3), at(1.001, 2, 3), at(5, 5, 5)};
  const PolynomialTrajectory trajectory = minimumSnap(waypoints, {1e3, 1e-3, 1e3});
  for (const double knot : {1e3, 1e3 + 1e-3}) {
    const FlatOutput before = trajectory.evaluate(std::nextafter(knot, 0.0));
    const FlatOutput after = trajectory.evaluate(knot);
    for (std::size_t order = 0; order <= 3; ++order) {
      const double next = order < 4 ? after.derivative[order + 1].norm() : 0.0;
      const double tick = knot - std::nextafter(knot, 0.0);
      EXPECT_LE((before.derivative[order] - after.derivative[order]).norm(),
                4.0 * tick * (next + before.derivative[order + 1].norm()) +
                    1e-12 * after.derivative[order].norm())
          << "order " << order;
    }
  }
}

}  // namespace
}  // namespace aqc
