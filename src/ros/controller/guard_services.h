#pragma once

#include <ros/ros.h>

#include <vector>

#include "adaptive_quadrotor_control/pilot/pilot.h"

namespace aqc {

/// The operator's orders to a guarded pilot as services below `~`: arm, disarm, take_off, land,
/// hold, release, kill (std_srvs/Trigger) and go_to (GoTo). An answer without success says why.
class GuardServices {
 public:
  /// `pilot` has a guard and outlives this; the services are called in the queue of `node`.
  GuardServices(ros::NodeHandle node, Pilot& pilot);

 private:
  std::vector<ros::ServiceServer> services_;
};

}  // namespace aqc
