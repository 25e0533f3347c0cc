#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "adaptive_quadrotor_control/law/composite/applied_wrench.h"
#include "adaptive_quadrotor_control/law/composite/moment_observer.h"
#include "adaptive_quadrotor_control/law/control_law.h"

namespace aqc {

/// What the rotors gave since the parts of a state were sensed.
struct Meanwhile {
  AppliedWrench::Impulse pose;
  AppliedWrench::Impulse body_rate;
};
Meanwhile meanwhile(const AppliedWrench& applied, const Ages& ages) noexcept;

/// The body rate now: `observer` knows it `age` seconds (>= 0) ago, and since then the rotors gave
/// `given`.
Eigen::Vector3d predictedRate(const MomentObserver& observer, const AppliedWrench::Impulse& given,
                              const Eigen::Vector3d& inertia, double age) noexcept;

/// The attitude now: `measured` is `ages.pose` old, what `observer` knows `ages.body_rate`.
Eigen::Quaterniond predictedAttitude(const Eigen::Quaterniond& measured,
                                     const MomentObserver& observer, const Meanwhile& given,
                                     const Eigen::Vector3d& inertia, const Ages& ages) noexcept;

}  // namespace aqc
