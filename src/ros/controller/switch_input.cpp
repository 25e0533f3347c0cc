#include "ros/controller/switch_input.h"

namespace aqc {
namespace {

constexpr double kWarningPeriod = 1.0;  // [s]

}  // namespace

SwitchInput::SwitchInput(ros::NodeHandle& node, SubsystemSwitch& subsystems)
    : subsystems_(&subsystems),
      subscriber_(node.subscribe("active_subsystem", SwitchSchedule::kMost, &SwitchInput::onOrder,
                                 this, ros::TransportHints().tcpNoDelay())) {
  ROS_INFO("%d subsystems, %d active; %s", subsystems.count(), subsystems.active(),
           subsystems.text().c_str());
}

void SwitchInput::onOrder(const msgs::ActiveSubsystem::ConstPtr& message) {
  if (!orders_.plan({toNanoseconds(message->header.stamp), message->subsystem})) {
    ROS_WARN_THROTTLE(kWarningPeriod, "switch dropped: %zu wait already", orders_.pending());
  }
}

void SwitchInput::restart() noexcept {
  orders_.clear();
  subsystems_->restart();
  refused_subsystem_ = 0;
  refusal_.clear();
}

void SwitchInput::step(Nanoseconds now) {
  while (const auto report = orders_.next(*subsystems_, now)) {
    if (!report->objected()) continue;
    refused_subsystem_ = report->order.subsystem;
    refusal_ = toString(report->verdict.outcome);
    ROS_WARN("%s", switchObjection(refused_subsystem_, refusal_, report->allowed, now, 0).c_str());
  }
}

void SwitchInput::fill(msgs::ControllerState& state, Nanoseconds now) const {
  state.active_subsystem = static_cast<std::uint8_t>(subsystems_->active());
  state.switches = static_cast<std::uint32_t>(subsystems_->counts().switched);
  state.switches_pending = static_cast<std::uint32_t>(orders_.pending());
  state.switch_refusals = static_cast<std::uint32_t>(subsystems_->objections());
  state.refused_subsystem = static_cast<std::uint8_t>(refused_subsystem_);
  state.switch_refusal = refusal_;
  state.next_switch_allowed = toRosTime(subsystems_->earliest(now));
}

}  // namespace aqc
