#include "adaptive_quadrotor_control/reference/minimum_snap.h"

#include <Eigen/Householder>
#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>

#include "reference/argument_checks.h"
#include "reference/invalid_argument.h"
#include "reference/snap_rows.h"

namespace aqc {
namespace {

// The unknowns are the free ones of velocity, acceleration and jerk at every waypoint. The cost is
// a sum of squares of rows that each touch two successive waypoints (SnapRows), so its normal
// equations are block tridiagonal with blocks of at most 3 x 3, and a block Cholesky solves them
// in linear time. The Cholesky factor is computed here by Householder reflections of the rows
// themselves, without forming the normal equations: these square the weights, and next to a
// segment of 1e-3 s the ones of a segment of 1e3 s would drop below the last digit (1e-30).
// Taking the heaviest row first in every reflection keeps light rows accurate next to heavy ones
// (Powell and Reid, "On applying Householder transformations to linear least squares problems",
// 1969). Their interchange of columns as well gained nothing measurable here.

constexpr int kDerivatives = 3;
constexpr int kOutputs = 4;
constexpr int kSegmentRows = 4;
constexpr int kMaxRows = kDerivatives + kSegmentRows;
constexpr int kMaxColumns = 2 * kDerivatives + kOutputs;

// Columns: free derivatives of one waypoint, then of the next, then one right-hand side per
// output. Only the leading rows and columns in use have a meaning.
using Rows = Eigen::Matrix<double, kMaxRows, kMaxColumns>;

// The free derivatives of a waypoint by order (1 velocity, 2 acceleration, 3 jerk), one column
// each.
struct FreeSet {
  int count = 0;
  std::array<int, kDerivatives> order{};
};

// Upper triangular rows that give the free derivatives of one waypoint from those of the next.
using TriangularRows = Eigen::Matrix<double, kDerivatives, kMaxColumns>;

// What the segments up to a waypoint ask of its free derivatives.
struct Carry {
  int count = 0;
  Eigen::Matrix<double, kDerivatives, kDerivatives> coefficients =
      Eigen::Matrix<double, kDerivatives, kDerivatives>::Zero();
  Eigen::Matrix<double, kDerivatives, kOutputs> rhs =
      Eigen::Matrix<double, kDerivatives, kOutputs>::Zero();
};

std::array<const std::optional<Eigen::Vector4d>*, kDerivatives> derivativesOf(
    const Waypoint& waypoint) {
  return {&waypoint.velocity, &waypoint.acceleration, &waypoint.jerk};
}

FreeSet freeSetOf(const Waypoint& waypoint, bool at_rest) {
  FreeSet free;
  const auto derivatives = derivativesOf(waypoint);
  for (int i = 0; i < kDerivatives; ++i) {
    if (!at_rest && !derivatives[static_cast<std::size_t>(i)]->has_value()) {
      free.order[static_cast<std::size_t>(free.count++)] = i + 1;
    }
  }
  return free;
}

std::vector<FreeSet> freeSetsOf(const std::vector<Waypoint>& waypoints, EndDerivatives ends) {
  std::vector<FreeSet> free(waypoints.size());
  for (std::size_t i = 0; i < waypoints.size(); ++i) {
    const bool outermost = i == 0 || i + 1 == waypoints.size();
    free[i] = freeSetOf(waypoints[i], outermost && ends == EndDerivatives::kRest);
  }
  return free;
}

// The states with everything that is fixed filled in and the free derivatives zero.
std::vector<KnotState> knownStates(const std::vector<Waypoint>& waypoints) {
  constexpr double kTurn = 2.0 * M_PI;
  std::vector<KnotState> knots(waypoints.size(), KnotState::Zero());
  for (std::size_t i = 0; i < waypoints.size(); ++i) {
    const Waypoint& waypoint = waypoints[i];
    double yaw = waypoint.yaw;
    if (i > 0) yaw += kTurn * std::nearbyint((knots[i - 1](3, 0) - yaw) / kTurn);
    knots[i].col(0) << waypoint.position, yaw;
    const auto derivatives = derivativesOf(waypoint);
    for (std::size_t k = 0; k < derivatives.size(); ++k) {
      knots[i].col(static_cast<int>(k) + 1) = derivatives[k]->value_or(Eigen::Vector4d::Zero());
    }
  }
  return knots;
}

SnapRows snapRows(const SnapRows& unit, double duration) {
  const Eigen::Vector4d powers(1.0, duration, duration * duration, duration * duration * duration);
  const Eigen::Vector4d scale = powers / (powers(3) * std::sqrt(duration));
  return {unit.left * scale.asDiagonal(), unit.right * scale.asDiagonal()};
}

Rows assemble(const Carry& carry, const SnapRows& segment, const KnotState& start,
              const KnotState& end, const FreeSet& own, const FreeSet& next) {
  Rows rows = Rows::Zero();
  const int rhs = own.count + next.count;
  rows.topLeftCorner(carry.count, own.count) =
      carry.coefficients.topLeftCorner(carry.count, own.count);
  rows.block(0, rhs, carry.count, kOutputs) = carry.rhs.topRows(carry.count);
  for (int k = 0; k < own.count; ++k) {
    rows.block<kSegmentRows, 1>(carry.count, k) =
        segment.left.col(own.order[static_cast<std::size_t>(k)]);
  }
  for (int k = 0; k < next.count; ++k) {
    rows.block<kSegmentRows, 1>(carry.count, own.count + k) =
        segment.right.col(next.order[static_cast<std::size_t>(k)]);
  }
  // Only the difference of the positions matters; taking it first keeps its digits.
  KnotState displaced = end;
  displaced.col(0) -= start.col(0);
  rows.block<kSegmentRows, kOutputs>(carry.count, rhs).noalias() =
      -(segment.left.rightCols<3>() * start.rightCols<3>().transpose()) -
      segment.right * displaced.transpose();
  return rows;
}

// Makes `count` columns, of which the first is `first`, upper triangular by orthogonal
// transformations of the rows from `first` on.
void triangularise(Rows& rows, int first, int count, int row_count, int column_count) {
  for (int k = first; k < std::min(first + count, row_count); ++k) {
    const int tail = row_count - k - 1;
    int heaviest = 0;
    rows.col(k).segment(k, tail + 1).cwiseAbs().maxCoeff(&heaviest);
    if (heaviest != 0) rows.row(k).swap(rows.row(k + heaviest));
    Eigen::Matrix<double, Eigen::Dynamic, 1, 0, kMaxRows, 1> essential(tail);
    double tau = 0.0;
    double beta = 0.0;
    rows.col(k).segment(k, tail + 1).makeHouseholder(essential, tau, beta);
    for (int c = k + 1; c < column_count; ++c) {
      auto below = rows.col(c).segment(k + 1, tail);
      const double projection = tau * (rows(k, c) + essential.dot(below));
      rows(k, c) -= projection;
      below -= projection * essential;
    }
    rows(k, k) = beta;
    rows.col(k).segment(k + 1, tail).setZero();
  }
}

Carry carryOf(const Rows& rows, int first, int count, int next_count) {
  Carry carry;
  carry.count = count;
  carry.coefficients.topLeftCorner(count, next_count) = rows.block(first, first, count, next_count);
  carry.rhs.topRows(count) = rows.block(first, first + next_count, count, kOutputs);
  return carry;
}

// Fills in the free derivatives of `knot`, with those of the next knot already known.
void backSubstitute(const TriangularRows& rows, const FreeSet& own, const FreeSet& next_free,
                    const KnotState& next, KnotState& knot) {
  Eigen::Matrix<double, kDerivatives, kOutputs> rhs =
      rows.middleCols<kOutputs>(own.count + next_free.count);
  for (int k = 0; k < next_free.count; ++k) {
    rhs -= rows.col(own.count + k) *
           next.col(next_free.order[static_cast<std::size_t>(k)]).transpose();
  }
  for (int k = own.count - 1; k >= 0; --k) {
    rhs.row(k) /= rows(k, k);
    for (int above = 0; above < k; ++above) rhs.row(above) -= rows(above, k) * rhs.row(k);
    knot.col(own.order[static_cast<std::size_t>(k)]) = rhs.row(k).transpose();
  }
}

// Replaces the free derivatives in `knots` by the optimal ones.
void optimise(const std::vector<FreeSet>& free, const std::vector<double>& durations,
              std::vector<KnotState>& knots) {
  const SnapRows unit = unitSnapRows();
  std::vector<TriangularRows> triangular(durations.size());
  Carry carry;
  for (std::size_t i = 0; i < durations.size(); ++i) {
    const int own = free[i].count;
    const int next = free[i + 1].count;
    Rows rows =
        assemble(carry, snapRows(unit, durations[i]), knots[i], knots[i + 1], free[i], free[i + 1]);
    const int row_count = carry.count + kSegmentRows;
    const int column_count = own + next + kOutputs;
    triangularise(rows, 0, own, row_count, column_count);
    triangularise(rows, own, next, row_count, column_count);
    triangular[i] = rows.topRows<kDerivatives>();
    carry = carryOf(rows, own, std::min(row_count - own, next), next);
  }
  TriangularRows last = TriangularRows::Zero();
  last.leftCols<kDerivatives>() = carry.coefficients;
  last.middleCols<kOutputs>(free.back().count) = carry.rhs;
  backSubstitute(last, free.back(), FreeSet{}, KnotState::Zero(), knots.back());
  for (std::size_t i = durations.size(); i-- > 0;) {
    backSubstitute(triangular[i], free[i], free[i + 1], knots[i + 1], knots[i]);
  }
}

// A cubic costs nothing, so the optimum is unique only if no cubic but zero vanishes with all
// that is fixed. Four waypoints settle that by their positions; with fewer it takes derivatives.
void requireDetermined(const std::vector<FreeSet>& free, const std::vector<double>& durations) {
  if (free.size() >= 4) return;
  std::vector<Eigen::RowVector4d> fixed;
  double total = 0.0;
  for (const double duration : durations) total += duration;
  double time = 0.0;
  for (std::size_t i = 0; i < free.size(); ++i) {
    const double u = time / total;
    Eigen::Matrix4d rows;
    rows << 1, u, u * u, u * u * u, 0, 1, 2 * u, 3 * u * u, 0, 0, 2, 6 * u, 0, 0, 0, 6;
    for (int k = 0; k < free[i].count; ++k) {
      rows.row(free[i].order[static_cast<std::size_t>(k)]).setZero();
    }
    for (int k = 0; k < 4; ++k) fixed.emplace_back(rows.row(k));
    time += i < durations.size() ? durations[i] : 0.0;
  }
  Eigen::MatrixXd conditions(static_cast<Eigen::Index>(fixed.size()), 4);
  for (std::size_t i = 0; i < fixed.size(); ++i) {
    conditions.row(static_cast<Eigen::Index>(i)) = fixed[i];
  }
  constexpr double kRankThreshold = 1e-9;
  Eigen::FullPivLU<Eigen::MatrixXd> lu(conditions);
  lu.setThreshold(kRankThreshold);
  if (lu.rank() < 4) {
    throwInvalidArgument("free end derivatives leave the optimum through ", free.size(),
                         " waypoints undetermined; fix more derivatives or add waypoints");
  }
}

}  // namespace

PolynomialTrajectory minimumSnap(const std::vector<Waypoint>& waypoints,
                                 const std::vector<double>& segment_durations,
                                 EndDerivatives ends) {
  requireWaypoints(waypoints);
  requireDurations(segment_durations, waypoints.size(), "waypoints");
  std::vector<KnotState> knots = knownStates(waypoints);
  if (waypoints.size() == 1) {
    if (!knots.front().rightCols<3>().isZero(0.0)) {
      throwInvalidArgument("waypoint 0 is the only one and has a non-zero fixed derivative; a ",
                           "hold needs them free or zero");
    }
    return PolynomialTrajectory(knots, segment_durations);
  }
  const std::vector<FreeSet> free = freeSetsOf(waypoints, ends);
  if (ends == EndDerivatives::kFree) requireDetermined(free, segment_durations);
  optimise(free, segment_durations, knots);
  return PolynomialTrajectory(knots, segment_durations);
}

}  // namespace aqc
