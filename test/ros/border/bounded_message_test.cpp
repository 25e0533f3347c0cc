#include "ros/border/bounded_message.h"

#include <gtest/gtest.h>

#include <random>
#include <vector>

namespace aqc {
namespace {

using Bytes = std::vector<std::uint8_t>;
using Trajectory = trajectory_msgs::MultiDOFJointTrajectory;

constexpr std::size_t kNamesAt = 16;  // behind seq, stamp and an empty frame_id

Bytes bytesOf(const Trajectory& trajectory) {
  Bytes bytes(ros::serialization::serializationLength(trajectory));
  ros::serialization::OStream stream(bytes.data(), static_cast<std::uint32_t>(bytes.size()));
  ros::serialization::serialize(stream, trajectory);
  return bytes;
}

Trajectory trajectoryOf(std::size_t points) {
  Trajectory trajectory;
  trajectory.points.resize(points);
  for (auto& point : trajectory.points) {
    point.transforms.resize(1);
    point.velocities.resize(1);
    point.accelerations.resize(1);
  }
  return trajectory;
}

void declare(std::uint32_t count, std::size_t at, Bytes& bytes) {
  for (std::size_t i = 0; i < 4; ++i) bytes.at(at + i) = static_cast<std::uint8_t>(count >> 8 * i);
}

BoundedTrajectory heard(Bytes& bytes) {
  BoundedTrajectory message;
  ros::serialization::IStream stream(bytes.data(), static_cast<std::uint32_t>(bytes.size()));
  ros::serialization::deserialize(stream, message);
  return message;
}

TEST(BoundedMessage, HearsAnHonestTrajectoryAsItWasSent) {
  Trajectory sent = trajectoryOf(3);
  sent.header.frame_id = "world";
  sent.joint_names = {"base_link", ""};
  sent.points[1].transforms.resize(2);
  sent.points[2].velocities.clear();
  sent.points[2].time_from_start = ros::Duration(1.5);
  Bytes bytes = bytesOf(sent);
  const BoundedTrajectory message = heard(bytes);
  EXPECT_EQ(message.refusal, "");
  EXPECT_EQ(bytesOf(message.trajectory), bytes);
  EXPECT_STREQ(ros::message_traits::md5sum<BoundedTrajectory>(),
               ros::message_traits::md5sum<Trajectory>());
}

TEST(BoundedMessage, RefusesMoreThanIsThereByTheList) {
  const Bytes honest = bytesOf(trajectoryOf(1));
  const auto refusal = [&](std::uint32_t count, std::size_t at) {
    Bytes bytes = honest;
    declare(count, at, bytes);
    const BoundedTrajectory message = heard(bytes);
    EXPECT_TRUE(message.trajectory.points.empty());
    return message.refusal;
  };
  const std::size_t points = kNamesAt + 4;
  EXPECT_EQ(refusal(4'000'000'000, kNamesAt - 4),
            "it declares 4000000000 characters of frame_id; the 180 bytes left hold at most 180");
  EXPECT_EQ(refusal(20'000, kNamesAt),
            "it declares 20000 joint names; the 176 bytes left hold at most 44");
  EXPECT_EQ(refusal(20'000'000, points), "it declares 20000000 points; at most 50000 are allowed");
  EXPECT_EQ(refusal(9, points), "it declares 9 points; the 172 bytes left hold at most 8");
  EXPECT_EQ(refusal(4, points + 4),
            "it declares 4 transforms of a point; the 168 bytes left hold at most 3");
  EXPECT_EQ(refusal(3, points + 64),
            "it declares 3 velocities of a point; the 108 bytes left hold at most 2");
  EXPECT_EQ(refusal(UINT32_MAX, points + 116),
            "it declares 4294967295 accelerations of a point; the 56 bytes left hold at most 1");
}

TEST(BoundedMessage, RefusesAMessageCutAnywhere) {
  const Bytes honest = bytesOf(trajectoryOf(2));
  for (std::size_t size = 0; size < honest.size(); ++size) {
    Bytes cut(honest.begin(), honest.begin() + static_cast<std::ptrdiff_t>(size));
    cut.shrink_to_fit();  // a sanitizer sees a read behind it
    EXPECT_NE(lengthRefusal(cut.data(), static_cast<std::uint32_t>(size)), "") << size;
  }
}

TEST(BoundedMessage, TakesNoMoreThanTheLimits) {
  Bytes most = bytesOf(trajectoryOf(kMostTrajectoryPoints));
  EXPECT_EQ(heard(most).refusal, "");
  Bytes more = bytesOf(trajectoryOf(kMostTrajectoryPoints + 1));
  EXPECT_EQ(heard(more).refusal, "it declares 50001 points; at most 50000 are allowed");
  Trajectory names;
  names.joint_names.resize(kMostTrajectoryPoints + 1);
  more = bytesOf(names);
  EXPECT_EQ(heard(more).refusal, "it declares 50001 joint names; at most 50000 are allowed");
  Trajectory large = trajectoryOf(1);
  large.points[0].transforms.resize(kMostTrajectoryBytes / 56);
  more = bytesOf(large);
  EXPECT_NE(heard(more).refusal.find("bytes; at most 16777216 are allowed"), std::string::npos);
}

// What passes can be deserialised, whatever was spoilt.
TEST(BoundedMessage, NeverLetsRoscppOverrun) {
  const Bytes honest = bytesOf(trajectoryOf(4));
  std::mt19937 random(7);
  int passed = 0;
  for (int i = 0; i < 20'000; ++i) {
    Bytes bytes = honest;
    for (int change = 0; change < 2; ++change) {
      bytes[random() % bytes.size()] = static_cast<std::uint8_t>(random());
    }
    ASSERT_NO_THROW(passed += heard(bytes).refusal.empty());
  }
  EXPECT_GT(passed, 1'000);
}

}  // namespace
}  // namespace aqc
