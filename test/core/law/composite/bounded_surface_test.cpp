#include "adaptive_quadrotor_control/law/composite/bounded_surface.h"

#include <gtest/gtest.h>

#include <cmath>

namespace aqc {
namespace {

constexpr Approach kSideways = {2.5, 4.0, 5.0};
constexpr Approach kVertical = {3.0, 6.0, 4.0};

BoundedSurface at(double x, double y, double z) {
  return BoundedSurface({x, y, z}, kSideways, kVertical);
}

TEST(BoundedSurface, IsLinearNearZero) {
  const BoundedSurface near = at(0.1, -0.2, 0.3);
  EXPECT_LT((near.value() - Eigen::Vector3d(0.25, -0.5, 0.9)).norm(), 1e-12);
  EXPECT_TRUE(near.linearSideways() && near.linearVertically());
  EXPECT_LT((near.slopeTimes({1.0, 1.0, 1.0}) - Eigen::Vector3d(2.5, 2.5, 3.0)).norm(), 1e-12);
  EXPECT_EQ(at(0.0, 0.0, 0.0).value().norm(), 0.0);
}

// On s = 0, de = -phi and dde = -phi' de = phi' phi, which is a wherever phi is the root.
TEST(BoundedSurface, BrakesWithItsBrakingFurtherAway) {
  for (const double r : {0.7, 1.0, 2.0, 3.0}) {
    const BoundedSurface far = at(0.6 * r, 0.8 * r, -0.3 * r - 0.5);
    const Eigen::Vector3d braking = far.slopeTimes(far.value());
    EXPECT_NEAR(braking.head<2>().norm(), 4.0, 1e-9) << r;
    EXPECT_NEAR(braking.z(), -6.0, 1e-9) << r;
    EXPECT_FALSE(far.linearSideways() || far.linearVertically());
  }
}

TEST(BoundedSurface, HasASpeedAtTheMost) {
  const BoundedSurface far = at(300.0, -400.0, 50.0);
  EXPECT_LT((far.value() - Eigen::Vector3d(3.0, -4.0, 4.0)).norm(), 1e-12);
  EXPECT_NEAR(far.slopeTimes({3.0, -4.0, 1.0}).norm(), 0.0, 1e-12);
  EXPECT_NEAR(far.slopeTimes({4.0, 3.0, 0.0}).norm(), 5.0 * 5.0 / 500.0, 1e-12) << "it turns";
}

TEST(BoundedSurface, ItsSlopeIsItsDerivative) {
  for (const Eigen::Vector3d& error :
       {Eigen::Vector3d(0.2, 0.1, -0.1), Eigen::Vector3d(1.0, -2.0, 1.5),
        Eigen::Vector3d(-4.0, 3.0, 9.0)}) {
    const Eigen::Vector3d step(3e-7, -2e-7, 4e-7);
    const BoundedSurface here(error, kSideways, kVertical);
    const BoundedSurface there(error + step, kSideways, kVertical);
    EXPECT_LT((there.value() - here.value() - here.slopeTimes(step)).norm(), 1e-11);
  }
}

}  // namespace
}  // namespace aqc
