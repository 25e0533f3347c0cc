#include "adaptive_quadrotor_control/pilot/guard_rules.h"

namespace aqc {

const std::array<RuleText, 22>& guardRules() noexcept {
  static constexpr std::array<RuleText, 22> kRules = {{
      {Rule::kNone, "none", "nothing has happened", "disarmed"},
      {Rule::kOperator, "operator", "a service was called", "what it asks for"},
      {Rule::kAutoArm, "auto arm", "`auto_arm`, and a set point asks for height", "arm, take off"},
      {Rule::kAirborne, "airborne", "the controller starts, armed before, and is in the air",
       "take over and hold"},
      {Rule::kTakenOff, "taken off", "`take_off_height` is reached",
       "hold, or fly what was planned"},
      {Rule::kSetPoint, "set point", "a new set point while holding", "fly it"},
      {Rule::kSetPointOld, "set point old", "none for `set_point_age`", "brake and hold"},
      {Rule::kOdometryLate, "odometry late", "none for `odometry_late`",
       "fly by dead reckoning; learn nothing without an IMU"},
      {Rule::kOdometryLost, "odometry lost", "none for `odometry_lost`",
       "level, descend at `descent_speed` by dead reckoning"},
      {Rule::kOdometryBack, "odometry back", "it comes again", "hold where the vehicle is"},
      {Rule::kSourceReset, "source reset", "`gate/confirmations` messages jumped and agree",
       "the reference moves with the estimate, hold"},
      {Rule::kClockStep, "clock step", "stamps go back by more than `new_start` in the air",
       "forget plans of the old time, hold"},
      {Rule::kNotFollowing, "not following", "at the end of the governor's lead for `lag`",
       "hold where the vehicle is"},
      {Rule::kOverload, "overload", "mass carried over `overload` of the lift for `overload_time`",
       "land"},
      {Rule::kSaturation, "saturation",
       "no thrust left and below the set point for `saturation_time`", "land"},
      {Rule::kLawNotFinite, "law not finite", "what the law learned is not finite",
       "it forgets, land"},
      {Rule::kRotorLoss, "rotor loss",
       "in the air a moment about x and y that no rotor should give, over `rotor_loss` of a "
       "hovering rotor's for `rotor_loss_time`",
       "land"},
      {Rule::kNoLiftOff, "no lift-off", "not 5 cm up within `lift_off_time`", "disarm"},
      {Rule::kTouchDown, "touch-down", "landing, and no sinking for `touch_down_time`", "disarm"},
      {Rule::kTipped, "tipped over",
       "close to the ground and tilted by `tip_tilt` for `tip_time`; a third of it for a sixth of "
       "the time before lift-off",
       "disarm"},
      {Rule::kTumble, "tumble", "tilted by `tumble_tilt` for `tumble_time`", "disarm"},
      {Rule::kBlindEnd, "blind end", "descended blindly long enough to be down", "disarm"},
  }};
  return kRules;
}

}  // namespace aqc
