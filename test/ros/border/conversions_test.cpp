#include "ros/border/conversions.h"

#include <gtest/gtest.h>

#include <functional>
#include <limits>

#include "adaptive_quadrotor_control/math/rotations.h"
#include "support/refusal.h"

namespace aqc {
namespace {

constexpr Nanoseconds kBegin = 5'000'000'000;
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

using Trajectory = trajectory_msgs::MultiDOFJointTrajectory;

TEST(Conversions, OdometryHoldsTheStateWithItsTwistInTheBody) {
  State state;
  state.position = {1.0, -2.0, 3.0};
  state.attitude = Eigen::Quaterniond(0.8, 0.2, -0.4, 0.4).normalized();
  state.velocity = {0.3, 0.5, -0.7};
  state.body_rate = {-0.1, 0.2, 0.9};
  const nav_msgs::Odometry odometry = toOdometry(state, kBegin);
  EXPECT_EQ(odometry.header.stamp, ros::Time(5, 0));
  EXPECT_EQ(odometry.header.frame_id, "world");
  EXPECT_EQ(odometry.child_frame_id, "base_link");
  const Eigen::Vector3d in_body = state.attitude.conjugate() * state.velocity;
  EXPECT_TRUE(toEigen(odometry.twist.twist.linear).isApprox(in_body, 1e-12));
  const State heard = toState(odometry);
  EXPECT_EQ(heard.position, state.position);
  EXPECT_TRUE(heard.attitude.isApprox(state.attitude, 1e-12));
  EXPECT_TRUE(heard.velocity.isApprox(state.velocity, 1e-12));
  EXPECT_EQ(heard.body_rate, state.body_rate);
}

// The refusal of three set points, 10 ms apart, after a change.
std::string refusalOf(const std::function<void(Trajectory&)>& change) {
  std::vector<TimedSetPoint> set_points;
  for (int i = 0; i < 3; ++i) set_points.push_back({kBegin + i * 10'000'000, SetPoint()});
  Trajectory trajectory = toTrajectory(set_points, kBegin);
  change(trajectory);
  return test::refusal([&] { toSetPoints(trajectory, kBegin); });
}

TEST(Conversions, RefuseATrajectoryByThePointAndWhatIsWrongWithIt) {
  EXPECT_EQ(refusalOf([](Trajectory&) {}), "");
  EXPECT_EQ(refusalOf([](Trajectory& t) { t.points.clear(); }), "the trajectory has no points");
  EXPECT_EQ(refusalOf([](Trajectory& t) { t.points[1].transforms.clear(); }),
            "set point 1 has no transform");
  EXPECT_EQ(refusalOf([](Trajectory& t) { t.points[2].transforms[0].rotation.w = 0.5; }),
            "set point 2 has no unit quaternion");
  EXPECT_EQ(refusalOf([](Trajectory& t) { t.points[0].transforms[0].rotation.x = kNan; }),
            "set point 0 has no unit quaternion");
  EXPECT_EQ(refusalOf([](Trajectory& t) { t.points[1].velocities[0].linear.y = kNan; }),
            "set point 1 has a number that is not finite");
  EXPECT_EQ(refusalOf([](Trajectory& t) { t.points[2].time_from_start = ros::Duration(0.001); }),
            "set point 2 is earlier than the one before");
  EXPECT_EQ(refusalOf([](Trajectory& t) { t.points[1].accelerations[0].linear.x = 1e308; }),
            "set point 0 has an acceleration too far from the next one's");
}

TEST(Conversions, CarryWhatTheLawAdaptsWithItsUnits) {
  const std::vector<AdaptiveQuantity> quantities = {{"K_p0", "N"}, {"switches", ""}, {"rho", "m"}};
  msgs::ControllerState message;
  message.adaptive_names = message.adaptive_units = {"of another law"};
  fill(quantities, message);
  EXPECT_EQ(message.adaptive_names, (std::vector<std::string>{"K_p0", "switches", "rho"}));
  EXPECT_EQ(message.adaptive_units, (std::vector<std::string>{"N", "", "m"}));
  EXPECT_EQ(toQuantities(message), quantities);
  message.adaptive_units = {"N"};
  EXPECT_EQ(toQuantities(message),
            (std::vector<AdaptiveQuantity>{{"K_p0", "N"}, {"switches", ""}, {"rho", ""}}));
}

TEST(Conversions, RefuseAPoseByTheNameThatItsUserGives) {
  geometry_msgs::Pose pose;
  const auto refusal = [&pose] {
    return test::refusal([&] { toSetPoint(pose, "pose 3 of the path"); });
  };
  EXPECT_EQ(refusal(), "pose 3 of the path has no unit quaternion");
  pose.orientation = toQuaternion(yawRotation(0.5));
  pose.position = toPoint({1.0, 2.0, 3.0});
  const SetPoint set_point = toSetPoint(pose);
  EXPECT_EQ(set_point.position, Eigen::Vector3d(1.0, 2.0, 3.0));
  EXPECT_NEAR(set_point.yaw, 0.5, 1e-12);
  pose.position.x = kNan;
  EXPECT_EQ(refusal(), "pose 3 of the path has a number that is not finite");
}

}  // namespace
}  // namespace aqc
