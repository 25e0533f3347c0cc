#pragma once

#include <geometry_msgs/PoseStamped.h>
#include <nav_msgs/Odometry.h>
#include <ros/ros.h>
#include <sensor_msgs/Imu.h>

#include <functional>
#include <memory>
#include <string>

#include "adaptive_quadrotor_control/ActiveSubsystem.h"
#include "adaptive_quadrotor_control/pilot/pilot.h"
#include "ros/border/bounded_message.h"
#include "ros/border/conversions.h"
#include "ros/controller/frames.h"
#include "ros/controller/sole_source.h"

namespace aqc {

/// The topics that a pilot hears: `odometry`, `command/trajectory`, `command/pose`; `imu` and
/// `active_subsystem` for laws that use them, `imu` for every guarded pilot.
///
/// With a guard it also looks where messages come from: odometry of one publisher (see SoleSource)
/// and what speaks of other frames through tf2 (see Frames). A message that is refused is counted
/// and told in the log, once a second at most.
class PilotInputs {
 public:
  struct Reactions {
    std::function<void(Publish)> act;          ///< what is to be published after a message
    std::function<void()> odometry_was_heard;  ///< it was accepted
  };
  /// `pilot` outlives this; callbacks come from the queue of `node`. `source_patience` [ns] is that
  /// of SoleSource.
  PilotInputs(const ros::NodeHandle& node, Pilot& pilot, const Frames::Names& frames,
              Nanoseconds source_patience, Reactions reactions);

  /// Listens to the topics that only the present law uses, and to no others.
  void followLaw();

 private:
  using OdometryEvent = ros::MessageEvent<const nav_msgs::Odometry>;

  void onOdometry(const OdometryEvent& event);
  void onImu(const sensor_msgs::Imu::ConstPtr& message);
  void onTrajectory(const BoundedTrajectory::ConstPtr& message);
  void onPose(const geometry_msgs::PoseStamped::ConstPtr& message);
  void onOrder(const msgs::ActiveSubsystem::ConstPtr& message);

  bool toOwnFrames(const nav_msgs::Odometry& message, State& state);
  void refuseOdometry(const std::string& why);
  Eigen::Isometry3d toWorld(const std::string& frame);
  template <class ToSetPoints>
  void plan(const char* what, const ros::Time& stamp, ToSetPoints to_set_points);

  ros::NodeHandle node_;
  Pilot& pilot_;
  Reactions reactions_;
  std::unique_ptr<Frames> frames_;  // null: unguarded, nobody looks
  SoleSource odometry_source_;
  ros::Subscriber odometry_subscriber_;
  ros::Subscriber trajectory_subscriber_;
  ros::Subscriber pose_subscriber_;
  ros::Subscriber imu_subscriber_;    // null: nobody uses it
  ros::Subscriber order_subscriber_;  // null: the law has no subsystems
};

}  // namespace aqc
