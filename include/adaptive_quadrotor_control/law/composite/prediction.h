#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "adaptive_quadrotor_control/law/composite/applied_wrench.h"
#include "adaptive_quadrotor_control/law/composite/moment_observer.h"
#include "adaptive_quadrotor_control/law/control_law.h"

namespace aqc {

/// The body rate now: `observer` knows it `age` seconds (>= 0) ago.
Eigen::Vector3d predictedRate(const MomentObserver& observer, const AppliedWrench& applied,
                              const Eigen::Vector3d& inertia, double age) noexcept;

/// The attitude now: `measured` is `ages.pose` old, what `observer` knows `ages.body_rate`.
Eigen::Quaterniond predictedAttitude(const Eigen::Quaterniond& measured,
                                     const MomentObserver& observer, const AppliedWrench& applied,
                                     const Eigen::Vector3d& inertia, const Ages& ages) noexcept;

}  // namespace aqc
