#include "adaptive_quadrotor_control/reference/circle.h"

#include <gtest/gtest.h>

#include <cmath>

namespace aqc {
namespace {

Circle eased() {
  return {{3.0, 1.0, 2.0}, {1.0, 1.0}, 0.8, 2.0};
}

TEST(Circle, HasItsRateAfterTheEase) {
  // The ease takes half of its time away.
  const SetPoint point = onCircle(eased(), 5.0);
  const double angle = 0.8 * 4.0;
  const Eigen::Vector3d out(std::cos(angle), std::sin(angle), 0.0);
  const Eigen::Vector3d along(-out.y(), out.x(), 0.0);
  EXPECT_LT((point.position - Eigen::Vector3d(1.0, 1.0, 2.0) - 2.0 * out).norm(), 1e-14);
  EXPECT_LT((point.velocity - 1.6 * along).norm(), 1e-14);
  EXPECT_LT((point.acceleration + 2.0 * 0.64 * out).norm(), 1e-14);
  EXPECT_LT((point.jerk + 2.0 * 0.512 * along).norm(), 1e-14);
}

TEST(Circle, BeginsAtRestAndEveryDerivativeIsThatOfTheOneBefore) {
  const SetPoint start = onCircle(eased(), 0.0);
  EXPECT_EQ((start.position - eased().start).norm(), 0.0);
  EXPECT_EQ(start.velocity.norm() + start.acceleration.norm(), 0.0);
  constexpr double kStep = 1e-5;
  for (const double time : {0.3, 1.1, 1.9, 2.5}) {
    const SetPoint at = onCircle(eased(), time);
    const SetPoint before = onCircle(eased(), time - kStep);
    const SetPoint after = onCircle(eased(), time + kStep);
    const auto slope = [&](auto of) -> Eigen::Vector3d {
      return (of(after) - of(before)) / (2.0 * kStep);
    };
    EXPECT_LT((slope([](const SetPoint& p) { return p.position; }) - at.velocity).norm(), 1e-8);
    EXPECT_LT((slope([](const SetPoint& p) { return p.velocity; }) - at.acceleration).norm(), 1e-8);
    EXPECT_LT((slope([](const SetPoint& p) { return p.acceleration; }) - at.jerk).norm(), 1e-8);
  }
}

TEST(Circle, WithoutEaseHasItsRateAtOnce) {
  Circle circle = eased();
  circle.ease = 0.0;
  EXPECT_LT((onCircle(circle, 0.0).velocity - Eigen::Vector3d(0.0, 1.6, 0.0)).norm(), 1e-15);
}

}  // namespace
}  // namespace aqc
