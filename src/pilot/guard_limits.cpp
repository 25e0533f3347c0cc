#include "adaptive_quadrotor_control/pilot/guard_limits.h"

#include "adaptive_quadrotor_control/math/constants.h"
#include "adaptive_quadrotor_control/parameters/parameter_reader.h"

namespace aqc {
namespace {

constexpr double kMost = 1e6;

void readPositive(const ParameterReader& reader, const char* key, double& value) {
  value = reader.number(key, Range::positiveUpTo(kMost), value);
}

void readAngle(const ParameterReader& reader, const std::string& key, double& value) {
  if (reader.has(key)) value = reader.angle(key, Range::positiveUpTo(180.0));
}

void readGate(const ParameterReader& reader, GateLimits& limits) {
  limits.stamp_ahead = fromSeconds(
      reader.number("stamp_ahead", Range::positiveUpTo(kMost), toSeconds(limits.stamp_ahead)));
  readPositive(reader, "position", limits.position);
  readPositive(reader, "velocity", limits.velocity);
  readPositive(reader, "body_rate", limits.body_rate);
  readPositive(reader, "specific_force", limits.specific_force);
  readPositive(reader, "norm", limits.norm);
  readPositive(reader, "jump", limits.jump);
  readPositive(reader, "speed_jump", limits.speed_jump);
  readAngle(reader, "turn_jump_deg", limits.turn_jump);
  if (reader.has("confirmations")) {
    limits.confirmations = reader.integer("confirmations", 1, 1000);
  }
}

}  // namespace

GuardLimits readGuardLimits(const ParameterReader& reader) {
  GuardLimits limits;
  limits.auto_arm = reader.flag("auto_arm", limits.auto_arm);
  if (reader.has("gate")) readGate(reader.child("gate"), limits.gate);
  if (reader.has("governor")) limits.governor = readGovernorLimits(reader.child("governor"));
  readPositive(reader, "odometry_late", limits.odometry_late);
  readPositive(reader, "odometry_lost", limits.odometry_lost);
  limits.set_point_age =
      reader.number("set_point_age", Range::between(0.0, kMost), limits.set_point_age);
  readPositive(reader, "set_point_bound", limits.set_point_bound);
  readPositive(reader, "trajectory_lead", limits.trajectory_lead);
  limits.ground = reader.number("ground", Range::between(-kMost, kMost), limits.ground);
  limits.clearance = reader.number("clearance", Range::between(0.0, kMost), limits.clearance);
  readPositive(reader, "take_off_height", limits.take_off_height);
  readPositive(reader, "take_off_speed", limits.take_off_speed);
  readPositive(reader, "lift_off_time", limits.lift_off_time);
  readPositive(reader, "landing_speed", limits.landing_speed);
  readPositive(reader, "touch_down_time", limits.touch_down_time);
  readPositive(reader, "descent_speed", limits.descent_speed);
  limits.idle_speed = reader.number("idle_speed", Range::between(0.0, kMost), limits.idle_speed);
  readAngle(reader, "tumble_tilt_deg", limits.tumble_tilt);
  readPositive(reader, "tumble_time", limits.tumble_time);
  readAngle(reader, "tip_tilt_deg", limits.tip_tilt);
  readPositive(reader, "tip_time", limits.tip_time);
  readPositive(reader, "overload", limits.overload);
  readPositive(reader, "overload_time", limits.overload_time);
  readPositive(reader, "saturation_time", limits.saturation_time);
  readPositive(reader, "rotor_loss", limits.rotor_loss);
  readPositive(reader, "rotor_loss_time", limits.rotor_loss_time);
  readPositive(reader, "lag", limits.lag);
  return limits;
}

}  // namespace aqc
