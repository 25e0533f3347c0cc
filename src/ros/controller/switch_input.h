#pragma once

#include <ros/ros.h>

#include <string>

#include "adaptive_quadrotor_control/ActiveSubsystem.h"
#include "adaptive_quadrotor_control/ControllerState.h"
#include "adaptive_quadrotor_control/law/switched/switch_schedule.h"
#include "ros/border/conversions.h"

namespace aqc {

/// The topic `active_subsystem` for a law with several subsystems. Orders wait for their stamps;
/// refusals are told by warnings and in `~state`.
class SwitchInput {
 public:
  /// `subsystems` must outlive this.
  SwitchInput(ros::NodeHandle& node, SubsystemSwitch& subsystems);

  /// From now on orders go to the subsystems of another law; those still to come stay.
  void follow(SubsystemSwitch& subsystems) noexcept { subsystems_ = &subsystems; }

  /// For a clock that starts anew: orders and switches of the old time are forgotten, the initial
  /// subsystem is the active one.
  void restart() noexcept;

  /// Carries out what is due in the control step at `now`.
  void step(Nanoseconds now);
  void fill(msgs::ControllerState& state, Nanoseconds now) const;

 private:
  void onOrder(const msgs::ActiveSubsystem::ConstPtr& message);

  SubsystemSwitch* subsystems_;
  SwitchSchedule orders_;
  int refused_subsystem_ = 0;
  std::string refusal_;
  ros::Subscriber subscriber_;
};

}  // namespace aqc
