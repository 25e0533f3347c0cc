#pragma once

#include <Eigen/Core>

#include "adaptive_quadrotor_control/law/control_law.h"

namespace aqc {

/// The axis of B ("x", "y" or "z") about which small errors of attitude grow from step to step,
/// with what the law has learned so far; null when they decay about all of them.
///
/// The law's moment is linearised in a hover, about each axis by itself, and held for steps of
/// `period` [s] (> 0). The body is one of `inertia` [kg m^2], the rotors follow with `lag` [s] (>=
/// 0): the loop is unstable when a pole of the sampled system lies outside the unit circle. It
/// knows no delay of messages and no noise, so that what it lets pass may be too much all the same;
/// what it refuses cannot hold a vehicle of this inertia still. Allocates.
const char* unstableAxis(const ControlLaw& law, const Eigen::Vector3d& inertia, double lag,
                         double period);

}  // namespace aqc
