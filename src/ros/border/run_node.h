#pragma once

#include <ros/ros.h>

#include <cstdio>
#include <exception>
#include <functional>
#include <stdexcept>
#include <string>

namespace aqc {

/// The main function of a ROS node: runs `body` and returns its exit code. Says in one line and
/// returns 1 when there is no ROS master (a ROS node would otherwise wait for ever) or when the
/// body throws.
inline int runNode(int argc, char** argv, const std::string& name,
                   const std::function<int()>& body) {
  ros::init(argc, argv, name);
  try {
    if (!ros::master::check()) {
      throw std::runtime_error("no ROS master at " + ros::master::getURI() +
                               "; start roscore first, or use roslaunch");
    }
    return body();
  } catch (const std::exception& error) {
    // Not ROS_FATAL: ROS logging ends with the last node handle, which the exception destroyed.
    std::fprintf(stderr, "[FATAL] %s: %s\n", ros::this_node::getName().c_str(), error.what());
    return 1;
  }
}

/// The main function of a node that lives in its callbacks.
template <class Node>
int spinNode(int argc, char** argv, const std::string& name) {
  return runNode(argc, argv, name, [] {
    Node node;
    ros::spin();
    return 0;
  });
}

}  // namespace aqc
