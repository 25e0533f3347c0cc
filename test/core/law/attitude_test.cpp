#include "adaptive_quadrotor_control/law/attitude.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "adaptive_quadrotor_control/math/rotations.h"
#include "support/fixtures.h"

namespace aqc {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInf = std::numeric_limits<double>::infinity();
const TiltLimits kLimits{80.0 * M_PI / 180.0, 2.0};

bool isRotation(const Eigen::Matrix3d& R) {
  return R.allFinite() && (R.transpose() * R - Eigen::Matrix3d::Identity()).norm() < 1e-12 &&
         std::abs(R.determinant() - 1.0) < 1e-12;
}

State stateWith(const Eigen::Matrix3d& R) {
  State state;
  state.attitude = Eigen::Quaterniond(R);
  return state;
}

TEST(DesiredAttitude, IsARotationForEveryForce) {
  const std::vector<double> values = {0.0,  1.0,    -1.0,  1e-300, 1e300, -1e300,
                                      20.0, 1e-160, 1e154, kInf,   -kInf, kNan};
  for (const double x : values) {
    for (const double y : values) {
      for (const double z : values) {
        for (int i = -8; i <= 8; ++i) {
          const Eigen::Matrix3d R = desiredAttitude({x, y, z}, 0.8 * i, kLimits);
          ASSERT_TRUE(isRotation(R)) << x << " " << y << " " << z << " at yaw " << 0.8 * i;
          ASSERT_GE(R(2, 2), std::cos(kLimits.max_tilt) - 1e-9);
        }
      }
    }
  }
}

TEST(DesiredAttitude, PointsItsZAxisAlongTheForce) {
  test::Dice dice(1);
  for (int i = 0; i < 500; ++i) {
    const Eigen::Vector3d force = dice.vector(10.0) + Eigen::Vector3d(0.0, 0.0, 13.0);
    const Eigen::Matrix3d R = desiredAttitude(force, dice.between(-10.0, 10.0), kLimits);
    EXPECT_LT((R.col(2) - force.normalized()).norm(), 1e-12);
  }
}

TEST(DesiredAttitude, PointsItsXAxisTowardsTheYawSeenFromAbove) {
  test::Dice dice(2);
  for (int i = 0; i < 500; ++i) {
    const double yaw = dice.between(-10.0, 10.0);
    const Eigen::Vector3d force = dice.vector(10.0) + Eigen::Vector3d(0.0, 0.0, 13.0);
    const Eigen::Matrix3d R = desiredAttitude(force, yaw, kLimits);
    const Eigen::Vector2d heading = R.col(0).head<2>().normalized();
    EXPECT_NEAR(heading.x(), std::cos(yaw), 1e-9);
    EXPECT_NEAR(heading.y(), std::sin(yaw), 1e-9);
  }
}

TEST(DesiredAttitude, WorkedByHand) {
  // Force straight up and yaw 90 degrees: x points along y of the world.
  const Eigen::Matrix3d up = desiredAttitude({0.0, 0.0, 5.0}, M_PI_2, kLimits);
  EXPECT_LT((up - yawRotation(M_PI_2).toRotationMatrix()).norm(), 1e-12);
  // Force 45 degrees forward at yaw 0: pitch +45 degrees (nose down in FLU).
  const Eigen::Matrix3d forward = desiredAttitude({5.0, 0.0, 5.0}, 0.0, kLimits);
  const Eigen::Vector3d angles = rollPitchYaw(Eigen::Quaterniond(forward));
  EXPECT_LT((angles - Eigen::Vector3d(0.0, M_PI_4, 0.0)).norm(), 1e-12);
  // Force 45 degrees to the left at yaw 0: roll -45 degrees.
  const Eigen::Matrix3d left = desiredAttitude({0.0, 5.0, 5.0}, 0.0, kLimits);
  const Eigen::Vector3d left_angles = rollPitchYaw(Eigen::Quaterniond(left));
  EXPECT_LT((left_angles - Eigen::Vector3d(-M_PI_4, 0.0, 0.0)).norm(), 1e-12);
}

TEST(DesiredAttitude, TiltsNoFurtherThanTheLimit) {
  const TiltLimits limits{0.5, 1.0};
  const Eigen::Matrix3d R = desiredAttitude({30.0, 40.0, 10.0}, 1.0, limits);
  EXPECT_NEAR(std::acos(R(2, 2)), 0.5, 1e-12);
  EXPECT_NEAR(R(0, 2) / R(1, 2), 0.75, 1e-12) << "in the direction asked for";
}

TEST(DesiredAttitude, SmallAndDownwardForcesCountWithTheLeastLift) {
  for (const double vertical : {1.9, 0.0, -1.0, -100.0}) {
    const Eigen::Matrix3d R = desiredAttitude({1.0, 0.0, vertical}, 0.0, kLimits);
    EXPECT_LT((R.col(2) - Eigen::Vector3d(1.0, 0.0, 2.0).normalized()).norm(), 1e-12);
  }
  const Eigen::Matrix3d level = desiredAttitude(Eigen::Vector3d::Zero(), 0.3, kLimits);
  EXPECT_LT((level - yawRotation(0.3).toRotationMatrix()).norm(), 1e-12);
}

TEST(AttitudeErrors, OfATurnAboutAnAxisIsTheSineAlongIt) {
  test::Dice dice(3);
  for (int i = 0; i < 200; ++i) {
    const Eigen::Matrix3d desired = dice.attitude().toRotationMatrix();
    const Eigen::Vector3d axis = dice.vector(1.0).normalized();
    const double angle = dice.between(-3.0, 3.0);
    const Eigen::Matrix3d R = desired * Eigen::AngleAxisd(angle, axis);
    const AttitudeErrors errors = attitudeErrors(stateWith(R), desired, 0.0);
    EXPECT_LT((errors.angle - std::sin(angle) * axis).norm(), 1e-12);
  }
}

TEST(AttitudeErrors, OfTheQuaternionGrowUpToAHalfTurn) {
  test::Dice dice(7);
  for (int i = 0; i < 200; ++i) {
    const Eigen::Matrix3d desired = dice.attitude().toRotationMatrix();
    const Eigen::Vector3d axis = dice.vector(1.0).normalized();
    const double angle = dice.between(-3.1, 3.1);
    const State state = stateWith(desired * Eigen::AngleAxisd(angle, axis));
    const AttitudeErrors errors =
        attitudeErrors(state, desired, 0.0, AttitudeErrorKind::kQuaternion);
    EXPECT_LT((errors.angle - 2.0 * std::sin(0.5 * angle) * axis).norm(), 1e-12);
    const State turned = stateWith(desired * Eigen::AngleAxisd(M_PI, axis));
    EXPECT_LT(attitudeErrors(turned, desired, 0.0).angle.norm(), 1e-12);
    EXPECT_NEAR(attitudeErrors(turned, desired, 0.0, AttitudeErrorKind::kQuaternion).angle.norm(),
                2.0, 1e-12);
  }
}

TEST(AttitudeErrors, VanishAtTheReference) {
  test::Dice dice(4);
  const Eigen::Matrix3d desired = dice.attitude().toRotationMatrix();
  State state = stateWith(desired);
  // The reference turns about the vertical, seen from the body.
  state.body_rate = desired.transpose() * Eigen::Vector3d(0.0, 0.0, 0.7);
  const AttitudeErrors errors = attitudeErrors(state, desired, 0.7);
  EXPECT_LT(errors.angle.norm(), 1e-12);
  EXPECT_LT(errors.rate.norm(), 1e-12);
}

TEST(AttitudeErrors, RateErrorIsTheRateOfTheRelativeAttitude) {
  // d/dt (R_d' R) = R_d' R [de_q]x, checked by central differences while both turn.
  test::Dice dice(5);
  constexpr double kTime = 1e-5;
  for (int i = 0; i < 100; ++i) {
    const Eigen::Quaterniond desired = dice.attitude();
    const double yaw_rate = dice.between(-3.0, 3.0);
    State state;
    state.attitude = dice.attitude();
    state.body_rate = dice.vector(5.0);
    const auto relative = [&](double time) -> Eigen::Matrix3d {
      const Eigen::Vector3d turn = time * state.body_rate;
      const Eigen::Quaterniond R =
          state.attitude * Eigen::AngleAxisd(turn.norm(), turn.normalized());
      const Eigen::Quaterniond R_d = yawRotation(time * yaw_rate) * desired;
      return (R_d.conjugate() * R).toRotationMatrix();
    };
    const Eigen::Vector3d turned =
        vee(Eigen::Matrix3d(relative(-kTime).transpose() * relative(kTime) -
                            relative(kTime).transpose() * relative(-kTime)));
    const Eigen::Vector3d expected = turned / (4.0 * kTime);
    const AttitudeErrors errors = attitudeErrors(state, desired.toRotationMatrix(), yaw_rate);
    EXPECT_LT((errors.rate - expected).norm(), 1e-6);
  }
}

TEST(RollPitchYaw, UndoesTheZYXRotation) {
  test::Dice dice(6);
  for (int i = 0; i < 200; ++i) {
    const Eigen::Vector3d angles(dice.between(-3.1, 3.1), dice.between(-1.5, 1.5),
                                 dice.between(-3.1, 3.1));
    const Eigen::Quaterniond attitude = Eigen::AngleAxisd(angles.z(), Eigen::Vector3d::UnitZ()) *
                                        Eigen::AngleAxisd(angles.y(), Eigen::Vector3d::UnitY()) *
                                        Eigen::AngleAxisd(angles.x(), Eigen::Vector3d::UnitX());
    EXPECT_LT((rollPitchYaw(attitude) - angles).norm(), 1e-9);
  }
}

}  // namespace
}  // namespace aqc
