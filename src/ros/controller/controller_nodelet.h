#pragma once

#include <geometry_msgs/PoseStamped.h>
#include <nav_msgs/Odometry.h>
#include <nodelet/nodelet.h>
#include <ros/ros.h>
#include <sensor_msgs/Imu.h>

#include <memory>
#include <string>
#include <vector>

#include "adaptive_quadrotor_control/ActiveSubsystem.h"
#include "adaptive_quadrotor_control/pilot/pilot.h"
#include "ros/border/bounded_message.h"
#include "ros/border/conversions.h"
#include "ros/controller/armed_record.h"
#include "ros/controller/flight_diagnostics.h"
#include "ros/controller/gain_tuner.h"
#include "ros/controller/guard_services.h"

namespace aqc {

/// A Pilot in ROS: messages go in, rotor speeds come out.
///
/// In: `odometry`, `command/trajectory`, `command/pose`; `imu` and `active_subsystem` for laws that
/// use them. Out: `command/motor_speed`, `~state`.
/// With a guard (the default; `~guarded: false` flies without) also its services: see
/// GuardServices. Parameters: `vehicle` (see config/vehicle), `~gains` (see config/controller),
/// `~rate` [Hz] (default 250), `~trigger`, `~limits` (see PilotLimits; default: none), `~guard`
/// (see GuardLimits), `~world_frame` and
/// `~body_frame` (default `world`, `base_link`). All callbacks come from
/// one queue in one thread, so nothing is locked. Gains and law may change in flight: see GainTuner
/// and HandoverLimits.
///
/// `~trigger: timer` runs the law at `~rate` by ROS time on the latest odometry; `odometry` runs
/// it when odometry that is due arrives and answers every odometry, which a lock-stepped
/// simulation needs; a law that uses the IMU then waits for its sample of the same stamp, unless
/// it has fallen silent or odometry comes again first. Before the first good odometry and the first
/// set point only zero speeds are published. A set point that came before the first odometry of a
/// clock that was started anew is of the old time.
class ControllerNodelet : public nodelet::Nodelet {
 private:
  void onInit() override;
  void configure();
  void connect();
  void connectLaw();

  void onOdometry(const nav_msgs::Odometry::ConstPtr& message);
  void onImu(const sensor_msgs::Imu::ConstPtr& message);
  void onTrajectory(const BoundedTrajectory::ConstPtr& message);
  void onPose(const geometry_msgs::PoseStamped::ConstPtr& message);
  void onOrder(const msgs::ActiveSubsystem::ConstPtr& message);

  template <class ToSetPoints>
  void plan(const char* what, const ros::Time& stamp, ToSetPoints to_set_points);
  std::string swapLaw(PreparedLaw& prepared);
  void act(Publish publish);
  void tellOfSwitches() const;
  void tellOfImu();
  void publishState();
  void onTimer();
  bool foreign(const std::string& said, const std::string& frame) const;

  std::unique_ptr<Pilot> pilot_;
  std::vector<AdaptiveQuantity> adaptive_quantities_;  // of its law
  bool imu_was_usable_ = false;

  ros::Subscriber odometry_subscriber_;
  ros::Subscriber trajectory_subscriber_;
  ros::Subscriber pose_subscriber_;
  ros::Subscriber imu_subscriber_;    // null: the law uses none
  ros::Subscriber order_subscriber_;  // null: the law has no subsystems
  ros::Publisher motor_publisher_;
  ros::Publisher state_publisher_;
  ros::Timer timer_;               // of a simulated clock
  ros::SteadyTimer steady_timer_;  // of a real one, which may step
  std::unique_ptr<ArmedRecord> armed_record_;
  std::unique_ptr<GuardServices> guard_services_;
  std::string world_frame_;
  std::string body_frame_;
  Mode told_mode_ = Mode::kDisarmed;
  std::unique_ptr<FlightDiagnostics> diagnostics_;
  std::unique_ptr<GainTuner> tuner_;
};

}  // namespace aqc
