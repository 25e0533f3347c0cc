#pragma once

#include <ros/time.h>

#include "adaptive_quadrotor_control/ApplyDisturbance.h"
#include "adaptive_quadrotor_control/AttachPayload.h"
#include "adaptive_quadrotor_control/DetachPayload.h"
#include "adaptive_quadrotor_control/LoseCommands.h"
#include "adaptive_quadrotor_control/SetBattery.h"
#include "adaptive_quadrotor_control/SetBody.h"
#include "adaptive_quadrotor_control/SetGust.h"
#include "adaptive_quadrotor_control/SetRotor.h"
#include "adaptive_quadrotor_control/SetWind.h"
#include "adaptive_quadrotor_control/simulation/plant_action.h"
#include "ros/border/conversions.h"

// What may happen to the plant, as the services of plant_node ask for it.

namespace aqc {

/// The service for one kind of PlantAction: its type, and its name below the plant. Declared for
/// every kind and for no other, so that a new kind does not compile before it has a service.
template <class Action>
struct PlantService;
template <>
struct PlantService<AttachPayload> {
  using Type = msgs::AttachPayload;
  static constexpr const char* kName = "attach_payload";
};
template <>
struct PlantService<DetachPayload> {
  using Type = msgs::DetachPayload;
  static constexpr const char* kName = "detach_payload";
};
template <>
struct PlantService<SetWind> {
  using Type = msgs::SetWind;
  static constexpr const char* kName = "set_wind";
};
template <>
struct PlantService<SetBody> {
  using Type = msgs::SetBody;
  static constexpr const char* kName = "set_body";
};
template <>
struct PlantService<ApplyDisturbance> {
  using Type = msgs::ApplyDisturbance;
  static constexpr const char* kName = "apply_disturbance";
};
template <>
struct PlantService<SetRotor> {
  using Type = msgs::SetRotor;
  static constexpr const char* kName = "set_rotor";
};
template <>
struct PlantService<SetBattery> {
  using Type = msgs::SetBattery;
  static constexpr const char* kName = "set_battery";
};
template <>
struct PlantService<SetGust> {
  using Type = msgs::SetGust;
  static constexpr const char* kName = "set_gust";
};
template <>
struct PlantService<LoseCommands> {
  using Type = msgs::LoseCommands;
  static constexpr const char* kName = "lose_commands";
};

/// The request for an action at a ROS time (zero: now), and the action that a request asks for:
/// one from the other without a bit lost. What a scenario file may not ask for, toAction() refuses
/// in the same words: it throws ParameterError.
msgs::AttachPayload::Request toRequest(const AttachPayload& action, const ros::Time& at);
AttachPayload toAction(const msgs::AttachPayload::Request& request);
msgs::DetachPayload::Request toRequest(const DetachPayload& action, const ros::Time& at);
DetachPayload toAction(const msgs::DetachPayload::Request& request);
msgs::SetWind::Request toRequest(const SetWind& action, const ros::Time& at);
SetWind toAction(const msgs::SetWind::Request& request);
msgs::SetBody::Request toRequest(const SetBody& action, const ros::Time& at);
SetBody toAction(const msgs::SetBody::Request& request);
msgs::ApplyDisturbance::Request toRequest(const ApplyDisturbance& action, const ros::Time& at);
ApplyDisturbance toAction(const msgs::ApplyDisturbance::Request& request);
msgs::SetRotor::Request toRequest(const SetRotor& action, const ros::Time& at);
SetRotor toAction(const msgs::SetRotor::Request& request);
msgs::SetBattery::Request toRequest(const SetBattery& action, const ros::Time& at);
SetBattery toAction(const msgs::SetBattery::Request& request);
msgs::SetGust::Request toRequest(const SetGust& action, const ros::Time& at);
SetGust toAction(const msgs::SetGust::Request& request);
msgs::LoseCommands::Request toRequest(const LoseCommands& action, const ros::Time& at);
LoseCommands toAction(const msgs::LoseCommands::Request& request);

}  // namespace aqc
