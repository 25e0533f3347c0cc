#include "adaptive_quadrotor_control/ros/controller_nodelet.h"

#include <algorithm>
#include <boost/make_shared.hpp>

#if __has_include(<pluginlib/class_list_macros.hpp>)
#include <pluginlib/class_list_macros.hpp>
#else
#include <pluginlib/class_list_macros.h>
#endif

#include "adaptive_quadrotor_control/Actuators.h"
#include "adaptive_quadrotor_control/control/controller_factory.h"
#include "adaptive_quadrotor_control/control/handover.h"
#include "adaptive_quadrotor_control/ros/conversions.h"
#include "adaptive_quadrotor_control/ros/parameter_tree.h"

namespace aqc {
namespace {

// A trajectory stamped further back than this was not meant for now by its clock: RotorS's meaning,
// "the first point now", applies to it, as to one without a stamp.
constexpr Nanoseconds kOldestTrajectory = 1'000'000'000;
constexpr double kWarningPeriod = 1.0;  // [s], at most one warning of a kind in this time

}  // namespace

void ControllerNodelet::onInit() {
  try {
    configure();
  } catch (const std::exception& error) {
    NODELET_FATAL("%s", error.what());
    throw;
  }
  connect();
}

void ControllerNodelet::configure() {
  const Vehicle vehicle = readParameters(getNodeHandle(), "vehicle", readVehicle);
  getPrivateNodeHandle().deleteParam("tuning");  // what the tuner of an earlier run left behind
  const ParameterReader own = parameterReader(getPrivateNodeHandle(), "");
  const double default_rate = getNodeHandle().param("scenario/control_rate", 250.0);
  period_ = fromSeconds(1.0 / own.number("rate", Range::between(1.0, 10000.0), default_rate));
  odometry_triggers_ =
      own.has("trigger") && own.choice("trigger", {"odometry", "timer"}) == "odometry";
  const ParameterReader gains = own.child("gains");
  law_name_ = gains.text("law");
  controller_ = std::make_unique<FlightController>(vehicle, makeController(gains, vehicle));
  own.finish();
  adaptive_names_ = controller_->law().adaptiveNames();
  diagnostics_ =
      std::make_unique<FlightDiagnostics>(getNodeHandle(), getPrivateNodeHandle(), getName(),
                                          FlightMonitor(period_, vehicle.maxThrust() / kGravity));
  tuner_ = std::make_unique<GainTuner>(
      getPrivateNodeHandle(), parameterTree(getNodeHandle(), "vehicle"),
      parameterTree(getPrivateNodeHandle(), "gains"), getSTCallbackQueue(),
      [this](PreparedLaw& prepared) { return swapLaw(prepared); });
}

void ControllerNodelet::connect() {
  ros::NodeHandle& node = getNodeHandle();
  // A simulation may run far ahead of the wall clock: nothing may be lost in a queue on the way.
  motor_publisher_ = node.advertise<msgs::Actuators>("command/motor_speed", 100);
  state_publisher_ = getPrivateNodeHandle().advertise<msgs::ControllerState>("state", 10000);
  const auto fast = ros::TransportHints().tcpNoDelay();
  odometry_subscriber_ = node.subscribe("odometry", 10, &ControllerNodelet::onOdometry, this, fast);
  trajectory_subscriber_ =
      node.subscribe("command/trajectory", 10, &ControllerNodelet::onTrajectory, this, fast);
  pose_subscriber_ = node.subscribe("command/pose", 10, &ControllerNodelet::onPose, this, fast);
  connectLaw();
  if (!odometry_triggers_) {
    timer_ = node.createTimer(ros::Duration().fromNSec(period_), &ControllerNodelet::onTimer, this);
  }
  NODELET_INFO("%s at %.0f Hz, triggered by %s", law_name_.c_str(), 1.0 / toSeconds(period_),
               odometry_triggers_ ? "odometry" : "a timer");
}

// The inputs that only some laws have.
void ControllerNodelet::connectLaw() {
  SubsystemSwitch* subsystems = controller_->subsystems();
  if (subsystems == nullptr) {
    switch_.reset();
  } else if (switch_) {
    switch_->follow(*subsystems);
  } else {
    switch_ = std::make_unique<SwitchInput>(getNodeHandle(), *subsystems);
  }
  if (!controller_->law().needsImu()) {
    imu_.reset();
  } else if (!imu_) {
    imu_ = std::make_unique<ImuInput>(getNodeHandle(), [this] {
      if (waiting_ && imu_->covers(odometry_time_)) answer();
    });
  }
}

void ControllerNodelet::onOdometry(const nav_msgs::Odometry::ConstPtr& message) {
  const State state = toState(*message);
  const Nanoseconds time = toNanoseconds(message->header.stamp);
  if (!state.valid() || (state_ && time < odometry_time_)) {
    ++dropped_odometry_;
    diagnostics_->monitor().countDroppedOdometry();
    NODELET_WARN_THROTTLE(kWarningPeriod, "odometry dropped: %s (%u so far)",
                          state.valid() ? "its stamp goes back" : "it is not finite or not a pose",
                          dropped_odometry_);
    return;
  }
  const bool again = state_ && time == odometry_time_;
  state_ = state;
  odometry_time_ = time;
  diagnostics_->heardOdometry();
  diagnostics_->monitor().countOdometry(time, toNanoseconds(ros::Time::now()));
  if (!odometry_triggers_) {
    // A paused simulation repeats its odometry while its clock stands still: no timer fires then,
    // and whoever is about to resume it waits for the state.
    if (again && !flying_) step(time, toSeconds(period_));
    return;
  }
  // The same stamp again asks for the answer again (the simulator waits for it), not for a step:
  // unless nothing was flying, when a set point may have come in the meantime.
  const bool repeated = last_step_ && time == *last_step_ && flying_;
  const bool early = last_step_ && time > *last_step_ && time < *last_step_ + period_;
  if (repeated || early) return publishMotors();
  // Which of the two connections delivers first is chance. Whoever asks again gets an answer: the
  // IMU may have fallen silent.
  const bool wait = imu_ && !waiting_ && imu_->awaits(time);
  if (wait) {
    waiting_ = true;
  } else {
    answer();
  }
}

void ControllerNodelet::answer() {
  waiting_ = false;
  const Nanoseconds elapsed = last_step_ ? odometry_time_ - *last_step_ : period_;
  // Odometry that pauses must not make one huge step of the adaptive laws.
  step(odometry_time_, toSeconds(std::clamp(elapsed, period_, 2 * period_)));
}

void ControllerNodelet::onTimer(const ros::TimerEvent&) {
  step(toNanoseconds(ros::Time::now()), toSeconds(period_));
}

void ControllerNodelet::step(Nanoseconds now, double dt) {
  last_step_ = now;
  const SetPoint* set_point = state_ ? schedule_.at(now) : nullptr;
  flying_ = set_point != nullptr;
  if (flying_) set_point_ = *set_point;
  if (switch_) switch_->step(now);
  if (imu_) imu_->feed(*controller_, odometry_time_);
  controller_->step(state_.value_or(State()), set_point, dt);
  diagnostics_->monitor().countStep(now, flying_, controller_->law().telemetry(),
                                    controller_->allocation().saturated);
  publishMotors();
  publishState();
}

std::string ControllerNodelet::swapLaw(PreparedLaw& prepared) {
  if (controller_->flying() && prepared.name != law_name_) {
    const std::string obstacle =
        handoverObstacle(controller_->law().telemetry(), controller_->allocation().saturated);
    if (!obstacle.empty()) {
      return "'" + prepared.name + "' cannot take over from '" + law_name_ + "' now: " + obstacle;
    }
  }
  prepared.law = controller_->replaceLaw(std::move(prepared.law));
  law_name_.swap(prepared.name);
  adaptive_names_.swap(prepared.adaptive_names);
  connectLaw();
  return "";
}

void ControllerNodelet::publishMotors() {
  const RotorArray& speeds = controller_->allocation().speeds;
  const auto motors = boost::make_shared<msgs::Actuators>();
  motors->header.stamp = toRosTime(odometry_time_);
  motors->angular_velocities.assign(speeds.begin(), speeds.end());
  motor_publisher_.publish(motors);
}

void ControllerNodelet::publishState() {
  FlightSample sample;
  sample.time = odometry_time_;
  sample.state = state_.value_or(State());
  sample.flying = flying_;
  sample.set_point = set_point_;
  sample.telemetry = controller_->law().telemetry();
  sample.allocation = controller_->allocation();
  const auto state = boost::make_shared<msgs::ControllerState>();
  fill(sample, *state);
  state->controller = law_name_;
  state->adaptive_names = adaptive_names_;
  state->trajectory_stamp = trajectory_stamp_;
  state->set_points_pending = static_cast<std::uint32_t>(schedule_.pending());
  state->dropped_odometry = dropped_odometry_;
  state->dropped_set_points = dropped_set_points_;
  if (imu_) imu_->fill(*state);
  if (switch_) switch_->fill(*state, odometry_time_);
  state_publisher_.publish(state);
}

void ControllerNodelet::accept(std::vector<TimedSetPoint> set_points, Nanoseconds now,
                               const ros::Time& stamp) {
  schedule_.replace(now, std::move(set_points));
  trajectory_stamp_ = stamp;
  diagnostics_->monitor().countSetPoint(now);
}

void ControllerNodelet::onTrajectory(
    const trajectory_msgs::MultiDOFJointTrajectory::ConstPtr& message) {
  const Nanoseconds now = toNanoseconds(ros::Time::now());
  const Nanoseconds stamp = toNanoseconds(message->header.stamp);
  try {
    accept(toSetPoints(*message, stamp + kOldestTrajectory > now ? stamp : now), now,
           message->header.stamp);
  } catch (const std::invalid_argument& error) {
    ++dropped_set_points_;
    diagnostics_->monitor().countDroppedSetPoint();
    NODELET_WARN_THROTTLE(kWarningPeriod, "trajectory dropped: %s (%u so far)", error.what(),
                          dropped_set_points_);
  }
}

void ControllerNodelet::onPose(const geometry_msgs::PoseStamped::ConstPtr& message) {
  const Nanoseconds now = toNanoseconds(ros::Time::now());
  try {
    accept({{now, toSetPoint(message->pose)}}, now, message->header.stamp);
  } catch (const std::invalid_argument& error) {
    ++dropped_set_points_;
    diagnostics_->monitor().countDroppedSetPoint();
    NODELET_WARN_THROTTLE(kWarningPeriod, "pose dropped: %s (%u so far)", error.what(),
                          dropped_set_points_);
  }
}

}  // namespace aqc

PLUGINLIB_EXPORT_CLASS(aqc::ControllerNodelet, nodelet::Nodelet)
