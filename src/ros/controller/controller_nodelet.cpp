#include "ros/controller/controller_nodelet.h"

#include <boost/make_shared.hpp>

#if __has_include(<pluginlib/class_list_macros.hpp>)
#include <pluginlib/class_list_macros.hpp>
#else
#include <pluginlib/class_list_macros.h>
#endif

#include "adaptive_quadrotor_control/Actuators.h"
#include "adaptive_quadrotor_control/law/law_factory.h"
#include "adaptive_quadrotor_control/pilot/handover.h"
#include "ros/border/conversions.h"
#include "ros/border/parameter_tree.h"

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
  const ParameterReader own = parameterReader(getPrivateNodeHandle(), "");
  const double default_rate = getNodeHandle().param("scenario/control_rate", 250.0);
  const Nanoseconds period =
      fromSeconds(1.0 / own.number("rate", Range::between(1.0, 10000.0), default_rate));
  const bool by_odometry =
      own.has("trigger") && own.choice("trigger", {"odometry", "timer"}) == "odometry";
  clock_.emplace(period, by_odometry ? StepClock::Trigger::kOdometry : StepClock::Trigger::kTimer);
  const ParameterReader gains = own.child("gains");
  law_name_ = gains.text("law");
  controller_ = std::make_unique<FlightController>(vehicle, makeLaw(gains, vehicle));
  own.finish();
  adaptive_names_ = controller_->law().adaptiveNames();
  diagnostics_ =
      std::make_unique<FlightDiagnostics>(getNodeHandle(), getPrivateNodeHandle(), getName(),
                                          FlightMonitor(period, vehicle.maxThrust() / kGravity));
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
  const bool by_timer = clock_->trigger() == StepClock::Trigger::kTimer;
  if (by_timer) {
    timer_ = node.createTimer(ros::Duration().fromNSec(clock_->period()),
                              &ControllerNodelet::onTimer, this);
  }
  NODELET_INFO("%s at %.0f Hz, triggered by %s", law_name_.c_str(),
               1.0 / toSeconds(clock_->period()), by_timer ? "a timer" : "odometry");
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
      const Nanoseconds time = clock_->odometryTime();
      if (clock_->waiting() && imu_->covers(time)) step(time);
    });
  }
}

void ControllerNodelet::onOdometry(const nav_msgs::Odometry::ConstPtr& message) {
  const State state = toState(*message);
  const Nanoseconds time = toNanoseconds(message->header.stamp);
  if (!state.valid()) return dropOdometry("it is not finite or not a pose");
  StepClock::Answer answer = clock_->hear(time, imu_ && imu_->awaits(time));
  if (answer == StepClock::Answer::kRestart) {
    startAnew();
    answer = clock_->hear(time, imu_ && imu_->awaits(time));
  }
  if (answer == StepClock::Answer::kDrop) return dropOdometry("its stamp goes back");
  state_ = state;
  diagnostics_->heardOdometry();
  diagnostics_->monitor().countOdometry(time, toNanoseconds(ros::Time::now()));
  if (answer == StepClock::Answer::kStep) step(time);
  if (answer == StepClock::Answer::kRepeat) publishMotors();
}

void ControllerNodelet::startAnew() {
  schedule_ = SetPointSchedule();
  if (switch_) switch_->restart();
  controller_->step(State(), nullptr, toSeconds(clock_->period()));  // the law forgets
  diagnostics_->monitor().countNewStart();
  NODELET_WARN_THROTTLE(kWarningPeriod,
                        "odometry went back by more than %.0f s, so its clock was started anew: "
                        "the rotors stand still until a new set point comes",
                        toSeconds(kNewStart));
}

void ControllerNodelet::dropOdometry(const char* reason) {
  ++dropped_odometry_;
  diagnostics_->monitor().countDroppedOdometry();
  NODELET_WARN_THROTTLE(kWarningPeriod, "odometry dropped: %s (%u so far)", reason,
                        dropped_odometry_);
}

void ControllerNodelet::onTimer(const ros::TimerEvent&) {
  step(toNanoseconds(ros::Time::now()));
}

void ControllerNodelet::step(Nanoseconds now) {
  const SetPoint* set_point = state_ ? schedule_.at(now) : nullptr;
  if (set_point != nullptr) set_point_ = *set_point;
  const double dt = clock_->begin(now, set_point != nullptr);
  if (switch_) switch_->step(now);
  if (imu_) imu_->feed(*controller_, clock_->odometryTime());
  controller_->step(state_.value_or(State()), set_point, dt);
  diagnostics_->monitor().countStep(now, controller_->flying(), controller_->law().telemetry(),
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
  motors->header.stamp = toRosTime(clock_->odometryTime());
  motors->angular_velocities.assign(speeds.begin(), speeds.end());
  motor_publisher_.publish(motors);
}

void ControllerNodelet::publishState() {
  FlightSample sample;
  sample.time = clock_->odometryTime();
  sample.state = state_.value_or(State());
  sample.flying = controller_->flying();
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
  if (switch_) switch_->fill(*state, clock_->odometryTime());
  state_publisher_.publish(state);
}

void ControllerNodelet::accept(std::vector<TimedSetPoint> set_points, Nanoseconds now,
                               const ros::Time& stamp) {
  schedule_.replace(now, std::move(set_points));
  trajectory_stamp_ = stamp;
  diagnostics_->monitor().countSetPoint(now);
}

void ControllerNodelet::dropSetPoint(const char* what, const std::invalid_argument& error) {
  ++dropped_set_points_;
  diagnostics_->monitor().countDroppedSetPoint();
  NODELET_WARN_THROTTLE(kWarningPeriod, "%s dropped: %s (%u so far)", what, error.what(),
                        dropped_set_points_);
}

void ControllerNodelet::onTrajectory(
    const trajectory_msgs::MultiDOFJointTrajectory::ConstPtr& message) {
  const Nanoseconds now = toNanoseconds(ros::Time::now());
  const Nanoseconds stamp = toNanoseconds(message->header.stamp);
  try {
    accept(toSetPoints(*message, stamp + kOldestTrajectory > now ? stamp : now), now,
           message->header.stamp);
  } catch (const std::invalid_argument& error) {
    dropSetPoint("trajectory", error);
  }
}

void ControllerNodelet::onPose(const geometry_msgs::PoseStamped::ConstPtr& message) {
  const Nanoseconds now = toNanoseconds(ros::Time::now());
  try {
    accept({{now, toSetPoint(message->pose)}}, now, message->header.stamp);
  } catch (const std::invalid_argument& error) {
    dropSetPoint("pose", error);
  }
}

}  // namespace aqc

PLUGINLIB_EXPORT_CLASS(aqc::ControllerNodelet, nodelet::Nodelet)
