#include "ros/controller/controller_nodelet.h"

#if __has_include(<pluginlib/class_list_macros.hpp>)
#include <pluginlib/class_list_macros.hpp>
#else
#include <pluginlib/class_list_macros.h>
#endif

#include "adaptive_quadrotor_control/law/law_factory.h"
#include "ros/border/conversions.h"
#include "ros/border/parameter_tree.h"
#include "ros/controller/rotor_claim.h"

namespace aqc {
namespace {

constexpr double kDefaultRate = 250.0;  // [Hz]

}  // namespace

void ControllerNodelet::onInit() {
  try {
    configure();
  } catch (const std::exception& error) {
    NODELET_FATAL("%s", error.what());
    throw;
  }
  startTimer();
}

void ControllerNodelet::configure() {
  ros::NodeHandle& node = getNodeHandle();
  ros::NodeHandle& own_node = getPrivateNodeHandle();
  const Vehicle vehicle = readParameters(node, "vehicle", readVehicle);
  const ParameterReader own = parameterReader(own_node, "");
  const Nanoseconds period =
      fromSeconds(1.0 / own.number("rate", Range::between(1.0, 10000.0), kDefaultRate));
  const bool by_odometry =
      own.has("trigger") && own.choice("trigger", {"odometry", "timer"}) == "odometry";
  PilotLimits limits;
  if (own.has("limits")) limits = readPilotLimits(own.child("limits"));
  GuardLimits guard;
  if (own.has("guard")) guard = readGuardLimits(own.child("guard"));
  if (own.flag("guarded", true)) limits.guard = guard;
  const Frames::Names frames = {own.text("world_frame", kWorldFrame),
                                own.text("body_frame", kBodyFrame)};
  own.skip("was_armed");
  pilot_ = std::make_unique<Pilot>(
      vehicle, makeLaw(own.child("gains"), vehicle), period,
      by_odometry ? StepClock::Trigger::kOdometry : StepClock::Trigger::kTimer, limits);
  own.finish();
  requireSolePublisher(node.resolveName(kMotorSpeedTopic));

  outputs_.emplace(node, own_node, *pilot_);
  diagnostics_ = std::make_unique<FlightDiagnostics>(
      node, own_node, getName(), pilot_->findingNames(),
      [this](Nanoseconds now, double silence) { return pilot_->judge(now, silence); });
  tuner_ = std::make_unique<GainTuner>(own_node, parameterTree(node, "vehicle"),
                                       parameterTree(own_node, "gains"), getSTCallbackQueue(),
                                       [this](PreparedLaw& prepared) { return swapLaw(prepared); });
  if (pilot_->guard() != nullptr) connectGuard();
  inputs_ = std::make_unique<PilotInputs>(
      node, *pilot_, frames, fromSeconds(guard.odometry_late),
      PilotInputs::Reactions{[this](Publish publish) { act(publish); },
                             [this] { diagnostics_->heardOdometry(); }});
}

void ControllerNodelet::connectGuard() {
  armed_record_ = std::make_unique<ArmedRecord>(getPrivateNodeHandle());
  if (armed_record_->wasArmed()) pilot_->guard()->wasArmed();
  guard_services_ = std::make_unique<GuardServices>(getPrivateNodeHandle(), *pilot_);
}

void ControllerNodelet::startTimer() {
  const bool by_timer = pilot_->stepClock().trigger() == StepClock::Trigger::kTimer;
  const Nanoseconds period = pilot_->stepClock().period();
  // A clock that steps must not stop the steps.
  const bool needs_timer = by_timer || pilot_->guard() != nullptr;
  if (needs_timer && ros::Time::isSimTime()) {
    timer_ = getNodeHandle().createTimer(ros::Duration().fromNSec(period),
                                         [this](const ros::TimerEvent&) { onTimer(); });
  } else if (needs_timer) {
    steady_timer_ = getNodeHandle().createSteadyTimer(
        ros::WallDuration().fromNSec(period), [this](const ros::SteadyTimerEvent&) { onTimer(); });
  }
  NODELET_INFO("%s at %.0f Hz, triggered by %s", pilot_->law().name(), 1.0 / toSeconds(period),
               by_timer ? "a timer" : "odometry");
}

void ControllerNodelet::onTimer() {
  const Nanoseconds now = toNanoseconds(ros::Time::now());
  const bool by_timer = pilot_->stepClock().trigger() == StepClock::Trigger::kTimer;
  act(by_timer ? pilot_->tick(now) : pilot_->watch(now));
}

void ControllerNodelet::act(Publish publish) {
  outputs_->publish(publish);
  if (publish == Publish::kNewCommand && armed_record_) {
    armed_record_->armed(pilot_->guard()->armed());
  }
}

std::string ControllerNodelet::swapLaw(PreparedLaw& prepared) {
  const std::string obstacle = pilot_->handOver(prepared.law);
  if (!obstacle.empty()) return obstacle;
  outputs_->swapQuantities(prepared.adaptive_quantities);
  inputs_->followLaw();
  return "";
}

}  // namespace aqc

PLUGINLIB_EXPORT_CLASS(aqc::ControllerNodelet, nodelet::Nodelet)
