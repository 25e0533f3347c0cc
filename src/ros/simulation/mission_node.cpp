#include "ros/simulation/mission_node.h"

#include <ros/callback_queue.h>
#include <std_srvs/Trigger.h>
#include <trajectory_msgs/MultiDOFJointTrajectory.h>

#include <stdexcept>

#include "adaptive_quadrotor_control/ActiveSubsystem.h"
#include "report/progress_bar.h"
#include "ros/border/names.h"
#include "ros/border/parameter_tree.h"
#include "ros/border/plant_services.h"
#include "ros/border/service_call.h"

namespace aqc {
namespace {

constexpr double kPatience = 30.0;  // for another node to answer [s], wall

}  // namespace

MissionNode::MissionNode() {
  for (const std::string name : {"vehicle", "scenario"}) {
    waitFor("the parameters '" + node_.resolveName(name) + "'",
            [&] { return node_.hasParam(name); });
  }
  vehicle_ = readParameters(node_, "vehicle", readVehicle);
  scenario_ = readParameters(node_, "scenario", readScenario);
  const auto fast = ros::TransportHints().tcpNoDelay();
  trajectory_publisher_ =
      node_.advertise<trajectory_msgs::MultiDOFJointTrajectory>(kTrajectoryTopic, 1, true);
  switch_publisher_ =
      node_.advertise<msgs::ActiveSubsystem>(kSubsystemTopic, SwitchSchedule::kMost);
  // Unlimited queues: a lock-stepped flight outruns this node, and no sample may be missing.
  state_subscriber_ = node_.subscribe(kStateTopic, 0, &MissionNode::onState, this, fast);
  status_subscriber_ = node_.subscribe(kStatusTopic, 0, &MissionNode::onStatus, this, fast);
}

void MissionNode::onState(const msgs::ControllerState::ConstPtr& message) {
  state_ = message;
  if (collector_) collector_->add(toReport(*message));
}

void MissionNode::onStatus(const msgs::PlantStatus::ConstPtr& message) {
  status_ = message;
  if (collector_) collector_->add(toTruth(*message));
}

void MissionNode::waitFor(const std::string& what, const std::function<bool()>& condition) const {
  const ros::SteadyTime deadline = ros::SteadyTime::now() + ros::WallDuration(kPatience);
  while (!condition()) {
    ros::getGlobalCallbackQueue()->callAvailable(ros::WallDuration(0.01));
    if (!ros::ok()) throw std::runtime_error("shut down while waiting for " + what);
    if (ros::SteadyTime::now() > deadline) {
      throw std::runtime_error("waited " + std::to_string(static_cast<int>(kPatience)) +
                               " s in vain for " + what);
    }
  }
}

void MissionNode::sendSetPoints() {
  trajectory_publisher_.publish([this] {
    std::vector<TimedSetPoint> set_points = scenario_.mission.set_points;
    for (TimedSetPoint& timed : set_points) timed.time += begin_;
    return toTrajectory(set_points, begin_);
  }());
  waitFor("the controller to accept the trajectory",
          [this] { return state_ && toNanoseconds(state_->trajectory_stamp) == begin_; });
}

void MissionNode::sendSwitches() {
  if (scenario_.mission.switches.empty() || state_->active_subsystem == 0) return;
  waitFor("the controller to listen to " + switch_publisher_.getTopic(),
          [this] { return switch_publisher_.getNumSubscribers() > 0; });
  const std::size_t waiting = state_->switches_pending;
  for (const SwitchOrder& order : scenario_.mission.switches) {
    msgs::ActiveSubsystem message;
    message.header.stamp = toRosTime(begin_ + order.time);
    message.subsystem = static_cast<std::uint8_t>(order.subsystem);
    switch_publisher_.publish(message);
  }
  waitFor("the controller to accept the switches",
          [&] { return state_->switches_pending >= waiting + scenario_.mission.switches.size(); });
}

void MissionNode::sendEvents() {
  for (const PlantEvent& event : scenario_.mission.events) {
    const ros::Time at = toRosTime(begin_ + event.time);
    const auto send = [&](const auto& action) {
      using Kind = PlantService<std::decay_t<decltype(action)>>;
      typename Kind::Type service;
      service.request = toRequest(action, at);
      callPlant(Kind::kName, service);
    };
    std::visit(send, event.action);
  }
}

template <class Service>
void MissionNode::callPlant(const std::string& name, Service& service) {
  callService(node_, kPlantServices + name, ros::WallDuration(kPatience), service);
}

void MissionNode::resume() {
  std_srvs::Trigger service;
  callPlant("resume", service);
}

FlightLog MissionNode::fly() {
  waitFor("the paused plant's status", [this] { return status_ && status_->paused; });
  waitFor("the controller's state", [this] { return state_ != nullptr; });
  begin_ = toNanoseconds(status_->header.stamp);
  sendSetPoints();
  sendSwitches();
  sendEvents();
  if (state_->imu_lost) {
    waitFor("the controller to hear the IMU", [this] { return !state_->imu_lost; });
  }

  collector_.emplace(begin_, scenario_.duration);
  collector_->add(toReport(*state_));  // how many switches were refused before
  const ros::SteadyTime start = ros::SteadyTime::now();
  resume();
  watch();
  const double wall_seconds = (ros::SteadyTime::now() - start).toSec();
  waitFor("the plant's last status",
          [this] { return collector_->lastTruth() >= begin_ + scenario_.duration; });
  // In lock step the plant races on: what comes now would only fill the unlimited queues, which
  // take minutes to clear once they hold a hundred thousand messages.
  state_subscriber_.shutdown();
  status_subscriber_.shutdown();
  FlightLog log = collector_->take();
  log.real_time_factor = toSeconds(scenario_.duration) / wall_seconds;
  return log;
}

// Returns when the last sample is there.
void MissionNode::watch() {
  ProgressBar progress("flying " + scenario_.name + " with " + state_->controller);
  const Nanoseconds last = begin_ + scenario_.duration - scenario_.world.control_period;
  while (collector_->lastStep() < last) {
    const auto before = collector_->lastStep();
    waitFor("the next sample of the flight", [&] { return collector_->lastStep() > before; });
    progress.update(static_cast<double>(*collector_->lastStep() - begin_) /
                    static_cast<double>(last - begin_));
  }
  progress.finish();
}

}  // namespace aqc
