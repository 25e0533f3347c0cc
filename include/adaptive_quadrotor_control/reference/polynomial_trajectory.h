#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <vector>

namespace aqc {

/// State of the four flat outputs at one instant: rows x, y, z (world frame, z up, metres) and yaw
/// (radians, not wrapped); columns value, velocity, acceleration, jerk (SI units).
using KnotState = Eigen::Matrix4d;

/// The shortest that a segment may last [s]: what time is counted in. Fourth powers of far shorter
/// ones are too small for a double.
constexpr double kShortestSegment = 1e-9;

/// The flat outputs (x, y, z, yaw) and their time derivatives at one instant.
/// derivative[0] is position (m) and yaw (rad), [1] velocity, [2] acceleration, [3] jerk, [4] snap,
/// in m/s^k and rad/s^k; position in the world frame with z up, yaw about world z and not wrapped.
struct FlatOutput {
  std::array<Eigen::Vector4d, 5> derivative;
};

/// Piecewise polynomial of degree seven in x, y, z and yaw, three times continuously
/// differentiable. A septic is determined by value, velocity, acceleration and jerk at its two
/// ends, so the knot states and the durations between them say everything.
///
/// Immutable; concurrent reads are safe.
class PolynomialTrajectory {
 public:
  /// The trajectory that takes the state knots[i] at the time segment_durations[0] + ... +
  /// segment_durations[i - 1] (s), starting at time zero. A single knot is a hold at its position,
  /// of zero duration; its derivatives are then not used.
  ///
  /// Throws std::invalid_argument when there is no knot, when there is not exactly one duration
  /// less than knots, when a duration is not finite and >= kShortestSegment, when a knot is not
  /// finite, or when these are so extreme that the coefficients overflow.
  PolynomialTrajectory(const std::vector<KnotState>& knots,
                       const std::vector<double>& segment_durations);

  /// Total duration in seconds, >= 0; zero for a hold.
  double duration() const noexcept { return knot_times_.back(); }

  /// Duration of every segment in seconds; empty for a hold.
  const std::vector<double>& segmentDurations() const noexcept { return durations_; }

  /// The outputs at `time` (s). For time in [0, duration()] the polynomial, both ends included.
  /// Before the start the first point and after the end the last point are held: position and yaw
  /// of that end with all derivatives zero, also if the polynomial arrives there with speed. NaN
  /// counts as before the start. At an inner knot the snap is that of the later segment.
  ///
  /// Allocates nothing; O(log of the number of segments).
  FlatOutput evaluate(double time) const noexcept;

  /// Integral over [0, duration()] of the squared snap, summed over the four outputs
  /// (m^2/s^7 for x, y, z and rad^2/s^7 for yaw, added with equal weight).
  double snapCost() const noexcept;

  /// The same path flown with every duration multiplied by `factor`: the k-th derivative scales
  /// with factor^-k and the cost with factor^-7, so that fixed non-zero derivatives change too.
  /// Throws std::invalid_argument unless the factor is finite and > 0 and the durations stay
  /// finite and >= kShortestSegment.
  PolynomialTrajectory stretched(double factor) const;

 private:
  /// Column k holds the coefficient of the k-th power of unit time, one row per output.
  using Coefficients = Eigen::Matrix<double, 4, 8>;

  /// Each segment is kept as Taylor expansion about both ends and evaluated from the nearer one:
  /// the states at the knots then come out to the last digit, however short the segment is, where
  /// an expansion about the start alone would lose digits to cancellation at the end.
  struct Segment {
    Coefficients from_start;  ///< powers of (t - t_start) / duration
    Coefficients from_end;    ///< powers of (t - t_end) / duration
  };

  static Segment makeSegment(const KnotState& start, const KnotState& end, double duration);
  void setDurations(const std::vector<double>& durations);

  Eigen::Vector4d first_;
  Eigen::Vector4d last_;
  std::vector<double> durations_;
  std::vector<double> knot_times_;  ///< one more than segments, starting at zero
  std::vector<Segment> segments_;
};

}  // namespace aqc
