#pragma once

#include <ros/ros.h>
#include <std_srvs/Trigger.h>
#include <tf2_ros/transform_broadcaster.h>

#include <memory>
#include <optional>

#include "adaptive_quadrotor_control/Actuators.h"
#include "adaptive_quadrotor_control/simulation/pacer.h"
#include "adaptive_quadrotor_control/simulation/scenario.h"
#include "adaptive_quadrotor_control/simulation/sensor_channels.h"
#include "adaptive_quadrotor_control/simulation/timed_plant.h"
#include "ros/border/conversions.h"
#include "ros/border/plant_services.h"

namespace aqc {

/// The simulated vehicle in ROS: a shell around TimedPlant.
///
/// In: `command/motor_speed`. Out: `odometry`, `imu`, `~status`, tf world -> base_link -> payload
/// and, with /use_sim_time, `/clock`. Services: `~attach_payload`, `~detach_payload`, `~set_wind`,
/// `~set_body`, `~apply_disturbance`, `~set_rotor`, `~set_battery`, `~set_gust`, `~lose_commands`,
/// `~reset`,
/// `~resume`. Parameters: `vehicle`, `scenario` (start, rates), `~lock_step`, `~real_time_factor`,
/// `~start_paused`, `~command_timeout`.
///
/// After `~command_timeout` seconds without a motor command (0: never) the rotors are commanded 0,
/// as motor drivers do: 0.25 s, or two control periods if that is longer. In lock step it is 0 when
/// not given. A scenario's own (World::command_timeout) is the default where there is one.
///
/// In lock step the clock stands still until the command that answers the last odometry (the same
/// stamp) has come: a flight is then as fast as the machine allows and the same every time.
/// In a world with `sensors` odometry and IMU come as their channels have it, seeded as offline. In
/// lock step a command must then answer the odometry that came last; time goes on where none came,
/// and where none is answered for Pacer::kRepeatAfter, since a controller refuses some.
/// While paused, odometry of one period before the start is repeated, so that everybody connects
/// without anything beginning.
class PlantNode {
 public:
  /// Throws ParameterError.
  PlantNode();

 private:
  void onCommand(const msgs::Actuators::ConstPtr& message);
  void onSteadyTimer(const ros::SteadyTimerEvent& event);
  bool onReset(std_srvs::Trigger::Request& request, std_srvs::Trigger::Response& response);
  bool onResume(std_srvs::Trigger::Request& request, std_srvs::Trigger::Response& response);

  void restart(Nanoseconds start);
  void advance();
  void advanceToAnswer();
  void publish();
  void listen();
  void publishImu(const ImuMessage& message);
  void publishOdometry(const OdometryMessage& message);
  void publishTransforms(const ros::Time& stamp);
  void publishTruth(const ros::Time& stamp);
  // The service that plans what happens to the plant.
  template <class Action>
  ros::ServiceServer serve();
  // The action that a request asks for; throws with the reason when it may not be.
  AttachPayload requested(const msgs::AttachPayload::Request& request) const;
  template <class Request>
  auto requested(const Request& request) const;

  ros::NodeHandle node_;
  ros::NodeHandle private_node_{"~"};
  Vehicle vehicle_;
  World world_;
  bool simulated_time_;
  std::optional<Pacer> pacer_;  // set by the constructor
  std::unique_ptr<TimedPlant> plant_;
  std::optional<SensorChannels> channels_;  // of a world with `sensors`
  Nanoseconds told_ = 0;                    // the stamp of the odometry that was published last
  bool tells_ = false;                      // odometry was published since the last advance()
  Nanoseconds command_timeout_;             // 0: none
  bool was_silent_ = false;                 // there was one when it was looked at last

  ros::Publisher odometry_publisher_;
  ros::Publisher imu_publisher_;
  ros::Publisher clock_publisher_;
  ros::Publisher status_publisher_;
  tf2_ros::TransformBroadcaster transforms_;
  ros::Time transform_stamp_;  // last sent
  ros::Subscriber command_subscriber_;
  std::vector<ros::ServiceServer> services_;
  ros::SteadyTimer timer_;
};

}  // namespace aqc
