#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "adaptive_quadrotor_control/reference/polynomial_trajectory.h"

namespace aqc {

/// A point to fly through. Derivatives are of (x, y, z, yaw); one that has no value is chosen by
/// the optimisation, except at the ends, where EndDerivatives decides.
struct Waypoint {
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  ///< world frame, z up [m]
  double yaw = 0.0;                                    ///< about world z [rad], any turn
  std::optional<Eigen::Vector4d> velocity;             ///< [m/s], [rad/s]
  std::optional<Eigen::Vector4d> acceleration;         ///< [m/s^2], [rad/s^2]
  std::optional<Eigen::Vector4d> jerk;                 ///< [m/s^3], [rad/s^3]
};

/// What derivatives without a value mean at the first and the last waypoint.
enum class EndDerivatives {
  kRest,  ///< zero: the flight starts and ends at rest
  kFree,  ///< chosen by the optimisation, as at inner waypoints
};

/// The trajectory through the waypoints that minimises the integral of the squared snap of each of
/// x, y, z and yaw, with waypoint i at the time segment_durations[0] + ... +
/// segment_durations[i - 1] (s). Position to jerk are continuous, fixed derivatives are met.
///
/// Yaw goes the short way round: whole turns are added to the yaw of every waypoint but the first
/// until each differs from the one before by at most pi. One waypoint gives a hold of zero
/// duration. Successive waypoints may coincide.
///
/// Source: Mellinger and Kumar, "Minimum snap trajectory generation and control for quadrotors",
/// ICRA 2011, solved without constraints for the free derivatives at the waypoints as in Richter,
/// Bry and Roy, "Polynomial trajectory planning for aggressive quadrotor flight", ISRR 2013. The
/// computing time grows linearly with the number of waypoints. Segments of 1e-3 s and 1e3 s may be
/// mixed: what is fixed is met to rounding, what is free has a relative error of about 1e-12
/// usually and up to about 1e-3 in the worst of such mixtures.
///
/// Throws std::invalid_argument, naming what is wrong, when there is no waypoint, when there is
/// not exactly one duration less than waypoints, when a duration is not finite and >=
/// kShortestSegment, when a number of a waypoint is not finite, when a lone waypoint has a non-zero
/// fixed derivative, when free ends leave the optimum undetermined (possible with two or three
/// waypoints only), or when the numbers are so extreme that the solution overflows.
PolynomialTrajectory minimumSnap(const std::vector<Waypoint>& waypoints,
                                 const std::vector<double>& segment_durations,
                                 EndDerivatives ends = EndDerivatives::kRest);

}  // namespace aqc
