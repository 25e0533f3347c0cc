#include <geometry_msgs/PoseStamped.h>
#include <gtest/gtest.h>
#include <nav_msgs/Odometry.h>
#include <ros/serialization.h>
#include <sensor_msgs/Imu.h>

#include <string>

#include "fuzz/mutation.h"
#include "fuzz/targets.h"
#include "ros/border/conversions.h"

// Messages whose bytes were changed on the way: fuzz/wire_flight.cpp without a fuzzer.
namespace aqc {
namespace {

constexpr std::uint64_t kMutations = 3000;  // of each message

template <typename Message>
std::string onTheWire(char kind, const Message& message) {
  std::string bytes(1 + ros::serialization::serializationLength(message), kind);
  ros::serialization::OStream stream(reinterpret_cast<std::uint8_t*>(bytes.data() + 1),
                                     static_cast<std::uint32_t>(bytes.size() - 1));
  ros::serialization::serialize(stream, message);
  return bytes;
}

void expectNothing(const std::string& bytes) {
  ASSERT_EQ(fuzz::hearWire(bytes), "");
  for (std::uint64_t seed = 0; seed < kMutations; ++seed) {
    const std::string changed = fuzz::mutatedBytes(bytes, seed);
    ASSERT_EQ(fuzz::hearWire(changed), "") << "seed " << seed;
  }
}

TEST(Wire, FindsNothingInOdometry) {
  State state;
  state.position.z() = 2.0;
  expectNothing(onTheWire(0, toOdometry(state, 1'000'040'000'000)));
}

TEST(Wire, FindsNothingInImuSamples) {
  sensor_msgs::Imu sample;
  sample.header.stamp = toRosTime(1'000'040'000'000);
  sample.linear_acceleration.z = kGravity;
  expectNothing(onTheWire(1, sample));
}

TEST(Wire, FindsNothingInPoses) {
  geometry_msgs::PoseStamped pose;
  pose.header.frame_id = "world";
  pose.pose.position.z = 2.5;
  pose.pose.orientation.w = 1.0;
  expectNothing(onTheWire(2, pose));
}

TEST(Wire, FindsNothingInTrajectories) {
  std::vector<TimedSetPoint> points(5);
  for (std::size_t i = 0; i < points.size(); ++i) {
    points[i].time = static_cast<Nanoseconds>(i) * 8'000'000;
    points[i].set_point.position.z() = 2.0 + 0.1 * static_cast<double>(i);
    points[i].set_point.acceleration.x() = 0.1 * static_cast<double>(i);
  }
  expectNothing(onTheWire(3, toTrajectory(points, 0)));
}

}  // namespace
}  // namespace aqc
