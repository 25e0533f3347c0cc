#include "adaptive_quadrotor_control/law/composite/mass_estimate.h"

#include <gtest/gtest.h>

#include <cmath>

#include "adaptive_quadrotor_control/parameters/parameter_reader.h"
#include "support/fixtures.h"

namespace aqc {
namespace {

constexpr double kStep = 0.004;

class MassEstimateTest : public ::testing::Test {
 protected:
  // In any attitude and motion: the accelerometer feels thrust and `side` [N], gravity it does not.
  void feel(double mass, double thrust, const Eigen::Vector3d& side, double seconds) {
    const Eigen::Vector3d felt = (Eigen::Vector3d(0.0, 0.0, thrust) + side) / mass;
    for (double time = 0.0; time < seconds; time += kStep) {
      estimate_.feel(felt, thrust, attitude_, kStep);
      estimate_.keep();
    }
  }
  // It falls and rises as a body of `mass` does under `thrust` and the acceleration `pushed` in W.
  void fall(double mass, double thrust, const Eigen::Vector3d& pushed, double seconds) {
    const Eigen::Vector3d z = attitude_.col(2);
    for (double time = 0.0; time < seconds; time += kStep) {
      velocity_ += kStep * (thrust / mass * z + pushed - kGravity * Eigen::Vector3d::UnitZ());
      estimate_.see(velocity_, z, thrust, kStep);
      estimate_.keep();
    }
  }

  const Vehicle vehicle_ = test::vehicleNamed("pelican");
  const YAML::Node gains_ = loadYamlFile(test::configFile("controller/composite"));
  MassEstimate estimate_{ParameterReader(gains_["estimates"], "estimates"), vehicle_};
  Eigen::Matrix3d attitude_ = Eigen::Matrix3d::Identity();
  Eigen::Vector3d velocity_ = Eigen::Vector3d::Zero();
};

TEST_F(MassEstimateTest, IsThrustOverWhatIsFelt) {
  attitude_ = Eigen::AngleAxisd(0.7, Eigen::Vector3d(1.0, 2.0, 0.5).normalized()).matrix();
  feel(1.4, 12.0, {0.0, 0.0, 0.0}, 0.3);
  EXPECT_NEAR(estimate_.mass(), 1.4, 1e-6);
  EXPECT_LT(estimate_.force().norm(), 1e-9);
}

TEST_F(MassEstimateTest, GoesThereWithItsTimeConstant) {
  feel(1.0, kGravity, {0.0, 0.0, 0.0}, 0.1);
  // At once felt as 1.4 kg, so that the smoothing of T and f, which is the same, drops out of the
  // end but delays the way: two lags in a row, 5 and 10 ms.
  feel(1.4, 1.4 * kGravity, {0.0, 0.0, 0.0}, 0.02);
  EXPECT_GT(estimate_.mass(), 1.0 + 0.4 * 0.5);
  EXPECT_LT(estimate_.mass(), 1.0 + 0.4 * 0.9);
}

TEST_F(MassEstimateTest, FeelsAForceToTheSideInTheWorld) {
  attitude_ = Eigen::AngleAxisd(M_PI_2, Eigen::Vector3d::UnitZ()).matrix();
  feel(1.0, kGravity, {0.5, 0.0, 0.0}, 1.0);
  EXPECT_LT((estimate_.force() - Eigen::Vector3d(0.0, 0.5, 0.0)).norm(), 1e-4);
}

TEST_F(MassEstimateTest, LearnsNothingWhileTheGroundHoldsIt) {
  feel(1.0, 0.5 * kGravity, {0.0, 0.0, 0.5 * kGravity}, 1.0);
  EXPECT_EQ(estimate_.mass(), 1.0);
  EXPECT_FALSE(estimate_.lifted());
  feel(1.0, kGravity, {0.0, 0.0, 0.0}, 0.1);
  EXPECT_TRUE(estimate_.lifted());
}

TEST_F(MassEstimateTest, SeesTheMassWithoutAnAccelerometer) {
  attitude_ = Eigen::AngleAxisd(0.3, Eigen::Vector3d::UnitX()).matrix();
  fall(1.5, 15.0, {0.0, 0.0, 0.0}, 3.0);
  EXPECT_NEAR(estimate_.mass(), 1.5, 1e-3);
  EXPECT_LT(estimate_.force().norm(), 1e-2);
}

TEST_F(MassEstimateTest, SeesWhatPushesAcrossTheThrust) {
  fall(1.0, kGravity, {0.7, -0.4, 0.0}, 3.0);
  EXPECT_NEAR(estimate_.mass(), 1.0, 1e-3);
  EXPECT_LT((estimate_.force() - Eigen::Vector3d(0.7, -0.4, 0.0)).norm(), 1e-3);
}

TEST_F(MassEstimateTest, TheSameVelocityAgainIsNoNews) {
  fall(1.2, 14.0, {0.1, 0.0, 0.0}, 0.1);
  const double mass = estimate_.mass();
  const Eigen::Vector3d force = estimate_.force();
  for (int i = 0; i < 10; ++i) {
    estimate_.see(velocity_, Eigen::Vector3d::UnitZ(), 14.0, 0.0);
    estimate_.keep();
  }
  EXPECT_EQ(estimate_.mass(), mass);
  EXPECT_EQ(estimate_.force(), force);
}

TEST_F(MassEstimateTest, KeepsTheForceWhenTheAccelerometerFallsSilent) {
  feel(1.4, 1.4 * kGravity, {0.7, 0.0, 0.0}, 1.0);
  fall(1.4, 1.4 * kGravity, {0.5, 0.0, 0.0}, 0.02);
  EXPECT_NEAR(estimate_.mass(), 1.4, 1e-3);
  EXPECT_LT((estimate_.force() - Eigen::Vector3d(0.5, 0.0, 0.0)).norm(), 0.01);
}

TEST_F(MassEstimateTest, StaysWithinWhatTheVehicleCanBe) {
  feel(5.0, 27.0, {0.0, 0.0, 0.0}, 1.0);
  EXPECT_NEAR(estimate_.mass(), 0.98 * vehicle_.maxThrust() / kGravity, 1e-9);
  estimate_.bound(2.0);
  EXPECT_EQ(estimate_.mass(), 2.0);
  feel(0.3, 6.0, {0.0, 0.0, 0.0}, 1.0);
  EXPECT_NEAR(estimate_.mass(), 0.7, 1e-9);
}

TEST_F(MassEstimateTest, IsAsBeforeWhenAnUpdateIsNotKept) {
  feel(1.3, 13.0, {0.0, 0.0, 0.0}, 0.2);
  const double learned = estimate_.learnedMass();
  estimate_.feel({0.0, 0.0, 4.0}, 13.0, attitude_, kStep);
  EXPECT_NE(estimate_.mass(), learned);
  EXPECT_EQ(estimate_.learnedMass(), learned);
}

}  // namespace
}  // namespace aqc
