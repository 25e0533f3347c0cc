#include "adaptive_quadrotor_control/law/adaptive_gain.h"

#include <gtest/gtest.h>

#include <cmath>

#include "adaptive_quadrotor_control/law/saturation.h"

namespace aqc {
namespace {

TEST(AdaptiveGain, FollowsTheClosedFormForAConstantDrive) {
  AdaptiveGain gain(0.5, 3.0);
  for (int i = 1; i <= 100; ++i) {
    gain.step(2.0, 0.01);
    const double decay = std::exp(-3.0 * 0.01 * i);
    EXPECT_NEAR(gain.value(), 0.5 * decay + 2.0 / 3.0 * (1.0 - decay), 1e-14);
  }
}

TEST(AdaptiveGain, IsTheSameHoweverTheTimeIsCut) {
  AdaptiveGain once(0.1, 50.0);
  AdaptiveGain often(0.1, 50.0);
  AdaptiveGain unevenly(0.1, 50.0);
  once.step(7.0, 1.0);
  for (int i = 0; i < 1000; ++i) often.step(7.0, 1e-3);
  for (const double part : {0.3, 0.001, 0.001, 0.198, 0.5}) unevenly.step(7.0, part);
  EXPECT_NEAR(often.value(), once.value(), 1e-13);
  EXPECT_NEAR(unevenly.value(), once.value(), 1e-13);
}

TEST(AdaptiveGain, StaysNonNegativeAtAnyStep) {
  for (const double dt : {1e-9, 1e-3, 1.0, 1e3, 1e9}) {
    AdaptiveGain gain(1e-4, 50.0);
    for (int i = 0; i < 10; ++i) {
      gain.step(0.0, dt);
      EXPECT_GE(gain.value(), 0.0);
    }
    gain.step(1.0, dt);
    EXPECT_GT(gain.value(), 0.0);
    EXPECT_LE(gain.value(), 1.0 / 50.0 + 1e-4);
  }
}

TEST(AdaptiveGain, ResetsToItsInitialValue) {
  AdaptiveGain gain(0.25, 1.0);
  gain.step(10.0, 1.0);
  EXPECT_GT(gain.value(), 1.0);
  gain.reset();
  EXPECT_EQ(gain.value(), 0.25);
}

TEST(Saturation, IsTheUnitVectorOutsideTheBoundaryLayer) {
  const Eigen::Vector3d s(3.0, 0.0, -4.0);
  EXPECT_LT((saturate(s, 1.0) - Eigen::Vector3d(0.6, 0.0, -0.8)).norm(), 1e-15);
  EXPECT_LT((saturate(s, 5.0) - Eigen::Vector3d(0.6, 0.0, -0.8)).norm(), 1e-15);
}

TEST(Saturation, IsLinearInsideTheBoundaryLayer) {
  const Eigen::Vector3d s(3.0, 0.0, -4.0);
  EXPECT_LT((saturate(s, 10.0) - Eigen::Vector3d(0.3, 0.0, -0.4)).norm(), 1e-15);
  EXPECT_EQ(saturate(Eigen::Vector3d::Zero(), 0.1).norm(), 0.0);
}

TEST(Saturation, PerAxisClampsEveryEntryByItself) {
  const Eigen::Vector3d s(3.0, 0.5, -4.0);
  EXPECT_LT((saturatePerAxis(s, 2.0) - Eigen::Vector3d(1.0, 0.25, -1.0)).norm(), 1e-15);
}

TEST(AdaptiveGain, RestsInAStepOfNoTime) {
  AdaptiveGain gain(0.25, 1.0);
  gain.step(10.0, 0.0);
  EXPECT_EQ(gain.value(), 0.25);
}

}  // namespace
}  // namespace aqc
