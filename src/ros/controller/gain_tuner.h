#pragma once

#include <ros/callback_queue.h>
#include <ros/node_handle.h>
#include <ros/spinner.h>
#include <std_srvs/Trigger.h>
#include <yaml-cpp/yaml.h>

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "adaptive_quadrotor_control/law/control_law.h"
#include "adaptive_quadrotor_control/model/vehicle.h"
#include "adaptive_quadrotor_control/parameters/schema.h"
#include "ros/controller/tuning_server.h"

namespace aqc {

/// A law that is ready to fly.
struct PreparedLaw {
  std::vector<AdaptiveQuantity> adaptive_quantities;
  Schema schema;  ///< of its gains, without the choice of the law
  std::unique_ptr<ControlLaw> law;
};

/// Changes gains, or the whole law, of a controller that flies.
///
/// Two ways, both in the namespace of the controller: dynamic_reconfigure in `~tuning`, with every
/// gain that the law that flies has declared to its reader; and `rosparam set` below `~gains`
/// followed by the service `~reload_parameters`. Either way the whole set is read and validated and
/// the new law built in a thread of their own; the control thread only swaps pointers between two
/// steps. A set is applied whole or refused whole, and the reason is told. Afterwards both ways
/// show the same numbers.
/// What flies, with the vehicle, is published on `~parameters` as YAML (latched) for recordings.
class GainTuner {
 public:
  /// Runs in the control thread between two steps: puts the law in (and the old one in its place)
  /// or says why not.
  using Swap = std::function<std::string(PreparedLaw&)>;

  /// `node` is the controller's private handle; `vehicle` and `gains` are the trees of what flies
  /// now. `control` is the queue that the control thread serves.
  GainTuner(const ros::NodeHandle& node, const YAML::Node& vehicle, const YAML::Node& gains,
            ros::CallbackQueueInterface& control, Swap swap);
  ~GainTuner();

 private:
  bool onReload(std_srvs::Trigger::Request& request, std_srvs::Trigger::Response& response);
  std::string tune(const dynamic_reconfigure::Config& wanted);
  std::unique_ptr<PreparedLaw> prepare(const YAML::Node& gains) const;
  std::string apply(const YAML::Node& gains);
  std::string swapInControlThread(std::unique_ptr<PreparedLaw> law);
  void publish();

  ros::CallbackQueue queue_;  // of the thread that reads, validates and builds
  ros::NodeHandle node_;
  YAML::Node vehicle_tree_;
  Vehicle vehicle_;
  YAML::Node gains_;  // what flies
  Schema schema_;     // of these
  ros::CallbackQueueInterface& control_;
  Swap swap_;
  TuningServer server_;
  ros::Publisher publisher_;
  ros::ServiceServer service_;
  ros::AsyncSpinner spinner_;
};

}  // namespace aqc
