#pragma once

#include <visualization_msgs/Marker.h>

#include <Eigen/Core>
#include <string>

#include "ros/border/conversions.h"

// Pieces that markers are made of.

namespace aqc {

inline std_msgs::ColorRGBA colour(double r, double g, double b, double a = 1.0) {
  std_msgs::ColorRGBA rgba;
  rgba.r = static_cast<float>(r);
  rgba.g = static_cast<float>(g);
  rgba.b = static_cast<float>(b);
  rgba.a = static_cast<float>(a);
  return rgba;
}

/// Stamp zero: rviz uses the latest transform, so that no marker waits for one.
inline visualization_msgs::Marker marker(const char* frame, const char* ns, int id, int type,
                                         const std_msgs::ColorRGBA& rgba) {
  visualization_msgs::Marker m;
  m.header.frame_id = frame;
  m.ns = ns;
  m.id = id;
  m.type = type;
  m.action = visualization_msgs::Marker::ADD;
  m.pose.orientation.w = 1.0;
  m.scale.x = m.scale.y = m.scale.z = 1.0;
  m.color = rgba;
  m.frame_locked = frame == kBodyFrame;
  return m;
}

inline visualization_msgs::Marker boxMarker(const char* frame, const char* ns, int id,
                                            const Eigen::Vector3d& centre,
                                            const Eigen::Vector3d& size,
                                            const std_msgs::ColorRGBA& rgba) {
  visualization_msgs::Marker m = marker(frame, ns, id, visualization_msgs::Marker::CUBE, rgba);
  m.pose.position = toPoint(centre);
  m.scale = toVector3(size);
  return m;
}

/// An arrow of a shaft `width` thick [m].
inline visualization_msgs::Marker arrowMarker(const char* frame, const char* ns, int id,
                                              const Eigen::Vector3d& from,
                                              const Eigen::Vector3d& to, double width,
                                              const std_msgs::ColorRGBA& rgba) {
  visualization_msgs::Marker m = marker(frame, ns, id, visualization_msgs::Marker::ARROW, rgba);
  m.points = {toPoint(from), toPoint(to)};
  m.scale.x = width;
  m.scale.y = 2.5 * width;
  m.scale.z = 0.0;  // rviz's own share of the length
  return m;
}

inline visualization_msgs::Marker lineMarker(const char* frame, const char* ns, int id, int type,
                                             double width, const std_msgs::ColorRGBA& rgba) {
  visualization_msgs::Marker m = marker(frame, ns, id, type, rgba);
  m.scale.x = width;
  m.scale.y = m.scale.z = 0.0;
  return m;
}

}  // namespace aqc
