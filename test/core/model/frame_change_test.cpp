#include "adaptive_quadrotor_control/model/frame_change.h"

#include <gtest/gtest.h>

#include <cmath>

namespace aqc {
namespace {

Eigen::Isometry3d isometry(const Eigen::Vector3d& at, double angle, const Eigen::Vector3d& axis) {
  return Eigen::Translation3d(at) * Eigen::AngleAxisd(angle, axis.normalized());
}

// C turns steadily about an axis of its own while its origin moves on a curve.
Eigen::Isometry3d poseOfC(double t) {
  return isometry({std::sin(t), 0.3 * t * t, 1.0 + 0.2 * t}, 0.7 + 1.3 * t, {1.0, -2.0, 0.5});
}
State motionOfC(double t) {
  State state;
  state.position = poseOfC(t).translation();
  state.velocity = Eigen::Vector3d(std::cos(t), 0.6 * t, 0.2);
  state.attitude = Eigen::Quaterniond(poseOfC(t).linear());
  state.body_rate = 1.3 * Eigen::Vector3d(1.0, -2.0, 0.5).normalized();
  return state;
}

TEST(FrameChange, IsTheMotionThatDifferentiatingThePoseTells) {
  const Eigen::Isometry3d f_in_w = isometry({4.0, -1.0, 2.0}, 2.1, {0.3, 1.0, -0.4});
  const Eigen::Isometry3d b_in_c = isometry({0.2, 0.1, -0.3}, -1.2, {1.0, 0.2, 0.9});
  const auto poseOfB = [&](double t) { return f_in_w * poseOfC(t) * b_in_c; };
  const double t = 0.8;
  const double h = 1e-5;
  const State state = changeFrames(motionOfC(t), f_in_w, b_in_c);
  const Eigen::Isometry3d pose = poseOfB(t);
  EXPECT_LT((state.position - pose.translation()).norm(), 1e-12);
  EXPECT_LT((state.attitude.toRotationMatrix() - pose.linear()).norm(), 1e-12);
  const Eigen::Vector3d velocity =
      (poseOfB(t + h).translation() - poseOfB(t - h).translation()) / (2.0 * h);
  EXPECT_LT((state.velocity - velocity).norm(), 1e-8);
  const Eigen::AngleAxisd turn(pose.linear().transpose() * poseOfB(t + h).linear());
  EXPECT_LT((state.body_rate - turn.axis() * turn.angle() / h).norm(), 1e-4);
}

TEST(FrameChange, BetweenTheSameFramesChangesNothing) {
  const State told = motionOfC(0.4);
  const State state =
      changeFrames(told, Eigen::Isometry3d::Identity(), Eigen::Isometry3d::Identity());
  EXPECT_EQ(state.position, told.position);
  EXPECT_EQ(state.velocity, told.velocity);
  EXPECT_EQ(state.body_rate, told.body_rate);
  EXPECT_LT(state.attitude.angularDistance(told.attitude), 1e-15);
}

}  // namespace
}  // namespace aqc
