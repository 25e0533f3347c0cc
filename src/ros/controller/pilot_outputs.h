#pragma once

#include <ros/ros.h>

#include <string>
#include <vector>

#include "adaptive_quadrotor_control/pilot/pilot.h"

namespace aqc {

/// What a pilot decides, to the world: `command/motor_speed`, `~state`, and the log where something
/// changed.
class PilotOutputs {
 public:
  /// Advertises. `pilot` outlives this.
  PilotOutputs(ros::NodeHandle& node, ros::NodeHandle& private_node, const Pilot& pilot);

  /// Publishes what is due after something was heard; kNothing does nothing.
  void publish(Publish what);
  /// To be told of before the law is changed: names and units of what the new one adapts.
  void swapQuantities(std::vector<AdaptiveQuantity>& quantities) { quantities_.swap(quantities); }

 private:
  void publishState();
  void tellOfMode();
  void tellOfSwitches() const;
  void tellOfImu();

  const Pilot& pilot_;
  std::vector<AdaptiveQuantity> quantities_;
  Mode told_mode_ = Mode::kDisarmed;
  bool imu_was_usable_ = false;
  std::string imu_topic_;
  ros::Publisher motor_publisher_;
  ros::Publisher state_publisher_;
};

}  // namespace aqc
