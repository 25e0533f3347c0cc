#pragma once

#include <ros/message_traits.h>
#include <ros/serialization.h>
#include <trajectory_msgs/MultiDOFJointTrajectory.h>

#include <boost/shared_ptr.hpp>
#include <cstdint>
#include <string>

// roscpp makes room for as many elements as a message declares before it looks whether they are
// there: 24 bytes can ask for gigabytes, and hold the thread that reads them for seconds.

namespace aqc {

/// The most points, and the most names, of a trajectory. The longest shipped mission has 30 001,
/// and 50 000 are 500 s at 100 Hz. To read and convert those holds the control thread for 17 ms at
/// 2.9 GHz, half of the delay with which asmc loses the vehicle in a step of 2 m.
constexpr std::uint32_t kMostTrajectoryPoints = 50'000;

/// The most bytes of a trajectory: twice those of so many points with one joint.
constexpr std::uint32_t kMostTrajectoryBytes = 16u << 20u;

/// Why a serialised trajectory_msgs/MultiDOFJointTrajectory of `size` bytes must not be
/// deserialised: it is too large, has too many points or names, or declares more than there is. The
/// words name the list, its length and what is allowed; empty means fine. Takes no memory for
/// what is declared.
std::string lengthRefusal(const std::uint8_t* bytes, std::uint32_t size);

/// What to subscribe to in place of the message: `trajectory` is empty when `refusal` is not.
struct BoundedTrajectory {
  using ConstPtr = boost::shared_ptr<const BoundedTrajectory>;

  trajectory_msgs::MultiDOFJointTrajectory trajectory;
  std::string refusal;  // of lengthRefusal()
};

}  // namespace aqc

namespace ros {
namespace message_traits {

template <>
struct MD5Sum<aqc::BoundedTrajectory> : MD5Sum<trajectory_msgs::MultiDOFJointTrajectory> {};
template <>
struct DataType<aqc::BoundedTrajectory> : DataType<trajectory_msgs::MultiDOFJointTrajectory> {};
template <>
struct Definition<aqc::BoundedTrajectory> : Definition<trajectory_msgs::MultiDOFJointTrajectory> {};

}  // namespace message_traits

namespace serialization {

template <>
struct Serializer<aqc::BoundedTrajectory> {
  template <class Stream>
  static void read(Stream& stream, aqc::BoundedTrajectory& message) {
    message.refusal = aqc::lengthRefusal(stream.getData(), stream.getLength());
    if (message.refusal.empty()) stream.next(message.trajectory);
  }
};

}  // namespace serialization
}  // namespace ros
