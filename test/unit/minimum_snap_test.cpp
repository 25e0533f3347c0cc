#include "adaptive_quadrotor_control/reference/minimum_snap.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <atomic>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <new>
#include <numeric>
#include <random>
#include <stdexcept>
#include <string>
#include <vector>

#include "adaptive_quadrotor_control/reference/time_allocation.h"

namespace {
std::atomic<long> allocation_count{0};

// Not inlined, so that compilers do not take free() for the wrong partner of operator new.
[[gnu::noinline]] void* allocate(std::size_t size, std::size_t alignment) {
  ++allocation_count;
  const std::size_t rounded = (size + alignment - 1) / alignment * alignment;
  void* const memory = std::aligned_alloc(alignment, rounded == 0 ? alignment : rounded);
  if (memory == nullptr) {
    throw std::bad_alloc();
  }
  return memory;
}

[[gnu::noinline]] void release(void* memory) {
  std::free(memory);
}
}  // namespace

// Every allocation of this binary is counted, so that a test can show that there is none.
void* operator new(std::size_t size) {
  return allocate(size, alignof(std::max_align_t));
}
void* operator new[](std::size_t size) {
  return allocate(size, alignof(std::max_align_t));
}
void* operator new(std::size_t size, std::align_val_t alignment) {
  return allocate(size, static_cast<std::size_t>(alignment));
}
void* operator new[](std::size_t size, std::align_val_t alignment) {
  return allocate(size, static_cast<std::size_t>(alignment));
}
void operator delete(void* memory) noexcept {
  release(memory);
}
void operator delete[](void* memory) noexcept {
  release(memory);
}
void operator delete(void* memory, std::size_t) noexcept {
  release(memory);
}
void operator delete[](void* memory, std::size_t) noexcept {
  release(memory);
}
void operator delete(void* memory, std::align_val_t) noexcept {
  release(memory);
}
void operator delete[](void* memory, std::align_val_t) noexcept {
  release(memory);
}
void operator delete(void* memory, std::size_t, std::align_val_t) noexcept {
  release(memory);
}
void operator delete[](void* memory, std::size_t, std::align_val_t) noexcept {
  release(memory);
}

namespace aqc {
namespace {

constexpr double kG = 9.81;
constexpr double kInf = std::numeric_limits<double>::infinity();
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

Waypoint at(double x, double y, double z, double yaw = 0.0) {
  Waypoint waypoint;
  waypoint.position = {x, y, z};
  waypoint.yaw = yaw;
  return waypoint;
}

Waypoint randomWaypoint(std::mt19937& random) {
  std::uniform_real_distribution<double> coordinate(-10.0, 10.0);
  std::uniform_real_distribution<double> angle(-1.5, 1.5);
  return at(coordinate(random), coordinate(random), coordinate(random), angle(random));
}

Eigen::Vector4d randomVector(std::mt19937& random, double size) {
  std::uniform_real_distribution<double> number(-size, size);
  return {number(random), number(random), number(random), number(random)};
}

/// The message of the std::invalid_argument that the call throws; empty if it does not.
template <typename Call>
std::string refusal(const Call& call) {
  try {
    call();
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "";
}

// ---------------------------------------------------------------------------------------------
// Oracle: the same quadratic programme over the plain coefficients (powers of seconds since the
// start of each segment), with every condition as an equality constraint, as one dense KKT system.

using Real = long double;
using DenseMatrix = Eigen::Matrix<Real, Eigen::Dynamic, Eigen::Dynamic>;

/// d^order/dt^order of t^0 ... t^7.
Eigen::Matrix<Real, 1, 8> powers(Real t, int order) {
  Eigen::Matrix<Real, 1, 8> row;
  for (int k = 0; k < 8; ++k) {
    Real factor = 1;
    for (int j = 0; j < order; ++j) {
      factor *= static_cast<Real>(k - j);
    }
    row(k) = k < order ? 0 : factor * std::pow(t, static_cast<Real>(k - order));
  }
  return row;
}

struct Programme {
  std::vector<Eigen::Matrix<Real, 1, Eigen::Dynamic>> rows;
  std::vector<Eigen::Matrix<Real, 1, 4>> values;
};

void require(Programme& programme, Eigen::Index size, std::size_t segment, Real t, int order,
             const Eigen::Vector4d& value, bool continues = false) {
  Eigen::Matrix<Real, 1, Eigen::Dynamic> row = Eigen::Matrix<Real, 1, Eigen::Dynamic>::Zero(size);
  row.segment(static_cast<Eigen::Index>(segment) * 8, 8) = powers(t, order);
  if (continues) {
    row.segment(static_cast<Eigen::Index>(segment) * 8 + 8, 8) = -powers(0, order);
  }
  programme.rows.push_back(row);
  programme.values.push_back(value.cast<Real>().transpose());
}

DenseMatrix snapHessian(const std::vector<double>& durations) {
  const auto size = static_cast<Eigen::Index>(durations.size()) * 8;
  DenseMatrix hessian = DenseMatrix::Zero(size, size);
  for (std::size_t s = 0; s < durations.size(); ++s) {
    for (int i = 4; i < 8; ++i) {
      for (int j = 4; j < 8; ++j) {
        const auto base = static_cast<Eigen::Index>(s) * 8;
        const Real factor = powers(1, 4)(i) * powers(1, 4)(j);
        hessian(base + i, base + j) =
            factor * std::pow(static_cast<Real>(durations[s]), static_cast<Real>(i + j - 7)) /
            static_cast<Real>(i + j - 7);
      }
    }
  }
  return hessian;
}

/// Coefficients, 8 rows per segment, one column per output. Yaws are taken as they are.
DenseMatrix denseOptimum(const std::vector<Waypoint>& waypoints,
                         const std::vector<double>& durations, bool is_rest) {
  const auto size = static_cast<Eigen::Index>(durations.size()) * 8;
  Programme programme;
  for (std::size_t i = 0; i < waypoints.size(); ++i) {
    const Waypoint& waypoint = waypoints[i];
    const bool is_last = i == durations.size();
    const std::size_t segment = is_last ? i - 1 : i;
    const Real t = is_last ? static_cast<Real>(durations.back()) : 0;
    Eigen::Vector4d position;
    position << waypoint.position, waypoint.yaw;
    require(programme, size, segment, t, 0, position);
    if (i > 0 && !is_last) {
      require(programme, size, i - 1, static_cast<Real>(durations[i - 1]), 0, position);
    }
    const std::optional<Eigen::Vector4d> fixed[] = {waypoint.velocity, waypoint.acceleration,
                                                    waypoint.jerk};
    for (int order = 1; order <= 3; ++order) {
      if (fixed[order - 1]) {
        require(programme, size, segment, t, order, *fixed[order - 1]);
      } else if (is_rest && (i == 0 || is_last)) {
        require(programme, size, segment, t, order, Eigen::Vector4d::Zero());
      }
      if (i > 0 && !is_last) {
        require(programme, size, i - 1, static_cast<Real>(durations[i - 1]), order,
                Eigen::Vector4d::Zero(), true);
      }
    }
  }
  const auto count = static_cast<Eigen::Index>(programme.rows.size());
  DenseMatrix system = DenseMatrix::Zero(size + count, size + count);
  DenseMatrix rhs = DenseMatrix::Zero(size + count, 4);
  system.topLeftCorner(size, size) = snapHessian(durations);
  for (Eigen::Index i = 0; i < count; ++i) {
    system.row(size + i).head(size) = programme.rows[static_cast<std::size_t>(i)];
    system.col(size + i).head(size) = programme.rows[static_cast<std::size_t>(i)].transpose();
    rhs.row(size + i) = programme.values[static_cast<std::size_t>(i)];
  }
  return system.fullPivLu().solve(rhs).topRows(size);
}

Eigen::Vector4d denseValue(const DenseMatrix& coefficients, std::size_t segment, double t,
                           int order) {
  const DenseMatrix value = powers(static_cast<Real>(t), order) *
                            coefficients.middleRows(static_cast<Eigen::Index>(segment) * 8, 8);
  return value.transpose().cast<double>();
}

/// Compares position to snap with the oracle, relative to the largest value of each order.
void expectDenseOptimum(const std::vector<Waypoint>& waypoints,
                        const std::vector<double>& durations,
                        EndDerivatives ends = EndDerivatives::kRest) {
  const PolynomialTrajectory trajectory = minimumSnap(waypoints, durations, ends);
  const DenseMatrix dense = denseOptimum(waypoints, durations, ends == EndDerivatives::kRest);
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

// ---------------------------------------------------------------------------------------------

TEST(MinimumSnap, OneSegmentFromRestToRestIsTheClosedForm) {
  const double duration = 2.5;
  const PolynomialTrajectory trajectory =
      minimumSnap({at(1, -2, 3, 0.5), at(4, 5, -6, -0.5)}, {duration});
  const Eigen::Vector4d start(1, -2, 3, 0.5);
  const Eigen::Vector4d step(3, 7, -9, -1);
  for (int i = 0; i <= 20; ++i) {
    const double s = i / 20.0;
    const double profile =
        35 * std::pow(s, 4) - 84 * std::pow(s, 5) + 70 * std::pow(s, 6) - 20 * std::pow(s, 7);
    const double speed = 140 * std::pow(s * (1 - s), 3) / duration;
    const FlatOutput output = trajectory.evaluate(s * duration);
    EXPECT_LE((output.derivative[0] - start - profile * step).norm(), 1e-12);
    EXPECT_LE((output.derivative[1] - speed * step).norm(), 1e-12);
  }
  // The snap of the profile is 840 times the third Legendre polynomial, of squared norm 1/7.
  const double cost = step.squaredNorm() * 840.0 * 840.0 / 7.0 * std::pow(duration, -7);
  EXPECT_NEAR(trajectory.snapCost(), cost, 1e-12 * cost);
}

TEST(MinimumSnap, OneWaypointIsAHoldOfZeroDuration) {
  const PolynomialTrajectory trajectory = minimumSnap({at(1, 2, 3, 0.4)}, {});
  EXPECT_EQ(trajectory.duration(), 0.0);
  EXPECT_TRUE(trajectory.segmentDurations().empty());
  EXPECT_EQ(trajectory.snapCost(), 0.0);
  for (const double time : {-1.0, 0.0, 1.0, kInf, -kInf, kNan}) {
    const FlatOutput output = trajectory.evaluate(time);
    EXPECT_EQ(output.derivative[0], Eigen::Vector4d(1, 2, 3, 0.4));
    for (std::size_t order = 1; order < 5; ++order) {
      EXPECT_EQ(output.derivative[order], Eigen::Vector4d::Zero());
    }
  }
}

TEST(MinimumSnap, CoincidentWaypointsAtRestHold) {
  std::vector<Waypoint> waypoints{at(0, 0, 1), at(2, 1, 3, 1.0), at(2, 1, 3, 1.0), at(0, 0, 1)};
  waypoints[1].velocity = waypoints[1].acceleration = waypoints[1].jerk = Eigen::Vector4d::Zero();
  waypoints[2].velocity = waypoints[2].acceleration = waypoints[2].jerk = Eigen::Vector4d::Zero();
  const PolynomialTrajectory trajectory = minimumSnap(waypoints, {1.0, 2.0, 1.0});
  for (double time = 1.0; time < 3.0; time += 0.1) {
    const FlatOutput output = trajectory.evaluate(time);
    EXPECT_EQ(output.derivative[0], Eigen::Vector4d(2, 1, 3, 1));
    EXPECT_EQ(output.derivative[1], Eigen::Vector4d::Zero());
    EXPECT_EQ(output.derivative[4], Eigen::Vector4d::Zero());
  }
}

TEST(MinimumSnap, AllCoincidentWaypointsStayThere) {
  const PolynomialTrajectory trajectory =
      minimumSnap({at(3, 4, 5, 1), at(3, 4, 5, 1), at(3, 4, 5, 1)}, {1.0, 0.1});
  EXPECT_EQ(trajectory.snapCost(), 0.0);
  EXPECT_EQ(trajectory.evaluate(0.7).derivative[0], Eigen::Vector4d(3, 4, 5, 1));
}

TEST(MinimumSnap, FixedDerivativesAreMet) {
  std::mt19937 random(7);
  std::vector<Waypoint> waypoints;
  std::vector<double> durations;
  for (int i = 0; i < 8; ++i) {
    waypoints.push_back(randomWaypoint(random));
    if (i != 2) waypoints.back().velocity = randomVector(random, 5.0);
    if (i != 3) waypoints.back().acceleration = randomVector(random, 5.0);
    if (i != 4) waypoints.back().jerk = randomVector(random, 5.0);
    if (i > 0) durations.push_back(0.2 * i);
  }
  const PolynomialTrajectory trajectory = minimumSnap(waypoints, durations);
  double time = 0.0;
  for (std::size_t i = 0; i < waypoints.size(); ++i) {
    // Just before the knot as well: the left polynomial must arrive with the same derivatives.
    for (const double t : {time, i == 0 ? time : std::nextafter(time, 0.0)}) {
      const FlatOutput output = trajectory.evaluate(t);
      EXPECT_LE((output.derivative[0].head<3>() - waypoints[i].position).norm(), 1e-9);
      const std::optional<Eigen::Vector4d> fixed[] = {waypoints[i].velocity,
                                                      waypoints[i].acceleration, waypoints[i].jerk};
      for (std::size_t order = 1; order <= 3; ++order) {
        if (fixed[order - 1]) {
          EXPECT_LE((output.derivative[order] - *fixed[order - 1]).norm(), 1e-9);
        }
      }
    }
    time += i < durations.size() ? durations[i] : 0.0;
  }
}

TEST(MinimumSnap, RestAtTheEndsIsTheDefaultAndFreeEndsCostLess) {
  const std::vector<Waypoint> waypoints{at(0, 0, 0), at(1, 2, 0), at(3, 1, 1), at(4, 4, 4)};
  const std::vector<double> durations{1.0, 1.5, 1.0};
  const PolynomialTrajectory rest = minimumSnap(waypoints, durations);
  const PolynomialTrajectory free = minimumSnap(waypoints, durations, EndDerivatives::kFree);
  for (const double time : {0.0, rest.duration()}) {
    for (std::size_t order = 1; order <= 3; ++order) {
      EXPECT_LE(rest.evaluate(time).derivative[order].norm(), 1e-9);
    }
  }
  EXPECT_GT(free.evaluate(0.0).derivative[1].norm(), 0.1);
  // Through four points there is a cubic, which has no snap at all.
  EXPECT_LE(free.snapCost(), 1e-18 * rest.snapCost());
}

TEST(MinimumSnap, FreeEndsThatLeaveTheOptimumOpenAreRefused) {
  std::vector<Waypoint> two{at(0, 0, 0), at(1, 2, 0)};
  const auto solve = [](const std::vector<Waypoint>& waypoints) {
    return [&waypoints] {
      minimumSnap(waypoints, std::vector<double>(waypoints.size() - 1, 1.0), EndDerivatives::kFree);
    };
  };
  EXPECT_NE(refusal(solve(two)).find("undetermined"), std::string::npos);
  two[0].jerk = two[1].jerk = Eigen::Vector4d::Zero();  // a cubic has only one jerk
  EXPECT_NE(refusal(solve(two)).find("undetermined"), std::string::npos);
  two[0].velocity = Eigen::Vector4d::Ones();
  EXPECT_EQ(refusal(solve(two)), "");
  std::vector<Waypoint> three{at(0, 0, 0), at(1, 2, 0), at(3, 1, 1)};
  EXPECT_NE(refusal(solve(three)).find("undetermined"), std::string::npos);
  // Halfway between the ends the cubic t (t - 1) (t - 2) has no acceleration.
  three[1].acceleration = Eigen::Vector4d::Zero();
  EXPECT_NE(refusal(solve(three)).find("undetermined"), std::string::npos);
  three[1].velocity = Eigen::Vector4d::Zero();
  EXPECT_EQ(refusal(solve(three)), "");
}

TEST(MinimumSnap, YawGoesTheShortWayRound) {
  const PolynomialTrajectory across =
      minimumSnap({at(0, 0, 0, 3.0), at(1, 0, 0, -3.0), at(2, 0, 0, 3.0)}, {1.0, 1.0});
  EXPECT_NEAR(across.evaluate(0.0).derivative[0](3), 3.0, 1e-12);
  EXPECT_NEAR(across.evaluate(1.0).derivative[0](3), -3.0 + 2.0 * M_PI, 1e-12);
  EXPECT_NEAR(across.evaluate(2.0).derivative[0](3), 3.0, 1e-12);
  // Steps of less than half a turn add up: all the way round and on.
  std::vector<Waypoint> round;
  for (int i = 0; i <= 8; ++i) {
    round.push_back(at(i, 0, 0, std::remainder(i * 2.0, 2.0 * M_PI)));
  }
  const PolynomialTrajectory turning = minimumSnap(round, std::vector<double>(8, 1.0));
  for (int i = 0; i <= 8; ++i) {
    EXPECT_NEAR(turning.evaluate(i).derivative[0](3), i * 2.0, 1e-12);
  }
  // Whole turns in the input make no difference but at the start, whose yaw is kept.
  const PolynomialTrajectory wound =
      minimumSnap({at(0, 0, 0, 1.0 + 6.0 * M_PI), at(0, 0, 0, 1.5 - 20.0 * M_PI)}, {1.0});
  EXPECT_NEAR(wound.evaluate(0.0).derivative[0](3), 1.0 + 6.0 * M_PI, 1e-12);
  EXPECT_NEAR(wound.evaluate(1.0).derivative[0](3), 1.5 + 6.0 * M_PI, 1e-12);
}

// ---------------------------------------------------------------------------------------------
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
          denseValue(spline, s, 0.0, order) * std::pow(durations[s], -order);
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

// ---------------------------------------------------------------------------------------------

TEST(MinimumSnap, NamesWhatIsWrong) {
  const std::vector<Waypoint> four{at(0, 0, 0), at(1, 1, 1), at(2, 0, 0), at(3, 0, 0)};
  EXPECT_EQ(refusal([&] { minimumSnap({}, {}); }),
            "there is no waypoint; there must be at least 1");
  EXPECT_EQ(refusal([&] {
              minimumSnap(four, {1.0, 1.0});
            }),
            "there are 2 segment durations for 4 waypoints; there must be 3");
  EXPECT_EQ(refusal([&] { minimumSnap({at(0, 0, 0)}, {1.0}); }),
            "there are 1 segment durations for 1 waypoints; there must be 0");
  EXPECT_EQ(refusal([&] {
              minimumSnap(four, {1.0, 1.0, -1.0});
            }),
            "segment duration 2 is -1 s; it must be finite and > 0");
  for (const double duration : {0.0, -0.0, kInf, -kInf, kNan}) {
    EXPECT_EQ(refusal([&] {
                minimumSnap(four, {1.0, duration, 1.0});
              }).find("segment duration 1"),
              0U);
  }
  EXPECT_NE(refusal([&] { minimumSnap(four, {1e-300, 1.0, 1.0}); }), "");
}

TEST(MinimumSnap, RefusesNumbersThatAreNotFinite) {
  const std::vector<Waypoint> good(3);
  for (const double bad : {kNan, kInf, -kInf}) {
    std::vector<Waypoint> waypoints = good;
    waypoints[1].position.y() = bad;
    EXPECT_EQ(refusal([&] {
                minimumSnap(waypoints, {1, 1});
              }).find("the position of waypoint 1"),
              0U);
    waypoints = good;
    waypoints[2].yaw = bad;
    EXPECT_EQ(refusal([&] { minimumSnap(waypoints, {1, 1}); }).find("the yaw of waypoint 2"), 0U);
    const auto with = [&](std::optional<Eigen::Vector4d> Waypoint::*derivative) {
      std::vector<Waypoint> changed = good;
      changed[0].*derivative = Eigen::Vector4d(0, 0, 0, bad);
      return refusal([&] { minimumSnap(changed, {1, 1}); });
    };
    EXPECT_EQ(with(&Waypoint::velocity).find("the velocity of waypoint 0"), 0U);
    EXPECT_EQ(with(&Waypoint::acceleration).find("the acceleration of waypoint 0"), 0U);
    EXPECT_EQ(with(&Waypoint::jerk).find("the jerk of waypoint 0"), 0U);
  }
}

TEST(MinimumSnap, ALoneWaypointCannotMove) {
  std::vector<Waypoint> waypoints{at(0, 0, 0)};
  waypoints[0].velocity = Eigen::Vector4d::Zero();
  EXPECT_EQ(refusal([&] { minimumSnap(waypoints, {}); }), "");
  waypoints[0].velocity = Eigen::Vector4d::UnitX();
  EXPECT_NE(refusal([&] { minimumSnap(waypoints, {}); }).find("waypoint 0"), std::string::npos);
}

// ---------------------------------------------------------------------------------------------

PolynomialTrajectory exampleTrajectory() {
  return minimumSnap({at(0, 0, 1), at(3, 1, 2, 1), at(2, 4, 3, 2), at(-1, 2, 1, 3)},
                     {1.2, 0.8, 2.0});
}

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
  const PolynomialTrajectory trajectory = exampleTrajectory();
  const long before = allocation_count;
  Eigen::Vector4d sum = Eigen::Vector4d::Zero();
  for (double time = -1.0; time < 6.0; time += 0.01) {
    sum += trajectory.evaluate(time).derivative[4];
  }
  EXPECT_EQ(allocation_count - before, 0);
  EXPECT_TRUE(sum.allFinite());
  static_assert(noexcept(trajectory.evaluate(0.0)));
  // The counter does count.
  const std::vector<double> allocated(3, 1.0);
  EXPECT_GT(allocation_count - before, 0);
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

// ---------------------------------------------------------------------------------------------

constexpr MotionLimits kLimits{5.0, 6.0, 0.5, 1.6};

/// The largest ratio of demand to limit on a fine grid.
double worstUse(const PolynomialTrajectory& trajectory, const MotionLimits& limits) {
  double worst = 0.0;
  const int steps = 4000 * static_cast<int>(trajectory.segmentDurations().size());
  for (int i = 0; i <= steps; ++i) {
    const FlatOutput output = trajectory.evaluate(trajectory.duration() * i / steps);
    const Eigen::Vector3d acceleration = output.derivative[2].head<3>();
    const Eigen::Vector3d thrust = acceleration + kG * Eigen::Vector3d::UnitZ();
    worst = std::max({worst, output.derivative[1].head<3>().norm() / limits.speed,
                      acceleration.norm() / limits.acceleration,
                      thrust.norm() / kG / limits.thrust_to_weight,
                      std::atan2(thrust.head<2>().norm(), thrust.z()) / limits.tilt});
  }
  return worst;
}

TEST(TimeAllocation, EachLimitHoldsAndIsReached) {
  const std::vector<Waypoint> waypoints{at(0, 0, 1), at(8, 1, 2), at(6, 9, -3), at(-1, 2, 10)};
  const MotionLimits limits[] = {{3.0, 100.0, 1.5, 20.0},
                                 {100.0, 2.0, 1.5, 20.0},
                                 {100.0, 100.0, 0.3, 20.0},
                                 {100.0, 100.0, 1.5, 1.2}};
  for (const MotionLimits& limit : limits) {
    const PolynomialTrajectory trajectory = minimumSnapWithin(waypoints, limit);
    EXPECT_LE(worstUse(trajectory, limit), 1.0);
    EXPECT_GT(worstUse(trajectory.stretched(0.99), limit), 1.0);
    EXPECT_NEAR(requiredStretch(trajectory, limit), 1.0, 1e-5);
    EXPECT_NEAR(requiredStretch(trajectory.stretched(0.5), limit), 2.0, 1e-5);
  }
}

TEST(TimeAllocation, EstimateIsExactForOneStraightSegment) {
  const MotionLimits by_speed{2.0, 50.0, 1.5, 20.0};
  EXPECT_NEAR(estimateDurations({at(0, 0, 0), at(10, 0, 0)}, by_speed)[0], 35.0 / 16.0 * 5.0,
              1e-12);
  EXPECT_NEAR(
      requiredStretch(minimumSnap({at(0, 0, 0), at(10, 0, 0)}, {35.0 / 16.0 * 5.0}), by_speed), 1.0,
      1e-9);
  const MotionLimits by_acceleration{100.0, 2.0, 1.5, 20.0};
  const std::vector<Waypoint> waypoints{at(0, 0, 0), at(0, 6, 8)};
  const std::vector<double> durations = estimateDurations(waypoints, by_acceleration);
  EXPECT_NEAR(requiredStretch(minimumSnap(waypoints, durations), by_acceleration), 1.0, 1e-6);
}

TEST(TimeAllocation, FallingFasterThanGravityIsTiltBeyondTheLimit) {
  // Straight down the tilt is zero up to free fall and half a turn beyond it.
  const MotionLimits limits{100.0, 100.0, 0.5, 20.0};
  const PolynomialTrajectory trajectory = minimumSnapWithin({at(0, 0, 100), at(0, 0, 0)}, limits);
  EXPECT_LE(worstUse(trajectory, limits), 1.0);
  EXPECT_GT(worstUse(trajectory.stretched(0.99), limits), 1.0);
}

TEST(TimeAllocation, HoldsTakeAPositiveTime) {
  const std::vector<Waypoint> waypoints{at(1, 1, 1), at(1, 1, 1), at(1, 1, 1, 2.0)};
  for (const double duration : estimateDurations(waypoints, kLimits)) {
    EXPECT_GE(duration, 0.1);
  }
  const PolynomialTrajectory trajectory = minimumSnapWithin(waypoints, kLimits);
  EXPECT_GE(trajectory.duration(), 0.2 - 1e-12);
  EXPECT_EQ(requiredStretch(trajectory, kLimits), 0.0);
  EXPECT_EQ(minimumSnapWithin({at(1, 1, 1)}, kLimits).duration(), 0.0);
  EXPECT_EQ(requiredStretch(minimumSnapWithin({at(1, 1, 1)}, kLimits), kLimits), 0.0);
  // A hold between two flights, and waypoints next to each other.
  const PolynomialTrajectory held =
      minimumSnapWithin({at(0, 0, 0), at(4, 0, 0), at(4, 0, 0), at(4, 1e-6, 0)}, kLimits);
  EXPECT_LE(worstUse(held, kLimits), 1.0);
}

TEST(TimeAllocation, FixedDerivativesAreKeptWhileStretching) {
  std::vector<Waypoint> waypoints{at(0, 0, 1), at(8, 1, 2), at(16, 0, 2), at(20, 2, 4)};
  waypoints[1].velocity = Eigen::Vector4d(3, 0, 0, 0.1);
  waypoints[2].acceleration = Eigen::Vector4d(0, 0, 0.2, 0);
  waypoints[3].velocity = Eigen::Vector4d(1, 0, 0, 0);
  const PolynomialTrajectory trajectory = minimumSnapWithin(waypoints, kLimits);
  EXPECT_LE(worstUse(trajectory, kLimits), 1.0);
  const auto& durations = trajectory.segmentDurations();
  const double second = durations[0] + durations[1];
  EXPECT_LE((trajectory.evaluate(durations[0]).derivative[1] - *waypoints[1].velocity).norm(),
            1e-9);
  EXPECT_LE((trajectory.evaluate(second).derivative[2] - *waypoints[2].acceleration).norm(), 1e-9);
  EXPECT_LE(
      (trajectory.evaluate(trajectory.duration()).derivative[1] - *waypoints[3].velocity).norm(),
      1e-9);
  // Two percent less time with the same fixed derivatives is too little.
  std::vector<double> shorter = durations;
  for (double& duration : shorter) duration *= 0.98;
  EXPECT_GT(worstUse(minimumSnap(waypoints, shorter), kLimits), 1.0);
}

TEST(TimeAllocation, RefusesFixedDerivativesThatCannotBeHeld) {
  std::vector<Waypoint> waypoints{at(0, 0, 1), at(8, 1, 2), at(16, 0, 2)};
  const auto solve = [&] { minimumSnapWithin(waypoints, kLimits); };
  waypoints[1].velocity = Eigen::Vector4d(7, 0, 0, 0);
  EXPECT_NE(refusal(solve).find("waypoint 1 has the fixed velocity (7 0 0 0)"), std::string::npos);
  EXPECT_NE(refusal(solve).find("beyond the speed limit"), std::string::npos);
  waypoints[1].velocity.reset();
  waypoints[1].acceleration = Eigen::Vector4d(0, 0, 6.0, 0);
  EXPECT_NE(refusal(solve).find("beyond the thrust-to-weight limit"), std::string::npos);
  waypoints[1].acceleration = Eigen::Vector4d(5.9, 0, 0, 0);
  EXPECT_NE(refusal(solve).find("beyond the tilt limit"), std::string::npos);
  // Within the limits at the waypoint, but not to be left from rest so close by.
  waypoints = {at(0, 0, 1), at(0.01, 0, 1)};
  waypoints[1].velocity = Eigen::Vector4d(-4.999, 0, 0, 0);
  waypoints[1].acceleration = Eigen::Vector4d(4, 0, 0, 0);
  EXPECT_NE(refusal(solve).find("with these fixed derivatives"), std::string::npos);
}

TEST(TimeAllocation, RefusesImpossibleLimits) {
  const std::vector<Waypoint> waypoints{at(0, 0, 1), at(8, 1, 2)};
  const auto message = [&](const MotionLimits& limits) {
    const std::string by_estimate = refusal([&] { estimateDurations(waypoints, limits); });
    EXPECT_EQ(by_estimate, refusal([&] { minimumSnapWithin(waypoints, limits); }));
    EXPECT_EQ(by_estimate, refusal([&] { requiredStretch(exampleTrajectory(), limits); }));
    return by_estimate;
  };
  EXPECT_EQ(message(kLimits), "");
  for (const double bad : {0.0, -1.0, kInf, kNan}) {
    EXPECT_EQ(message({bad, 6.0, 0.5, 1.6}).find("the speed limit is"), 0U);
    EXPECT_EQ(message({5.0, bad, 0.5, 1.6}).find("the acceleration limit is"), 0U);
    EXPECT_EQ(message({5.0, 6.0, bad, 1.6}).find("the tilt limit is"), 0U);
    EXPECT_EQ(message({5.0, 6.0, 0.5, bad}).find("the thrust-to-weight limit is"), 0U);
  }
  EXPECT_EQ(message({5.0, 6.0, M_PI / 2.0, 1.6}).find("the tilt limit is"), 0U);
  EXPECT_EQ(message({5.0, 6.0, 0.5, 1.0}),
            "the thrust-to-weight limit is 1; it must be finite and > 1");
  EXPECT_NE(refusal([&] { estimateDurations({}, kLimits); }), "");
}

}  // namespace
}  // namespace aqc
