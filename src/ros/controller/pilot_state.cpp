#include "ros/controller/pilot_state.h"

namespace aqc {
namespace {

void fillImu(const ImuMonitor& imu, msgs::ControllerState& message) {
  message.imu_lost = !imu.usable();
  message.imu_losses = static_cast<std::uint32_t>(imu.losses());
  message.dropped_imu = static_cast<std::uint32_t>(imu.dropped());
}

void fillSwitch(const Pilot& pilot, const SubsystemSwitch& subsystems,
                msgs::ControllerState& message) {
  message.active_subsystem = static_cast<std::uint8_t>(subsystems.active());
  message.switches = static_cast<std::uint32_t>(subsystems.counts().switched);
  message.switches_pending = static_cast<std::uint32_t>(pilot.switchesPending());
  message.switch_refusals = static_cast<std::uint32_t>(subsystems.objections());
  if (const auto& objection = pilot.lastObjection()) {
    message.refused_subsystem = static_cast<std::uint8_t>(objection->order.subsystem);
    message.switch_refusal = toString(objection->verdict.outcome);
  }
  message.next_switch_allowed = toRosTime(subsystems.earliest(pilot.stepClock().odometryTime()));
}

}  // namespace

void fill(const Pilot& pilot, msgs::ControllerState& message) {
  fill(pilot.sample(), message);
  message.controller = pilot.law().name();
  if (const Guard* guard = pilot.guard()) {
    message.mode = toString(guard->mode());
    message.mode_reason = textOf(guard->rule()).name;
    message.odometry_silence = pilot.silence();
  }
  message.goal_position = toPoint(pilot.goal().position);
  message.goal_yaw = pilot.goal().yaw;
  message.trajectory_stamp = toRosTime(pilot.setPointStamp());
  message.set_points_pending = static_cast<std::uint32_t>(pilot.setPointsPending());
  message.dropped_odometry = pilot.droppedOdometry();
  message.dropped_set_points = pilot.droppedSetPoints();
  if (pilot.law().usesSpecificForce()) fillImu(pilot.imu(), message);
  if (const SubsystemSwitch* subsystems = pilot.law().subsystems()) {
    fillSwitch(pilot, *subsystems, message);
  }
}

}  // namespace aqc
