#include "adaptive_quadrotor_control/law/composite/moment_observer.h"

#include <gtest/gtest.h>

#include <cmath>

#include "adaptive_quadrotor_control/law/composite/prediction.h"
#include "adaptive_quadrotor_control/parameters/parameter_reader.h"
#include "support/fixtures.h"

namespace aqc {
namespace {

constexpr double kStep = 0.004;

class MomentObserverTest : public ::testing::Test {
 protected:
  // About one axis, where nothing is gyroscopic: the exact motion under a constant moment.
  void turn(int axis, double rotors, double beside, int steps) {
    Eigen::Vector3d moment = Eigen::Vector3d::Zero();
    moment[axis] = rotors;
    for (int i = 0; i < steps; ++i) {
      rate_[axis] += kStep * (rotors + beside) / inertia_[axis];
      observer_.see(rate_, moment, inertia_, kStep, source_);
      observer_.keep();
    }
  }

  const Vehicle vehicle_ = test::vehicleNamed("pelican");
  const YAML::Node gains_ = loadYamlFile(test::configFile("controller/composite"));
  MomentObserver observer_{ParameterReader(gains_["estimates"], "estimates"), vehicle_};
  const Eigen::Vector3d inertia_ = vehicle_.inertia.diagonal();
  MomentObserver::Source source_ = MomentObserver::Source::kGyroscope;
  Eigen::Vector3d rate_ = Eigen::Vector3d::Zero();
};

// The error of a double pole p after n steps is (1 + n (1 - p)) p^n of the moment.
TEST_F(MomentObserverTest, FindsAMomentByADoublePole) {
  for (const int axis : {0, 1, 2}) {
    observer_.reset();
    rate_.setZero();
    const double p = std::exp(-(axis == 2 ? 12.0 : 30.0) * kStep);
    for (int n = 1; n <= 50; ++n) {
      turn(axis, 0.05, 0.01, 1);
      const double left = (1.0 + n * (1.0 - p)) * std::pow(p, n);
      EXPECT_NEAR(observer_.moment()[axis], 0.01 * (1.0 - left), 1e-9) << axis << " " << n;
    }
  }
}

TEST_F(MomentObserverTest, TurnsAsAFreeBodyDoes) {
  observer_.restart({1.0, 2.0, 3.0});
  observer_.keep();
  const Eigen::Vector3d before(1.0, 2.0, 3.0);
  const Eigen::Vector3d spin = inertia_.cwiseProduct(before);
  const Eigen::Vector3d after = before - kStep * before.cross(spin).cwiseQuotient(inertia_);
  observer_.see(after, Eigen::Vector3d::Zero(), inertia_, kStep, source_);
  EXPECT_LT(observer_.moment().norm(), 1e-12);
}

TEST_F(MomentObserverTest, IsBounded) {
  turn(0, 0.0, 100.0, 100);
  const double arm = vehicle_.rotors[0].arm_length;
  EXPECT_NEAR(observer_.moment().x(), 0.085 * vehicle_.maxThrust() * arm, 1e-9);
}

TEST_F(MomentObserverTest, ARestartKeepsTheMoment) {
  turn(0, 0.0, 0.02, 500);
  observer_.restart({5.0, 0.0, 0.0});
  observer_.keep();
  EXPECT_NEAR(observer_.moment().x(), 0.02, 1e-6);
  EXPECT_EQ(observer_.rate().x(), 5.0);
}

// After the observer has settled, a motion under constant moments is predicted exactly: omega + a d
// and, turned about one axis, omega d + a d^2 / 2.
TEST_F(MomentObserverTest, RateAndAttitudeArePredictedOverTheirAges) {
  AppliedWrench applied;
  for (int i = 0; i < 40; ++i) applied.observe({10.0, {0.03, 0.0, 0.0}}, kStep);
  turn(0, 0.03, 0.01, 500);
  const double a = 0.04 / inertia_.x();
  const double w = observer_.rate().x();
  EXPECT_NEAR(predictedRate(observer_, applied.since(0.02), inertia_, 0.02).x(), w + a * 0.02,
              1e-6);
  EXPECT_EQ(predictedRate(observer_, {}, inertia_, 0.0).x(), w);
  const auto turned = [&](double pose, double rate) {
    const Ages ages = {pose, rate, 0.0};
    const Eigen::Quaterniond now = predictedAttitude(Eigen::Quaterniond::Identity(), observer_,
                                                     meanwhile(applied, ages), inertia_, ages);
    return 2.0 * std::atan2(now.x(), now.w());
  };
  const double whole = 2.0 * M_PI;
  EXPECT_NEAR(std::remainder(turned(0.02, 0.02) - (w * 0.02 + 0.5 * a * 4e-4), whole), 0.0, 1e-6);
  // With a rate of now the past is what it was under the same moments.
  EXPECT_NEAR(std::remainder(turned(0.02, 0.0) - (w * 0.02 - 0.5 * a * 4e-4), whole), 0.0, 1e-6);
  EXPECT_EQ(turned(0.0, 0.0), 0.0);
}

}  // namespace
}  // namespace aqc
