#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "adaptive_quadrotor_control/model/state.h"

namespace aqc {

/// The motion of B in W, told as that of another frame C of the same rigid body in another world F.
///
/// `told` is the motion of C in F: position of C's origin and velocity in F, attitude R_C^F,
/// angular rate in C. `f_in_w` brings points of F into W and is at rest there; `b_in_c` brings
/// points of B into C, rigidly.
inline State changeFrames(const State& told, const Eigen::Isometry3d& f_in_w,
                          const Eigen::Isometry3d& b_in_c) {
  const Eigen::Vector3d lever = b_in_c.translation();
  const Eigen::Quaterniond world_turn(f_in_w.linear());
  const Eigen::Quaterniond body_turn(b_in_c.linear());
  State state;
  state.position = f_in_w * (told.position + told.attitude * lever);
  state.velocity = world_turn * (told.velocity + told.attitude * told.body_rate.cross(lever));
  state.attitude = (world_turn * told.attitude * body_turn).normalized();
  state.body_rate = body_turn.conjugate() * told.body_rate;
  return state;
}

}  // namespace aqc
