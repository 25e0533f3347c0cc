#include "ros/display/goal_node.h"

#include <std_srvs/Trigger.h>
#include <trajectory_msgs/MultiDOFJointTrajectory.h>

#include <algorithm>
#include <stdexcept>

#include "adaptive_quadrotor_control/math/rotations.h"
#include "adaptive_quadrotor_control/reference/sampling.h"
#include "adaptive_quadrotor_control/simulation/scenario.h"
#include "ros/border/names.h"
#include "ros/border/parameter_tree.h"
#include "ros/border/plant_services.h"
#include "ros/border/run_node.h"
#include "ros/border/service_call.h"
#include "ros/display/goal_marker.h"

namespace aqc {
namespace {

constexpr double kRefresh = 0.1;                     // of the handle's place [s], wall
constexpr Nanoseconds kSetPointPeriod = 20'000'000;  // of take-off and landing
constexpr double kGustLasts = 2.0;                   // [s]
constexpr double kBoxEdge = 0.12;                    // of a payload from the menu [m]
constexpr double kBoxBelow = 0.18;                   // its centre, under the vehicle [m]
constexpr double kPatience = 0.5;                    // for the plant to show up [s], wall
constexpr double kSlack = 0.03;                      // aimed below the ground to settle [m]
constexpr const char* kFrames[] = {"", kWorldFrame, "/world"};  // that need no transform

}  // namespace

GoalNode::GoalNode() : vehicle_(readParameters(node_, "vehicle", readVehicle)) {
  const ParameterReader own = parameterReader(ros::NodeHandle("~"), "");
  take_off_height_ = own.number("take_off_height", Range::positiveUpTo(100.0), 1.0);
  limits_.speed = own.number("speed", Range::positiveUpTo(10.0), 0.6);
  gust_ = own.number("gust", Range::positiveUpTo(30.0), 8.0);
  own.finish();
  limits_.acceleration = 1.0;
  limits_.tilt = 0.5;
  limits_.thrust_to_weight = 1.5;
  if (node_.hasParam("scenario")) start_ = readParameters(node_, "scenario", readWorldAlone).start;

  pose_publisher_ = node_.advertise<geometry_msgs::PoseStamped>(kPoseTopic, 10);
  trajectory_publisher_ =
      node_.advertise<trajectory_msgs::MultiDOFJointTrajectory>(kTrajectoryTopic, 1);
  subscribers_ = {
      node_.subscribe<msgs::ControllerState>(
          kStateTopic, 1, [this](const msgs::ControllerState::ConstPtr& m) { state_ = m; }),
      node_.subscribe<msgs::PlantStatus>(
          kStatusTopic, 1, [this](const msgs::PlantStatus::ConstPtr& m) { status_ = m; }),
      node_.subscribe("move_base_simple/goal", 1, &GoalNode::onNavGoal, this)};
  addMenu();
  timer_ = node_.createWallTimer(ros::WallDuration(kRefresh), &GoalNode::onTimer, this);
}

void GoalNode::addMenu() {
  const auto add = [this](const std::string& title, auto action) {
    menu_.insert(title, [action](const Feedback&) { action(); });
  };
  for (const char* mass : {"0.2", "0.5", "1.0"}) {
    add(std::string("Attach ") + mass + " kg", [this, mass] { attach(std::stod(mass)); });
  }
  add("Drop the payload", [this] { drop(); });
  add("Wind gust", [this] { gust(); });
  add("Take off", [this] { takeOff(); });
  add("Land", [this] { land(); });
  add("Hold", [this] { askGuard({"hold"}); });
  add("Kill: stop the rotors for ever", [this] { askGuard({"kill"}); });
  add("Reset the simulation", [this] { reset(); });
}

SetPoint GoalNode::present() const {
  if (!state_) throw std::runtime_error("the controller has not published its state yet");
  SetPoint present;
  present.position = toEigen(state_->flying ? state_->goal_position : state_->position);
  present.yaw = state_->flying ? state_->goal_yaw : rollPitchYaw(toEigen(state_->attitude)).z();
  return present;
}

void GoalNode::onTimer(const ros::WallTimerEvent&) {
  if (!state_ || dragging_) return;
  const visualization_msgs::InteractiveMarker goal = goalMarker(present());
  if (shown_) {
    server_.setPose(kGoalName, goal.pose);
  } else {
    server_.insert(goal, [this](const Feedback& feedback) { onFeedback(feedback); });
    menu_.apply(server_, kGoalName);
    shown_ = true;
  }
  server_.applyChanges();
}

void GoalNode::onFeedback(const Feedback& feedback) {
  using visualization_msgs::InteractiveMarkerFeedback;
  if (feedback->event_type == InteractiveMarkerFeedback::MOUSE_DOWN) dragging_ = true;
  if (feedback->event_type == InteractiveMarkerFeedback::MOUSE_UP) dragging_ = false;
  if (feedback->event_type != InteractiveMarkerFeedback::POSE_UPDATE) return;
  geometry_msgs::Pose pose = feedback->pose;
  pose.position.z = std::max(pose.position.z, vehicle_.gear_height);  // not into the ground
  command(pose);
}

void GoalNode::onNavGoal(const geometry_msgs::PoseStamped::ConstPtr& goal) {
  if (std::find(std::begin(kFrames), std::end(kFrames), goal->header.frame_id) ==
      std::end(kFrames)) {
    ROS_WARN("goal refused: it is in the frame '%s'; set rviz's fixed frame to 'world'",
             goal->header.frame_id.c_str());
    return;
  }
  geometry_msgs::Pose pose = goal->pose;
  pose.position.z = state_ && state_->flying ? state_->goal_position.z : take_off_height_;
  command(pose);
}

void GoalNode::command(const geometry_msgs::Pose& pose) {
  geometry_msgs::PoseStamped message;
  message.header.stamp = ros::Time::now();
  message.header.frame_id = kWorldFrame;
  message.pose = pose;
  pose_publisher_.publish(message);
}

template <class Service>
bool GoalNode::call(const std::string& name, Service& service) {
  try {
    callService(node_, name, ros::WallDuration(kPatience), service);
    return true;
  } catch (const std::runtime_error& error) {
    ROS_WARN("%s", error.what());
    return false;
  }
}

template <class Action>
bool GoalNode::order(const Action& action, const ros::Time& at) {
  typename PlantService<Action>::Type service;
  service.request = toRequest(action, at);
  return call(std::string(kPlantServices) + PlantService<Action>::kName, service);
}

void GoalNode::attach(double mass) {
  AttachPayload box;
  box.payload.mass = mass;
  box.payload.size.setConstant(kBoxEdge);
  box.payload.offset = {0.0, 0.0, -kBoxBelow};
  box.payload.inertia = boxInertia(mass, box.payload.size);
  order(box);
}

void GoalNode::drop() {
  order(DetachPayload{});
}

void GoalNode::gust() {
  if (!order(SetWind{{0.0, gust_, 0.0}})) return;
  order(SetWind{}, ros::Time::now() + ros::Duration(kGustLasts));
}

void GoalNode::climbTo(double height) {
  const SetPoint here = present();
  Waypoint from;
  from.position = here.position;
  from.yaw = here.yaw;
  Waypoint to = from;
  to.position.z() = height;
  const PolynomialTrajectory path = minimumSnapWithin({from, to}, limits_);
  const Nanoseconds begin = toNanoseconds(ros::Time::now());
  trajectory_publisher_.publish(toTrajectory(sample(path, begin, kSetPointPeriod), begin));
}

// A guard takes off and lands by itself; true when there is one, and it was asked.
bool GoalNode::askGuard(const std::vector<std::string>& orders) {
  if (!state_ || state_->mode.empty()) return false;
  for (const std::string& order : orders) {
    std_srvs::Trigger service;
    call(kControllerServices + order, service);
  }
  return true;
}

void GoalNode::takeOff() {
  if (askGuard({"arm", "take_off"})) return;
  try {
    climbTo(std::max(take_off_height_, present().position.z()));
  } catch (const std::exception& error) {
    ROS_WARN("no take-off: %s", error.what());
  }
}

void GoalNode::land() {
  if (askGuard({"land"})) return;
  double height = vehicle_.gear_height;
  if (status_ && status_->payload_mass > 0.0) {
    height = std::max(height, 0.5 * status_->payload_size.z - status_->payload_offset.z);
  }
  try {
    climbTo(height - kSlack);
  } catch (const std::exception& error) {
    ROS_WARN("no landing: %s", error.what());
  }
}

void GoalNode::reset() {
  std_srvs::Trigger service;
  if (!call(std::string(kPlantServices) + "reset", service) || !start_) return;
  geometry_msgs::Pose pose;
  pose.position = toPoint(start_->position);
  pose.orientation = toQuaternion(start_->attitude);
  command(pose);
}

}  // namespace aqc

int main(int argc, char** argv) {
  return aqc::spinNode<aqc::GoalNode>(argc, argv, "goal");
}
