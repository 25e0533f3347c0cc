#pragma once

#include <ros/node_handle.h>
#include <ros/service.h>

#include <stdexcept>
#include <string>

namespace aqc {

/// Calls a service whose response has `success` and `message`, and which is waited for during
/// `patience` of wall time. Throws std::runtime_error, which names the service, when it does not
/// show up or not answer and, with the reason, when it refuses.
template <class Service>
void callService(const ros::NodeHandle& node, const std::string& name, ros::WallDuration patience,
                 Service& service) {
  const std::string full = node.resolveName(name);
  // Not ros::service::waitForService(), whose patience is of the ROS clock: that may stand still.
  const ros::SteadyTime deadline = ros::SteadyTime::now() + patience;
  while (ros::ok() && !ros::service::exists(full, false) && ros::SteadyTime::now() < deadline) {
    ros::WallDuration(0.02).sleep();
  }
  if (!ros::service::call(full, service)) {
    throw std::runtime_error("service '" + full + "' does not answer");
  }
  if (!service.response.success) {
    throw std::runtime_error("service '" + full + "' refused: " + service.response.message);
  }
}

}  // namespace aqc
