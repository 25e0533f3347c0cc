#include "ros/border/bounded_message.h"

#include <stdexcept>

namespace aqc {
namespace {

constexpr std::uint32_t kCountBytes = 4;
constexpr std::uint32_t kStampBytes = 8;  // a ros::Time, or a ros::Duration
constexpr std::uint32_t kTransformBytes = 7 * 8;
constexpr std::uint32_t kTwistBytes = 6 * 8;
constexpr std::uint32_t kLeastPointBytes = 3 * kCountBytes + kStampBytes;

// Walks over serialised lists without reading them. Throws std::length_error.
class Walk {
 public:
  Walk(const std::uint8_t* bytes, std::uint32_t size) : bytes_(bytes), left_(size) {}

  void skip(const char* what, std::uint32_t size) {
    if (size > left_) {
      throw std::length_error(std::string("the message ends within its ") + what);
    }
    bytes_ += size;
    left_ -= size;
  }

  // The length of a list whose elements take `each` bytes or more; at most `most`.
  std::uint32_t count(const char* what, std::uint32_t each, std::uint32_t most = UINT32_MAX) {
    const std::uint8_t* low = bytes_;
    skip(what, kCountBytes);
    std::uint32_t declared = 0;
    for (int i = 3; i >= 0; --i) declared = (declared << 8u) | low[i];  // little-endian on the wire
    if (declared > most) refuse(declared, what, "at most " + std::to_string(most) + " are allowed");
    if (declared > left_ / each) {
      refuse(declared, what,
             "the " + std::to_string(left_) + " bytes left hold at most " +
                 std::to_string(left_ / each));
    }
    return declared;
  }

  // A list whose elements take `each` bytes.
  void skipList(const char* what, std::uint32_t each) { skip(what, count(what, each) * each); }

 private:
  [[noreturn]] static void refuse(std::uint32_t declared, const char* what,
                                  const std::string& allowed) {
    throw std::length_error("it declares " + std::to_string(declared) + " " + what + "; " +
                            allowed);
  }

  const std::uint8_t* bytes_;
  std::uint32_t left_;
};

void walkTrajectory(Walk walk) {
  walk.skip("header", 4 + kStampBytes);
  walk.skipList("characters of frame_id", 1);
  const std::uint32_t names = walk.count("joint names", kCountBytes, kMostTrajectoryPoints);
  for (std::uint32_t i = 0; i < names; ++i) walk.skipList("characters of a joint name", 1);
  const std::uint32_t points = walk.count("points", kLeastPointBytes, kMostTrajectoryPoints);
  for (std::uint32_t i = 0; i < points; ++i) {
    walk.skipList("transforms of a point", kTransformBytes);
    walk.skipList("velocities of a point", kTwistBytes);
    walk.skipList("accelerations of a point", kTwistBytes);
    walk.skip("times", kStampBytes);
  }
}

}  // namespace

std::string lengthRefusal(const std::uint8_t* bytes, std::uint32_t size) {
  if (size > kMostTrajectoryBytes) {
    return "it has " + std::to_string(size) + " bytes; at most " +
           std::to_string(kMostTrajectoryBytes) + " are allowed";
  }
  try {
    walkTrajectory(Walk(bytes, size));
  } catch (const std::length_error& error) {
    return error.what();
  }
  return "";
}

}  // namespace aqc
