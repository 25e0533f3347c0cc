#include "adaptive_quadrotor_control/simulation/mission.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "adaptive_quadrotor_control/law/max_subsystems.h"
#include "adaptive_quadrotor_control/math/number_text.h"
#include "adaptive_quadrotor_control/parameters/parameter_reader.h"
#include "adaptive_quadrotor_control/reference/circle.h"
#include "adaptive_quadrotor_control/reference/minimum_snap.h"
#include "adaptive_quadrotor_control/reference/sampling.h"
#include "adaptive_quadrotor_control/reference/time_allocation.h"
#include "adaptive_quadrotor_control/simulation/plant_action_reader.h"
#include "simulation/ranges.h"

namespace aqc {
namespace {

const Range kYaw = Range::between(-3600.0, 3600.0);  // [deg]
constexpr double kLeastRadius = 0.01;                // of a circle [m]

std::string print(Nanoseconds time) {
  return numberText(toSeconds(time)) + " s";
}

Waypoint readWaypoint(const ParameterReader& point, double default_yaw) {
  Waypoint waypoint;
  waypoint.position = point.vector3("position", kPlace);
  waypoint.yaw = point.angle("yaw_deg", kYaw, default_yaw);
  return waypoint;
}

MotionLimits readLimits(const ParameterReader& reader) {
  return {reader.number("speed", Range::positiveUpTo(100.0)),
          reader.number("acceleration", Range::positiveUpTo(100.0)),
          reader.angle("tilt_deg", Range::positiveUpTo(80.0), M_PI / 6.0),
          reader.number("thrust_to_weight", Range{1.0, 10.0, true}, 1.5)};
}

// Goes through the entries and remembers where the vehicle should be and when the last leg ended.
class MissionBuilder {
 public:
  MissionBuilder(const std::map<std::string, Payload>& payloads, const SetPoint& start,
                 Nanoseconds set_point_period)
      : payloads_(payloads), present_(start), period_(set_point_period) {}

  void add(const ParameterReader& entry) {
    using Verb = void (MissionBuilder::*)(const ParameterReader&);
    static const std::vector<std::pair<std::string, Verb>> verbs = {
        {"step", &MissionBuilder::step},
        {"path", &MissionBuilder::path},
        {"hold", &MissionBuilder::hold},
        {"sine", &MissionBuilder::sine},
        {"circle", &MissionBuilder::circle},
        {"attach", &MissionBuilder::attach},
        {"detach", &MissionBuilder::detach},
        {"wind", &MissionBuilder::event<&readWind>},
        {"body", &MissionBuilder::event<&readBody>},
        {"rotor", &MissionBuilder::event<&readRotor>},
        {"battery", &MissionBuilder::event<&readBattery>},
        {"gust", &MissionBuilder::event<&readGust>},
        {"disturbance", &MissionBuilder::disturbance},
        {"lose_commands", &MissionBuilder::loseCommands},
        {"switch", &MissionBuilder::change}};
    const std::vector<std::string> keys = entry.keys();
    const std::string name = keys.size() == 1 ? keys.front() : "";
    std::string known;
    for (const auto& [verb, run] : verbs) {
      if (verb == name) return (this->*run)(entry.child(name));
      known += (known.empty() ? "" : ", ") + verb;
    }
    const std::string problem =
        keys.size() == 1 ? "is unknown" : "has " + std::to_string(keys.size()) + " names";
    entry.refuse(name,
                 problem + "; it must be one of " + known + ", each in a list item of its own");
  }

  Mission take() { return std::move(mission_); }

 private:
  // The time at which an entry begins.
  Nanoseconds begin(const ParameterReader& entry, Nanoseconds earliest) {
    const Nanoseconds time = entry.has("at") ? fromSeconds(entry.number("at", kTime)) : leg_end_;
    if (time < earliest) {
      entry.refuse("at", "is " + print(time) + ", before " + print(earliest) +
                             ", where the entry before it begins or its leg ends; times must not "
                             "go backwards");
    }
    last_begin_ = time;
    return time;
  }
  Nanoseconds beginLeg(const ParameterReader& entry) {
    return begin(entry, std::max(leg_end_, last_begin_));
  }
  Nanoseconds beginEvent(const ParameterReader& entry) { return begin(entry, last_begin_); }

  void step(const ParameterReader& entry) {
    const Nanoseconds time = beginLeg(entry);
    const double yaw = entry.angle("yaw_deg", kYaw, present_.yaw);
    present_ = SetPoint();
    present_.position = entry.vector3("position", kPlace);
    present_.yaw = yaw;
    mission_.set_points.push_back({time, present_});
    leg_end_ = time;
  }

  void path(const ParameterReader& entry) {
    const Nanoseconds start = beginLeg(entry);
    Waypoint present;
    present.position = present_.position;
    present.yaw = present_.yaw;
    std::vector<Waypoint> waypoints = {present};
    std::vector<double> durations;
    const bool limited = entry.has("limits");  // then the times follow from the limits
    Nanoseconds end = start;
    for (const ParameterReader& point : entry.children("through")) {
      waypoints.push_back(readWaypoint(point, waypoints.back().yaw));
      if (limited) continue;
      const Nanoseconds time = fromSeconds(point.number("at", kTime));
      if (time <= end) {
        point.refuse("at", "is " + print(time) + "; it must be after " + print(end));
      }
      durations.push_back(toSeconds(time - end));
      end = time;
    }
    if (waypoints.size() < 2) {
      entry.refuse("through", "is empty; it must list at least one waypoint");
    }
    const std::vector<TimedSetPoint> leg = setPoints(entry, waypoints, durations, start);
    mission_.set_points.insert(mission_.set_points.end(), leg.begin(), leg.end());
    present_ = leg.back().set_point;
    leg_end_ = leg.back().time;
  }

  // The set points of a path; without durations these follow from the entry's limits.
  std::vector<TimedSetPoint> setPoints(const ParameterReader& entry,
                                       const std::vector<Waypoint>& waypoints,
                                       const std::vector<double>& durations,
                                       Nanoseconds start) const {
    try {
      const PolynomialTrajectory trajectory =
          durations.empty() ? minimumSnapWithin(waypoints, readLimits(entry.child("limits")))
                            : minimumSnap(waypoints, durations);
      return sample(trajectory, start, period_, room());
    } catch (const std::invalid_argument& error) {
      entry.refuse("through", std::string("cannot be flown: ") + error.what() + before());
    }
  }

  // How many set points the mission may still have.
  long room() const { return kMostSetPoints - static_cast<long>(mission_.set_points.size()); }
  std::string before() const {
    const std::size_t count = mission_.set_points.size();
    return count == 0 ? "" : "; " + std::to_string(count) + " stand before it";
  }

  // Where an entry that begins at `begin` ends.
  static Nanoseconds readEnd(const ParameterReader& entry, Nanoseconds begin) {
    const Nanoseconds end = fromSeconds(entry.number("until", kTime));
    if (end <= begin) {
      entry.refuse("until", "is " + print(end) + "; it must be after " + print(begin));
    }
    return end;
  }

  // Where a leg that has a set point every period ends.
  Nanoseconds readLegEnd(const ParameterReader& entry, Nanoseconds start) const {
    const Nanoseconds end = readEnd(entry, start);
    try {
      requireFewSetPoints(toSeconds(end - start), period_, room());
    } catch (const std::invalid_argument& error) {
      entry.refuse("until", std::string("is too late: ") + error.what() + before());
    }
    return end;
  }

  // At rest from there on.
  void endLeg(Nanoseconds end, const Eigen::Vector3d& place, double yaw) {
    present_ = SetPoint();
    present_.position = place;
    present_.yaw = yaw;
    mission_.set_points.push_back({end, present_});
    leg_end_ = end;
  }

  // Around a centre at the height and the distance of where the vehicle should be.
  void circle(const ParameterReader& entry) {
    const Nanoseconds start = beginLeg(entry);
    const Nanoseconds end = readLegEnd(entry, start);
    const std::vector<double> centre = entry.numbers("centre", 2, kPlace);
    const Circle circle = {present_.position,
                           {centre[0], centre[1]},
                           entry.number("angular_frequency", kAngularFrequency),
                           entry.number("ease", kTime, 0.0)};
    if ((circle.start.head<2>() - circle.centre).norm() < kLeastRadius) {
      entry.refuseValue("centre", "away from where the entry before ends");
    }
    SetPoint point;
    for (Nanoseconds time = start; time < end; time += period_) {
      point = onCircle(circle, toSeconds(time - start));
      point.yaw = present_.yaw;
      mission_.set_points.push_back({time, point});
    }
    endLeg(end, onCircle(circle, toSeconds(end - start)).position, present_.yaw);
  }

  void sine(const ParameterReader& entry) {
    const Nanoseconds start = beginLeg(entry);
    const Nanoseconds end = readLegEnd(entry, start);
    const Eigen::Vector3d middle = entry.vector3("position", kPlace);
    const Eigen::Vector3d amplitude = entry.vector3("amplitude", kPlace);
    const double frequency = entry.number("angular_frequency", kAngularFrequency);
    SetPoint point;
    point.yaw = entry.angle("yaw_deg", kYaw, present_.yaw);
    for (Nanoseconds time = start; time < end; time += period_) {
      const double phase = frequency * toSeconds(time - start);
      point.position = middle + amplitude * std::sin(phase);
      point.velocity = amplitude * (frequency * std::cos(phase));
      point.acceleration = amplitude * (-frequency * frequency * std::sin(phase));
      point.jerk = amplitude * (-frequency * frequency * frequency * std::cos(phase));
      mission_.set_points.push_back({time, point});
    }
    endLeg(end, middle + amplitude * std::sin(frequency * toSeconds(end - start)), point.yaw);
  }

  void hold(const ParameterReader& entry) { leg_end_ += fromSeconds(entry.number("for", kTime)); }

  void plan(Nanoseconds time, PlantAction action) {
    PlantEvent event;
    event.time = time;
    event.action = std::move(action);
    mission_.events.push_back(std::move(event));
  }

  void attach(const ParameterReader& entry) {
    const Nanoseconds time = beginEvent(entry);
    const std::string name = entry.text("payload");
    const auto payload = payloads_.find(name);
    if (payload == payloads_.end()) {
      entry.refuseValue("payload", "a name of the scenario's 'payloads'");
    }
    if (attached_) {
      entry.refuseValue("payload", "attached after the one that is already attached is detached");
    }
    attached_ = true;
    plan(time, AttachPayload{name, payload->second});
  }

  void detach(const ParameterReader& entry) {
    const Nanoseconds time = beginEvent(entry);
    if (!attached_) entry.refuse("at", "detaches nothing: no payload is attached then");
    attached_ = false;
    plan(time, DetachPayload{});
  }

  // What `read` makes of the entry happens to the plant.
  template <auto read>
  void event(const ParameterReader& entry) {
    const Nanoseconds time = beginEvent(entry);
    plan(time, read(entry));
  }

  void disturbance(const ParameterReader& entry) {
    const Nanoseconds time = beginEvent(entry);
    plan(time, readDisturbance(entry, readEnd(entry, time) - time));
  }

  void loseCommands(const ParameterReader& entry) {
    const Nanoseconds time = beginEvent(entry);
    const double duration = entry.number("for", kDisturbed);
    plan(time, readLostCommands(entry, fromSeconds(duration)));
  }

  void change(const ParameterReader& entry) {
    const Nanoseconds time = beginEvent(entry);
    mission_.switches.push_back({time, entry.integer("subsystem", 1, kMaxSubsystems)});
  }

  const std::map<std::string, Payload>& payloads_;
  SetPoint present_;
  Nanoseconds period_;
  Nanoseconds last_begin_ = 0;
  Nanoseconds leg_end_ = 0;
  bool attached_ = false;
  Mission mission_;
};

}  // namespace

Mission readMission(const ParameterReader& scenario, const std::map<std::string, Payload>& payloads,
                    const SetPoint& start, Nanoseconds set_point_period) {
  MissionBuilder builder(payloads, start, set_point_period);
  for (const ParameterReader& entry : scenario.children("mission")) builder.add(entry);
  return builder.take();
}

}  // namespace aqc
