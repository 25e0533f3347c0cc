#pragma once

#include <tf2_ros/buffer.h>
#include <tf2_ros/transform_listener.h>

#include <Eigen/Geometry>
#include <optional>
#include <string>

#include "ros/border/names.h"

namespace aqc {

/// The frames that a controller is told of. What speaks of others than its world and its body is
/// brought into these by the latest transform of tf2, or refused where tf2 knows none.
///
/// A transform that is not static and older than `kOldest` is not used: whoever published it may be
/// dead. tf2 is heard by a thread of its own; its buffer is locked only for messages of other
/// frames, and nothing waits for a transform to come.
class Frames {
 public:
  static constexpr double kOldest = 1.0;  ///< [s] of ROS time

  struct Names {
    std::string world = kWorldFrame;
    std::string body = kBodyFrame;
  };
  explicit Frames(const Names& names) : names_(names), listener_(buffer_) {}

  /// True of an empty name, too: many publishers say none.
  bool isWorld(const std::string& frame) const { return frame.empty() || frame == names_.world; }
  bool isBody(const std::string& frame) const { return frame.empty() || frame == names_.body; }

  /// What brings points of `frame` into the world; identity of the world itself. Nothing when it is
  /// not known: see why().
  std::optional<Eigen::Isometry3d> toWorld(const std::string& frame);
  /// What brings points of the body into `frame`, which is fixed to it.
  std::optional<Eigen::Isometry3d> bodyIn(const std::string& frame);
  /// Why there was no transform last time, with the frames' names.
  const std::string& why() const noexcept { return why_; }

 private:
  std::optional<Eigen::Isometry3d> transform(const std::string& target, const std::string& source);

  Names names_;
  tf2_ros::Buffer buffer_;
  tf2_ros::TransformListener listener_;
  std::string why_;
};

}  // namespace aqc
