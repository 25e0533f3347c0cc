#pragma once

#include <ros/ros.h>

#include <atomic>
#include <string>
#include <thread>

namespace aqc {

/// Remembers on the master, as the parameter `~was_armed`, whether a controller is armed, so that
/// one that is started again after its death in the air knows that it must take over.
///
/// The master may be slow or gone: a thread of its own talks to it, the control thread only writes
/// a flag.
class ArmedRecord {
 public:
  explicit ArmedRecord(const ros::NodeHandle& private_node);
  ~ArmedRecord();
  ArmedRecord(const ArmedRecord&) = delete;
  ArmedRecord& operator=(const ArmedRecord&) = delete;

  /// As it was left by who wrote it last; read at the start.
  bool wasArmed() const noexcept { return was_armed_; }
  void armed(bool is_armed) noexcept { armed_ = is_armed; }

 private:
  void keep();

  std::string name_;
  bool was_armed_ = false;
  std::atomic<bool> armed_{false};
  std::atomic<bool> over_{false};
  std::thread thread_;
};

}  // namespace aqc
