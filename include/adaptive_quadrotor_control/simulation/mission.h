#pragma once

#include <map>
#include <string>
#include <vector>

#include "adaptive_quadrotor_control/law/switched/switch_schedule.h"
#include "adaptive_quadrotor_control/reference/set_point_schedule.h"
#include "adaptive_quadrotor_control/simulation/plant_action.h"

namespace aqc {

class ParameterReader;

/// A mission list, worked out: what to fly, what happens to the plant, and when a law with several
/// subsystems changes between them; each by time.
struct Mission {
  std::vector<TimedSetPoint> set_points;
  std::vector<PlantEvent> events;
  std::vector<SwitchOrder> switches;
};

/// Reads the list `mission` of a scenario, whose entries are maps of one name each:
///
///     step:   {at, position: [x, y, z], yaw_deg}      jump of the set point
///     path:   {at, through: [{at, position, yaw_deg}, ...]}
///             minimum snap from the present set point through these, at rest at both ends
///     path:   {at, limits: {speed, acceleration, tilt_deg, thrust_to_weight}, through: [...]}
///             the same as fast as the limits allow, its waypoints without times; tilt_deg and
///             thrust_to_weight are 30 and 1.5 when not given
///     sine:   {at, until, position: [x, y, z], amplitude: [x, y, z], angular_frequency, yaw_deg}
///             position + amplitude sin(angular_frequency (t - at)), at rest where it ends
///     circle: {at, until, centre: [x, y], angular_frequency, ease}
///             from the present set point around the centre, level and counter-clockwise; its rate
///             [rad/s] grows for `ease` seconds. It ends in motion
///     hold:   {for}                                   nothing new for so many seconds
///     attach: {at, payload}                           a name of the scenario's `payloads`
///     detach: {at}
///     wind:   {at, velocity: [x, y, z]}
///     gust:   {at, intensity: [x, y, z], length, speed, seed}
///             turbulence on top of the wind: standard deviations [m/s], zeros for calm; length [m]
///             and speed [m/s] at which it passes by are 10 and 5 when not given: see SetGust
///     body:   {at, mass, inertia: [xx, yy, zz]}       the vehicle itself becomes another one
///     rotor:  {at, number, effectiveness, stuck_at, slower}
///             rotor `number` of the vehicle's file (the first is 1) breaks: it gives that share of
///             thrust and drag moment, turns at stuck_at [rad/s] whatever is commanded, and its
///             time constants are so many times longer; what is not given is sound (again)
///     battery: {at, voltage, over}
///             its voltage goes to that share of the full one, linearly over so many seconds or at
///             once, and with it the greatest speed that the rotors can reach: see SetBattery
///     disturbance: {at, until, force: [x, y, z], moment: [x, y, z], angular_frequency}
///             in W [N] and in B [N m]; constant, or with a frequency [rad/s] a sine from 0
///     lose_commands: {at, share, for, seed}
///             so many seconds long that share of the motor commands is lost; the last one that was
///             heard stays, until the world's time-out
///     switch: {at, subsystem}                         laws without subsystems ignore it
///
/// `at` is a time in seconds; without it the entry begins when the last leg (step, path, sine,
/// circle or hold) ends. `yaw_deg` stays as it was when not given. Entries stand in the order of
/// the times at which they begin, and a leg begins no earlier than the last one ends.
///
/// A path, a sine or a circle becomes set points with velocity, acceleration and jerk, one every
/// `set_point_period`; one with which the mission has more than kMostSetPoints is refused. Throws
/// ParameterError.
Mission readMission(const ParameterReader& scenario, const std::map<std::string, Payload>& payloads,
                    const SetPoint& start, Nanoseconds set_point_period);

}  // namespace aqc
