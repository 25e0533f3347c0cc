#include "ros/display/display_node.h"

#include <stdexcept>

#include "adaptive_quadrotor_control/simulation/scenario.h"
#include "figures/vehicle_urdf.h"
#include "ros/border/names.h"
#include "ros/border/parameter_tree.h"
#include "ros/border/run_node.h"

namespace aqc {
namespace {

constexpr unsigned kPathEvery = 4;  // ticks; paths are long and change little

void append(Markers& all, const Markers& more) {
  all.insert(all.end(), more.begin(), more.end());
}

}  // namespace

DisplayNode::DisplayNode() : vehicle_(readParameters(node_, "vehicle", readVehicle)) {
  ros::NodeHandle private_node("~");
  const ParameterReader own = parameterReader(private_node, "");
  const double rate = own.number("rate", Range::between(0.5, 100.0), 20.0);
  own.finish();
  if (node_.hasParam("scenario")) {
    walls_ = readParameters(node_, "scenario", readWorldAlone).walls;
  }
  if (!node_.hasParam("robot_description")) {
    node_.setParam("robot_description", vehicleUrdf(vehicle_));
  }
  vehicle_publisher_ = node_.advertise<visualization_msgs::MarkerArray>("display/vehicle", 2);
  path_publisher_ = node_.advertise<visualization_msgs::MarkerArray>("display/paths", 2, true);
  subscribers_ = {
      node_.subscribe(kStateTopic, 10, &DisplayNode::onState, this),
      node_.subscribe<msgs::PlantStatus>(
          kStatusTopic, 1, [this](const msgs::PlantStatus::ConstPtr& m) { status_ = m; }),
      node_.subscribe(kTrajectoryTopic, 10, &DisplayNode::onTrajectory, this)};
  timer_ = node_.createWallTimer(ros::WallDuration(1.0 / rate), &DisplayNode::onTimer, this);
}

void DisplayNode::onState(const msgs::ControllerState::ConstPtr& state) {
  // After the simulation was restarted its clock reads an earlier time: another flight.
  if (state_ && state->header.stamp < state_->header.stamp) {
    flown_.clear();
    reference_.clear();
  }
  state_ = state;
  if (!state->flying) return;
  flown_.add(toEigen(state->position), toEigen(state->position_error).norm());
  reference_.add(toEigen(state->desired_position), toNanoseconds(state->header.stamp));
}

void DisplayNode::onTrajectory(const trajectory_msgs::MultiDOFJointTrajectory::ConstPtr& message) {
  try {
    reference_.plan(toSetPoints(*message, toNanoseconds(message->header.stamp)));
  } catch (const std::invalid_argument&) {
    // The controller says what is wrong with it.
  }
}

void DisplayNode::onTimer(const ros::WallTimerEvent&) {
  if (!state_) return;
  publishVehicle();
  if (ticks_++ % kPathEvery == 0) publishPaths();
}

void DisplayNode::publishVehicle() {
  const Eigen::Vector3d position = toEigen(state_->position);
  Markers markers = thrustMarkers(*state_, vehicle_);
  append(markers, setPointMarkers(*state_));
  append(markers, plumbMarkers(position));
  append(markers, textMarkers(*state_, status_.get(), vehicle_));
  if (status_) {
    append(markers, payloadMarkers(*status_));
    append(markers, disturbanceMarkers(*status_, position));
  }
  vehicle_publisher_.publish(withDeletions(shown_, markers));
  shown_ = std::move(markers);
}

void DisplayNode::publishPaths() {
  visualization_msgs::MarkerArray message;
  message.markers = wallMarkers(walls_);
  message.markers.push_back(reference_.marker());
  message.markers.push_back(flown_.marker());
  path_publisher_.publish(message);
}

}  // namespace aqc

int main(int argc, char** argv) {
  return aqc::spinNode<aqc::DisplayNode>(argc, argv, "display");
}
