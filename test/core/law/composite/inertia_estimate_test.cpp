#include "adaptive_quadrotor_control/law/composite/inertia_estimate.h"

#include <gtest/gtest.h>

#include <cmath>

#include "adaptive_quadrotor_control/parameters/parameter_reader.h"
#include "support/fixtures.h"

namespace aqc {
namespace {

constexpr double kStep = 0.004;

class InertiaEstimateTest : public ::testing::Test {
 protected:
  // It is shaken at 8 rad/s about every axis under a constant moment that nobody told of.
  void shake(const Eigen::Vector3d& inertia, double mass, double moment, double seconds) {
    for (double time = 0.0; time < seconds; time += kStep) {
      const Eigen::Vector3d now = moment * std::sin(8.0 * time_) * Eigen::Vector3d(1.0, -1.0, 1.0);
      rate_ += kStep * now.cwiseQuotient(inertia);
      estimate_.update(rate_, now + Eigen::Vector3d::Constant(0.05), mass, kStep);
      time_ += kStep;
    }
  }

  const Vehicle vehicle_ = test::vehicleNamed("pelican");
  const YAML::Node gains_ = loadYamlFile(test::configFile("controller/composite"));
  InertiaEstimate estimate_{ParameterReader(gains_["estimates"], "estimates"), vehicle_};
  const Eigen::Vector3d empty_ = vehicle_.inertia.diagonal();
  Eigen::Vector3d rate_ = Eigen::Vector3d::Zero();
  double time_ = 0.0;
};

TEST_F(InertiaEstimateTest, IsTheVehiclesOwnAtRest) {
  for (int i = 0; i < 1000; ++i)
    estimate_.update(Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero(), 1.0, kStep);
  EXPECT_LT((estimate_.value() - empty_).norm(), 1e-12);
}

TEST_F(InertiaEstimateTest, FollowsThePriorWithTheMass) {
  for (int i = 0; i < 1000; ++i)
    estimate_.update(Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero(), 1.5, kStep);
  EXPECT_LT((estimate_.value() - empty_ - Eigen::Vector3d(0.01, 0.01, 0.0)).norm(), 1e-9);
}

TEST_F(InertiaEstimateTest, FindsTheInertiaOfAShakenVehicle) {
  const Eigen::Vector3d inertia(0.02, 0.015, 0.03);
  shake(inertia, 1.0, 0.3, 10.0);
  EXPECT_LT((estimate_.value() - inertia).cwiseQuotient(inertia).cwiseAbs().maxCoeff(), 0.03);
}

TEST_F(InertiaEstimateTest, StaysWithinItsBounds) {
  shake(10.0 * empty_, 1.0, 1.0, 10.0);
  EXPECT_LT((estimate_.value() - 2.5 * empty_).norm(), 1e-4);
  shake(0.2 * empty_, 1.0, 0.05, 30.0);
  EXPECT_LT((estimate_.value() - 0.7 * empty_).norm(), 1e-4);
}

TEST_F(InertiaEstimateTest, ForgetsWhenThePayloadIsGoneAndFallsAtOnce) {
  shake({0.03, 0.03, 0.03}, 1.6, 0.3, 10.0);
  ASSERT_GT(estimate_.value().x(), 0.025);
  for (int i = 1; i <= 10; ++i)
    estimate_.update(rate_, Eigen::Vector3d::Zero(), 1.6 - 0.06 * i, kStep);
  EXPECT_LT(estimate_.value().x(), 0.026) << "the bound follows the mass";
}

}  // namespace
}  // namespace aqc
