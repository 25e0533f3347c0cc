#pragma once

#include <geometry_msgs/PoseStamped.h>
#include <interactive_markers/interactive_marker_server.h>
#include <interactive_markers/menu_handler.h>
#include <ros/ros.h>

#include <optional>
#include <string>
#include <vector>

#include "adaptive_quadrotor_control/ControllerState.h"
#include "adaptive_quadrotor_control/PlantStatus.h"
#include "adaptive_quadrotor_control/model/vehicle.h"
#include "adaptive_quadrotor_control/reference/time_allocation.h"
#include "ros/border/conversions.h"

namespace aqc {

/// Flying with the mouse: the goal's handle in rviz with its menu, and rviz's 2D Nav Goal.
///
/// In: `controller/state`, `plant/status`, `move_base_simple/goal` (its height is replaced by that
/// of the present set point), feedback of the interactive marker server `goal`. Out:
/// `command/pose` while the handle is dragged, `command/trajectory` for take-off and landing. The
/// menu calls the services of `plant` and, to take off and land, those of a guarded `controller`.
/// Parameters: `vehicle`; `scenario` if there is one;
/// `~take_off_height` [m], `~speed` [m/s] of take-off and landing, `~gust` [m/s].
class GoalNode {
 public:
  /// Throws ParameterError.
  GoalNode();

 private:
  using Feedback = visualization_msgs::InteractiveMarkerFeedbackConstPtr;

  void addMenu();
  void onNavGoal(const geometry_msgs::PoseStamped::ConstPtr& goal);
  void onFeedback(const Feedback& feedback);
  void onTimer(const ros::WallTimerEvent& event);

  void attach(double mass);
  void drop();
  void gust();
  bool askGuard(const std::vector<std::string>& orders);
  void takeOff();
  void land();
  void reset();

  SetPoint present() const;
  void command(const geometry_msgs::Pose& pose);
  void climbTo(double height);
  template <class Service>
  bool call(const std::string& name, Service& service);
  template <class Action>
  bool order(const Action& action, const ros::Time& at = {});

  ros::NodeHandle node_;
  Vehicle vehicle_;
  std::optional<State> start_;  // of the simulated vehicle
  double take_off_height_ = 0.0;
  double gust_ = 0.0;
  MotionLimits limits_{};
  msgs::ControllerState::ConstPtr state_;
  msgs::PlantStatus::ConstPtr status_;
  bool dragging_ = false;

  interactive_markers::InteractiveMarkerServer server_{"goal"};
  interactive_markers::MenuHandler menu_;
  bool shown_ = false;
  ros::Publisher pose_publisher_;
  ros::Publisher trajectory_publisher_;
  std::vector<ros::Subscriber> subscribers_;
  ros::WallTimer timer_;
};

}  // namespace aqc
