#include "adaptive_quadrotor_control/reference/polynomial_trajectory.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include "reference/argument_checks.h"
#include "reference/invalid_argument.h"
#include "reference/snap_rows.h"

namespace aqc {
namespace {

constexpr int kPolynomialDegree = 7;

FlatOutput hold(const Eigen::Vector4d& position) noexcept {
  FlatOutput output;
  output.derivative.fill(Eigen::Vector4d::Zero());
  output.derivative[0] = position;
  return output;
}

// Derivatives with respect to unit time instead of seconds.
KnotState inUnitTime(KnotState state, double duration) {
  double scale = 1.0;
  for (int order = 1; order < 4; ++order) {
    scale *= duration;
    state.col(order) *= scale;
  }
  return state;
}

// The state as a clock that runs backwards sees it.
KnotState reversed(KnotState state) {
  state.col(1) *= -1.0;
  state.col(3) *= -1.0;
  return state;
}

// Coefficients of the septic on [0, 1] with the given states (in unit time) at its ends. The
// first four are the start's Taylor coefficients; the others make up for what the cubic through
// them misses at the end (the matrix is the inverse of the powers 4 to 7 and their derivatives
// at one).
Eigen::Matrix<double, 4, 8> septic(const KnotState& start, const KnotState& end) {
  Eigen::Matrix<double, 4, 8> c;
  c.col(0) = start.col(0);
  c.col(1) = start.col(1);
  c.col(2) = start.col(2) / 2.0;
  c.col(3) = start.col(3) / 6.0;
  Eigen::Matrix4d missing;
  missing.col(0) = (end.col(0) - c.col(0)) - c.col(1) - c.col(2) - c.col(3);
  missing.col(1) = end.col(1) - c.col(1) - 2.0 * c.col(2) - 3.0 * c.col(3);
  missing.col(2) = end.col(2) - 2.0 * c.col(2) - 6.0 * c.col(3);
  missing.col(3) = end.col(3) - 6.0 * c.col(3);
  Eigen::Matrix4d inverse;
  inverse << 35.0, -84.0, 70.0, -20.0,   //
      -15.0, 39.0, -34.0, 10.0,          //
      2.5, -7.0, 6.5, -2.0,              //
      -1.0 / 6.0, 0.5, -0.5, 1.0 / 6.0;  //
  c.rightCols<4>().noalias() = missing * inverse;
  return c;
}

}  // namespace

PolynomialTrajectory::PolynomialTrajectory(const std::vector<KnotState>& knots,
                                           const std::vector<double>& segment_durations) {
  if (knots.empty()) throwInvalidArgument("there is no knot; a trajectory needs at least 1");
  requireDurations(segment_durations, knots.size(), "knots");
  for (std::size_t i = 0; i < knots.size(); ++i) {
    if (!knots[i].allFinite()) {
      throwInvalidArgument("knot ", i, " is not finite (rows x, y, z, yaw):\n", knots[i]);
    }
  }
  setDurations(segment_durations);
  first_ = knots.front().col(0);
  last_ = knots.back().col(0);
  segments_.reserve(durations_.size());
  for (std::size_t i = 0; i < durations_.size(); ++i) {
    segments_.push_back(makeSegment(knots[i], knots[i + 1], durations_[i]));
    if (!segments_.back().from_start.allFinite() || !segments_.back().from_end.allFinite()) {
      throwInvalidArgument("the coefficients of segment ", i, " overflow with a duration of ",
                           durations_[i], " s; durations and states must be less extreme");
    }
  }
}

PolynomialTrajectory::Segment PolynomialTrajectory::makeSegment(const KnotState& start,
                                                                const KnotState& end,
                                                                double duration) {
  const KnotState unit_start = inUnitTime(start, duration);
  const KnotState unit_end = inUnitTime(end, duration);
  Segment segment;
  segment.from_start = septic(unit_start, unit_end);
  segment.from_end = septic(reversed(unit_end), reversed(unit_start));
  for (int k = 1; k <= kPolynomialDegree; k += 2) segment.from_end.col(k) *= -1.0;
  return segment;
}

void PolynomialTrajectory::setDurations(const std::vector<double>& durations) {
  std::vector<double> knot_times(1, 0.0);
  knot_times.reserve(durations.size() + 1);
  for (const double duration : durations) knot_times.push_back(knot_times.back() + duration);
  if (!std::isfinite(knot_times.back())) {
    throwInvalidArgument("the total duration is ", knot_times.back(), " s; it must be finite");
  }
  durations_ = durations;
  knot_times_ = std::move(knot_times);
}

FlatOutput PolynomialTrajectory::evaluate(double time) const noexcept {
  if (segments_.empty() || !(time >= 0.0)) return hold(first_);
  if (time > duration()) return hold(last_);
  const auto inner_begin = std::next(knot_times_.begin());
  const auto inner_end = std::prev(knot_times_.end());
  const auto next = std::upper_bound(inner_begin, inner_end, time);
  const auto index = static_cast<std::size_t>(next - inner_begin);
  const double rate = 1.0 / durations_[index];
  const double since_start = time - *std::prev(next);
  const double until_end = *next - time;
  const bool near_start = since_start <= until_end;
  const Segment& segment = segments_[index];
  const Coefficients& c = near_start ? segment.from_start : segment.from_end;
  const double u = (near_start ? since_start : -until_end) * rate;

  // Horner's scheme for the value and, along with it, the derivatives divided by k!.
  FlatOutput output = hold(c.col(kPolynomialDegree));
  auto& d = output.derivative;
  for (int k = kPolynomialDegree - 1; k >= 0; --k) {
    for (std::size_t order = d.size() - 1; order > 0; --order) {
      d[order] = d[order] * u + d[order - 1];
    }
    d[0] = d[0] * u + c.col(k);
  }
  double scale = 1.0;
  for (std::size_t order = 1; order < d.size(); ++order) {
    scale *= rate * static_cast<double>(order);
    d[order] *= scale;
  }
  return output;
}

double PolynomialTrajectory::snapCost() const noexcept {
  const SnapRows rows = unitSnapRows();
  const Eigen::Vector4d factorial(1.0, 1.0, 2.0, 6.0);
  double cost = 0.0;
  for (std::size_t i = 0; i < segments_.size(); ++i) {
    Eigen::Matrix4d start = segments_[i].from_start.leftCols<4>() * factorial.asDiagonal();
    Eigen::Matrix4d end = segments_[i].from_end.leftCols<4>() * factorial.asDiagonal();
    // Only the difference of the positions matters; taking it first keeps its digits.
    end.col(0) -= start.col(0);
    start.col(0).setZero();
    const Eigen::Matrix4d snap = rows.left * start.transpose() + rows.right * end.transpose();
    cost += snap.squaredNorm() * std::pow(durations_[i], -kPolynomialDegree);
  }
  return cost;
}

PolynomialTrajectory PolynomialTrajectory::stretched(double factor) const {
  if (!std::isfinite(factor) || factor <= 0.0) {
    throwInvalidArgument("the stretch factor is ", factor, "; it must be finite and > 0");
  }
  std::vector<double> durations = durations_;
  for (double& duration : durations) duration *= factor;
  // The coefficients are in unit time and so do not change.
  requireDurations(durations, durations.size() + 1, "knots");
  PolynomialTrajectory result = *this;
  result.setDurations(durations);
  return result;
}

}  // namespace aqc
