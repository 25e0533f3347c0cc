#include "ros/controller/controller_nodelet.h"

#include <boost/make_shared.hpp>
#include <cmath>
#include <stdexcept>

#if __has_include(<pluginlib/class_list_macros.hpp>)
#include <pluginlib/class_list_macros.hpp>
#else
#include <pluginlib/class_list_macros.h>
#endif

#include "adaptive_quadrotor_control/Actuators.h"
#include "adaptive_quadrotor_control/law/law_factory.h"
#include "ros/border/conversions.h"
#include "ros/border/parameter_tree.h"
#include "ros/controller/pilot_state.h"

namespace aqc {
namespace {

constexpr double kDefaultRate = 250.0;  // [Hz]
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
  const ros::NodeHandle& own_node = getPrivateNodeHandle();
  const Vehicle vehicle = readParameters(getNodeHandle(), "vehicle", readVehicle);
  const ParameterReader own = parameterReader(own_node, "");
  const Nanoseconds period =
      fromSeconds(1.0 / own.number("rate", Range::between(1.0, 10000.0), kDefaultRate));
  const bool by_odometry =
      own.has("trigger") && own.choice("trigger", {"odometry", "timer"}) == "odometry";
  PilotLimits limits;
  if (own.has("limits")) limits = readPilotLimits(own.child("limits"));
  if (own.flag("guarded", true)) {
    limits.guard = own.has("guard") ? readGuardLimits(own.child("guard")) : GuardLimits();
  } else {
    own.skip("guard");
  }
  world_frame_ = own.text("world_frame", kWorldFrame);
  body_frame_ = own.text("body_frame", kBodyFrame);
  own.skip("was_armed");
  pilot_ = std::make_unique<Pilot>(
      vehicle, makeLaw(own.child("gains"), vehicle), period,
      by_odometry ? StepClock::Trigger::kOdometry : StepClock::Trigger::kTimer, limits);
  own.finish();
  adaptive_quantities_ = pilot_->law().adaptiveQuantities();
  diagnostics_ = std::make_unique<FlightDiagnostics>(
      getNodeHandle(), own_node, getName(), pilot_->findingNames(),
      [this](Nanoseconds now, double silence) { return pilot_->judge(now, silence); });
  tuner_ = std::make_unique<GainTuner>(own_node, parameterTree(getNodeHandle(), "vehicle"),
                                       parameterTree(own_node, "gains"), getSTCallbackQueue(),
                                       [this](PreparedLaw& prepared) { return swapLaw(prepared); });
}

void ControllerNodelet::connect() {
  ros::NodeHandle& node = getNodeHandle();
  // A simulation may run far ahead of the wall clock: nothing may be lost in a queue on the way.
  motor_publisher_ = node.advertise<msgs::Actuators>(kMotorSpeedTopic, 100);
  state_publisher_ = getPrivateNodeHandle().advertise<msgs::ControllerState>("state", 10000);
  const auto fast = ros::TransportHints().tcpNoDelay();
  odometry_subscriber_ =
      node.subscribe(kOdometryTopic, 10, &ControllerNodelet::onOdometry, this, fast);
  trajectory_subscriber_ =
      node.subscribe(kTrajectoryTopic, 10, &ControllerNodelet::onTrajectory, this, fast);
  pose_subscriber_ = node.subscribe(kPoseTopic, 10, &ControllerNodelet::onPose, this, fast);
  connectLaw();
  if (pilot_->guard() != nullptr) {
    armed_record_ = std::make_unique<ArmedRecord>(getPrivateNodeHandle());
    if (armed_record_->wasArmed()) pilot_->guard()->wasArmed();
    guard_services_ = std::make_unique<GuardServices>(getPrivateNodeHandle(), *pilot_);
  }
  const bool by_timer = pilot_->stepClock().trigger() == StepClock::Trigger::kTimer;
  const Nanoseconds period = pilot_->stepClock().period();
  // A clock that steps must not stop the steps.
  const bool needs_timer = by_timer || pilot_->guard() != nullptr;
  if (needs_timer && ros::Time::isSimTime()) {
    timer_ = node.createTimer(ros::Duration().fromNSec(period),
                              [this](const ros::TimerEvent&) { onTimer(); });
  } else if (needs_timer) {
    steady_timer_ = node.createSteadyTimer(ros::WallDuration().fromNSec(period),
                                           [this](const ros::SteadyTimerEvent&) { onTimer(); });
  }
  NODELET_INFO("%s at %.0f Hz, triggered by %s", pilot_->law().name(), 1.0 / toSeconds(period),
               by_timer ? "a timer" : "odometry");
}

void ControllerNodelet::onTimer() {
  const Nanoseconds now = toNanoseconds(ros::Time::now());
  const bool by_timer = pilot_->stepClock().trigger() == StepClock::Trigger::kTimer;
  act(by_timer ? pilot_->tick(now) : pilot_->watch(now));
}

// The inputs that only some laws have.
void ControllerNodelet::connectLaw() {
  const auto fast = ros::TransportHints().tcpNoDelay();
  const SubsystemSwitch* subsystems = pilot_->law().subsystems();
  if (subsystems == nullptr) {
    order_subscriber_.shutdown();
  } else if (!order_subscriber_) {
    NODELET_INFO("%d subsystems, %d active; %s", subsystems->count(), subsystems->active(),
                 subsystems->text().c_str());
    order_subscriber_ = getNodeHandle().subscribe(kSubsystemTopic, SwitchSchedule::kMost,
                                                  &ControllerNodelet::onOrder, this, fast);
  }
  if (!pilot_->law().usesSpecificForce() && pilot_->guard() == nullptr) {
    imu_subscriber_.shutdown();
  } else if (!imu_subscriber_) {
    imu_subscriber_ =
        getNodeHandle().subscribe(kImuTopic, 10, &ControllerNodelet::onImu, this, fast);
  }
}

// Whether a message that says a frame at all speaks of another one than `frame`.
bool ControllerNodelet::foreign(const std::string& said, const std::string& frame) const {
  return pilot_->guard() != nullptr && !said.empty() && said != frame;
}

void ControllerNodelet::onOdometry(const nav_msgs::Odometry::ConstPtr& message) {
  const std::string& frame = message->header.frame_id;
  if (foreign(frame, world_frame_) || foreign(message->child_frame_id, body_frame_)) {
    pilot_->countRefusedOdometry();
    NODELET_WARN_THROTTLE(
        kWarningPeriod, "odometry of '%s' in '%s' dropped: only '%s' in '%s' is known (%u so far)",
        message->child_frame_id.c_str(), frame.c_str(), body_frame_.c_str(), world_frame_.c_str(),
        pilot_->droppedOdometry());
    return;
  }
  const Answer answer = pilot_->hear(toState(*message), toNanoseconds(message->header.stamp),
                                     toNanoseconds(ros::Time::now()));
  if (answer.began_anew) {
    NODELET_WARN_THROTTLE(kWarningPeriod,
                          "odometry went back so far that its clock was started anew: plans of "
                          "the old time are gone");
  }
  if (answer.refusal != nullptr) {
    NODELET_WARN_THROTTLE(kWarningPeriod, "odometry dropped: %s (%u so far)", answer.refusal,
                          pilot_->droppedOdometry());
  } else {
    diagnostics_->heardOdometry();
  }
  act(answer.publish);
}

void ControllerNodelet::onImu(const sensor_msgs::Imu::ConstPtr& message) {
  const Answer answer =
      pilot_->hear(toEigen(message->linear_acceleration), toEigen(message->angular_velocity),
                   toNanoseconds(message->header.stamp));
  if (answer.refusal != nullptr) {
    NODELET_WARN_THROTTLE(kWarningPeriod, "imu sample dropped: %s (%ld so far)", answer.refusal,
                          pilot_->imu().dropped());
  }
  act(answer.publish);
}

template <class ToSetPoints>
void ControllerNodelet::plan(const char* what, const ros::Time& stamp, ToSetPoints to_set_points) {
  const Nanoseconds now = toNanoseconds(ros::Time::now());
  try {
    pilot_->plan(to_set_points(now), now, toNanoseconds(stamp));
  } catch (const std::invalid_argument& error) {
    pilot_->countRefusedSetPoints();
    NODELET_WARN_THROTTLE(kWarningPeriod, "%s dropped: %s (%u so far)", what, error.what(),
                          pilot_->droppedSetPoints());
  }
}

void ControllerNodelet::onTrajectory(const BoundedTrajectory::ConstPtr& message) {
  const ros::Time& stamp = message->trajectory.header.stamp;
  plan("trajectory", stamp, [&](Nanoseconds now) {
    if (!message->refusal.empty()) throw std::invalid_argument(message->refusal);
    return toSetPoints(message->trajectory, pilot_->beginning(toNanoseconds(stamp), now));
  });
}

void ControllerNodelet::onPose(const geometry_msgs::PoseStamped::ConstPtr& message) {
  const std::string& frame = message->header.frame_id;
  if (foreign(frame, world_frame_)) {
    pilot_->countRefusedSetPoints();
    NODELET_WARN_THROTTLE(kWarningPeriod, "pose in '%s' dropped: only '%s' is known", frame.c_str(),
                          world_frame_.c_str());
    return;
  }
  plan("pose", message->header.stamp, [&](Nanoseconds now) {
    return std::vector<TimedSetPoint>{{now, toSetPoint(message->pose)}};
  });
}

void ControllerNodelet::onOrder(const msgs::ActiveSubsystem::ConstPtr& message) {
  if (pilot_->order({toNanoseconds(message->header.stamp), message->subsystem})) return;
  NODELET_WARN_THROTTLE(kWarningPeriod, "switch dropped: %zu wait already",
                        pilot_->switchesPending());
}

std::string ControllerNodelet::swapLaw(PreparedLaw& prepared) {
  const std::string obstacle = pilot_->handOver(prepared.law);
  if (!obstacle.empty()) return obstacle;
  adaptive_quantities_.swap(prepared.adaptive_quantities);
  connectLaw();
  return "";
}

void ControllerNodelet::act(Publish publish) {
  if (publish == Publish::kNothing) return;
  const RotorArray& speeds = pilot_->allocation().speeds;
  const auto motors = boost::make_shared<msgs::Actuators>();
  motors->header.stamp = toRosTime(pilot_->stepClock().odometryTime());
  motors->angular_velocities.assign(speeds.begin(), speeds.end());
  motor_publisher_.publish(motors);
  if (publish == Publish::kLastCommand) return;
  if (const Guard* guard = pilot_->guard()) {
    armed_record_->armed(guard->armed());
    if (guard->mode() != told_mode_) {
      told_mode_ = guard->mode();
      NODELET_WARN("%s: %s", toString(told_mode_), textOf(guard->rule()).check);
    }
  }
  publishState();
  tellOfSwitches();
  tellOfImu();
}

void ControllerNodelet::tellOfSwitches() const {
  for (const SwitchReport& report : pilot_->objections()) {
    NODELET_WARN("%s", switchObjection(report, 0).c_str());
  }
}

void ControllerNodelet::tellOfImu() {
  const bool usable = pilot_->imu().usable();
  if (usable == imu_was_usable_) return;
  imu_was_usable_ = usable;
  const std::string topic = imu_subscriber_.getTopic();
  if (usable) {
    NODELET_INFO("'%s' is there", topic.c_str());
  } else {
    const Nanoseconds away = pilot_->stepClock().odometryTime() - pilot_->imu().time();
    NODELET_WARN("the last sample of '%s' is %.3f s away from the odometry: the law does without",
                 topic.c_str(), std::abs(toSeconds(away)));
  }
}

void ControllerNodelet::publishState() {
  const auto state = boost::make_shared<msgs::ControllerState>();
  fill(*pilot_, *state);
  fill(adaptive_quantities_, *state);
  state_publisher_.publish(state);
}

}  // namespace aqc

PLUGINLIB_EXPORT_CLASS(aqc::ControllerNodelet, nodelet::Nodelet)
