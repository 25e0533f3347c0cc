#include "adaptive_quadrotor_control/law/composite/thrust_share.h"

#include <gtest/gtest.h>

#include <cmath>

#include "adaptive_quadrotor_control/math/constants.h"
#include "support/fixtures.h"

namespace aqc {
namespace {

constexpr double kMost = 25.0;
constexpr double kMass = 1.5;
const ThrustShare kShare(kMost, 1.0);

TEST(ThrustShare, GivesWhatThereIs) {
  const Eigen::Vector3d asked(3.0, -4.0, 16.0);
  const ThrustShare::Force given = kShare.share(asked, kMass);
  EXPECT_EQ(given.force, asked);
  EXPECT_FALSE(given.clamped);
}

TEST(ThrustShare, LimitsTheTiltAndKeepsTheDirection) {
  const ThrustShare::Force given = kShare.share({12.0, 16.0, 10.0}, kMass);
  EXPECT_LT((given.force - Eigen::Vector3d(6.0, 8.0, 10.0)).norm(), 1e-12);
  EXPECT_TRUE(given.clamped);
}

TEST(ThrustShare, NeverPushesDown) {
  const ThrustShare::Force given = kShare.share({0.0, 0.0, -30.0}, kMass);
  EXPECT_NEAR(given.force.z(), 0.25 * kMass * kGravity, 1e-12);
  EXPECT_TRUE(given.clamped);
}

TEST(ThrustShare, KeepsATenthOfWhatAHoverLeavesForTheSides) {
  const double weight = kMass * kGravity;
  const double claim = weight + 0.9 * (kMost - weight);
  const ThrustShare::Force given = kShare.share({50.0, 0.0, 100.0}, kMass);
  EXPECT_NEAR(given.force.z(), claim, 1e-9);
  EXPECT_NEAR(given.force.norm(), kMost, 1e-9);
  EXPECT_NEAR(kShare.sideways(kMass), given.force.x() / kMass, 1e-9);
  EXPECT_NEAR(kShare.upwards(kMass), (kMost - weight) / kMass, 1e-12);
}

TEST(ThrustShare, NeverGivesMoreThanThereIs) {
  test::Dice dice(4);
  for (int i = 0; i < 1000; ++i) {
    const double mass = dice.between(0.5, 3.0);
    const ThrustShare::Force given = kShare.share(dice.vector(60.0), mass);
    EXPECT_LE(given.force.norm(), kMost * (1.0 + 1e-12));
    EXPECT_GT(given.force.z(), 0.0);
    EXPECT_LE(given.force.head<2>().norm(), given.force.z() * (1.0 + 1e-12));
  }
}

}  // namespace
}  // namespace aqc
