#include "adaptive_quadrotor_control/pilot/load_watch.h"

#include <gtest/gtest.h>

#include "support/fixtures.h"

namespace aqc {
namespace {

constexpr double kStep = 0.004;

LoadWatch giving(const Eigen::Vector3d& moment, double seconds) {
  LoadWatch watch(test::vehicleNamed("pelican"));
  for (double time = 0.0; time < seconds; time += kStep) watch.update(1.7, moment, kStep);
  return watch;
}

TEST(LoadWatch, LiftsFullThrustWithoutAMoment) {
  const double most = test::vehicleNamed("pelican").maxThrust() / kGravity;
  const Load load = giving({0.0, 0.0, 0.0}, 1.0).load();
  EXPECT_NEAR(load.liftable, most, 1e-9);
  EXPECT_EQ(load.carried, 1.7);
  EXPECT_DOUBLE_EQ(load.share(), 1.7 / load.liftable);
}

// A rotor at l in x gives a pitch moment with F more than the average, its opposite one with F
// less: M = 2 l F. All four then have F less to give than four of the strongest.
TEST(LoadWatch, LiftsLessBesideAMomentThatStays) {
  const Vehicle vehicle = test::vehicleNamed("pelican");
  const double moment = 0.3;
  const double less = 4.0 * moment / (2.0 * vehicle.rotors.front().arm_length);
  const double left = (vehicle.maxThrust() - less) / kGravity;
  EXPECT_NEAR(giving({0.0, moment, 0.0}, 2.0).load().liftable, left, 1e-6);
  EXPECT_NEAR(giving({-moment, 0.0, 0.0}, 2.0).load().liftable, left, 1e-6);
  EXPECT_GT(giving({0.0, moment, 0.0}, 0.02).load().liftable, left + 0.1) << "not at once";
}

TEST(LoadWatch, YawGivesWayAndAnAbsurdMomentLeavesNothing) {
  const double most = test::vehicleNamed("pelican").maxThrust() / kGravity;
  EXPECT_NEAR(giving({0.0, 0.0, 0.2}, 1.0).load().liftable, most, 1e-9);
  EXPECT_EQ(giving({1e3, 0.0, 0.0}, 1.0).load().liftable, 0.0);
}

}  // namespace
}  // namespace aqc
