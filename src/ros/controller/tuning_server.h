#pragma once

#include <dynamic_reconfigure/Config.h>
#include <dynamic_reconfigure/ConfigDescription.h>
#include <dynamic_reconfigure/Reconfigure.h>
#include <ros/node_handle.h>

#include <functional>
#include <string>

#include "adaptive_quadrotor_control/parameters/schema.h"

namespace aqc {

/// Speaks dynamic_reconfigure's protocol for whatever a schema holds, so that its clients need no
/// generated code: service `set_parameters`, latched topics `parameter_descriptions` and
/// `parameter_updates`. Unlike dynamic_reconfigure's own server it clamps nothing and keeps no
/// parameters: a set is taken whole or not at all. Not for several threads at once.
class TuningServer {
 public:
  /// Takes what a client wants and calls show() with what there is then; says why not if it was
  /// refused.
  using Take = std::function<std::string(const dynamic_reconfigure::Config& wanted)>;

  /// Serves in the namespace and the queue of `node`.
  TuningServer(const ros::NodeHandle& node, Take take);

  /// Tells the clients that these are the parameters and values now.
  void show(const Schema& schema);

 private:
  bool onSet(dynamic_reconfigure::Reconfigure::Request& request,
             dynamic_reconfigure::Reconfigure::Response& response);

  ros::NodeHandle node_;
  Take take_;
  dynamic_reconfigure::ConfigDescription description_;  // as it was published last
  dynamic_reconfigure::Config values_;
  ros::Publisher descriptions_;
  ros::Publisher updates_;
  ros::ServiceServer service_;
};

}  // namespace aqc
