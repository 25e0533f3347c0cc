#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "adaptive_quadrotor_control/simulation/closed_loop.h"
#include "adaptive_quadrotor_control/simulation/scenario.h"
#include "support/fixtures.h"

/// Flights that begin at rest in a hover at 2 m, at 250 Hz. Masses in kg, lengths in m, times in s.
namespace aqc::test {

inline Scenario hovering(double seconds) {
  Scenario scenario;
  scenario.duration = fromSeconds(seconds);
  scenario.world.control_period = 4'000'000;
  scenario.world.plant_step = 1'000'000;
  scenario.world.start.position.z() = 2.0;
  TimedSetPoint place;
  place.set_point.position.z() = 2.0;
  scenario.mission.set_points = {place};
  return scenario;
}

/// A box hung `aside` of the centre, from the first of two times to the second.
inline Scenario carrying(double mass, double aside,
                         const std::pair<double, double>& times = {10.0, 25.0},
                         double seconds = 40.0) {
  Scenario scenario = hovering(seconds);
  AttachPayload attach;
  attach.payload = box(mass);
  attach.payload.offset.x() = aside;
  scenario.mission.events = {{fromSeconds(times.first), attach},
                             {fromSeconds(times.second), DetachPayload{}}};
  return scenario;
}

/// A circle of 2 m at that rate [rad/s]; of a mass, a box is hung on at 5 s.
inline Scenario circling(double rate, double mass, double seconds = 30.0) {
  Scenario scenario = hovering(seconds);
  scenario.mission.set_points.clear();
  for (Nanoseconds time = 0; time < scenario.duration; time += scenario.world.control_period / 8) {
    const double angle = rate * toSeconds(time);
    const Eigen::Vector3d out(std::cos(angle), std::sin(angle), 0.0);
    const Eigen::Vector3d along(-out.y(), out.x(), 0.0);
    SetPoint point;
    point.position = 2.0 * out + Eigen::Vector3d(0.0, 0.0, 2.0);
    point.velocity = 2.0 * rate * along;
    point.acceleration = -2.0 * rate * rate * out;
    point.jerk = -2.0 * rate * rate * rate * along;
    scenario.mission.set_points.push_back({time, point});
  }
  scenario.world.start.position.x() = 2.0;
  if (mass > 0.0) {
    AttachPayload attach;
    attach.payload = box(mass);
    scenario.mission.events = {{fromSeconds(5.0), attach}};
  }
  return scenario;
}

/// A wind [m/s] along x from a time on.
inline Scenario blown(double speed, double from, double seconds) {
  Scenario scenario = hovering(seconds);
  SetWind wind;
  wind.velocity.x() = speed;
  scenario.mission.events = {{fromSeconds(from), wind}};
  return scenario;
}

/// Steps of 0.3 m, then of 2 m, beyond the linear part of the surface.
inline Scenario stepping(double seconds) {
  Scenario scenario = hovering(seconds);
  const std::pair<double, Eigen::Vector3d> places[] = {
      {1.0, {0.3, -0.1, 2.2}}, {3.0, {2.0, 0.5, 1.5}}, {5.0, {0.0, 0.0, 2.5}}};
  for (const auto& [time, position] : places) {
    TimedSetPoint place;
    place.time = fromSeconds(time);
    place.set_point.position = position;
    scenario.mission.set_points.push_back(place);
  }
  return scenario;
}

/// The sensors as they are, but the IMU is silent, or odometry is late.
inline Scenario sensing(Scenario scenario, bool imu, Nanoseconds delay) {
  SensorFaults faults;
  faults.odometry.period = faults.imu.period = scenario.world.control_period;
  faults.odometry.delay = delay;
  if (!imu) faults.imu.gaps = {TimeWindow()};
  scenario.world.sensors = faults;
  return scenario;
}

struct Errors {
  double z = 0.0;     // largest ones [cm]
  double side = 0.0;  // horizontally
  double square = 0.0;
  int count = 0;
  double rms() const { return std::sqrt(square / count); }
};

/// The true errors of a flight under `composite`, made for `believed`, within a window [s].
class Flown {
 public:
  Flown(const Scenario& scenario, const Vehicle& flown, const Vehicle& believed)
      : period_(toSeconds(scenario.world.control_period)) {
    ClosedLoop loop(scenario, flown, believed, lawNamed("composite", believed));
    while (!loop.done()) {
      const State state = loop.plant().plant().state();
      loop.advance();
      errors_.push_back(100.0 * (state.position - loop.pilot().goal().position));
      tilts_.push_back(std::acos(std::min((state.attitude * Eigen::Vector3d::UnitZ()).z(), 1.0)));
      overloaded_.push_back(loop.pilot().overloaded());
    }
    crashed_ = loop.plant().crashTime().has_value();
  }
  Flown(const Scenario& scenario, const std::string& vehicle)
      : Flown(scenario, vehicleNamed(vehicle), vehicleNamed(vehicle)) {}

  Errors within(double from, double until) const {
    Errors errors;
    for (std::size_t i = at(from); i < at(until); ++i) {
      errors.z = std::max(errors.z, std::abs(errors_[i].z()));
      errors.side = std::max(errors.side, errors_[i].head<2>().norm());
      errors.square += errors_[i].squaredNorm();
      ++errors.count;
    }
    return errors;
  }
  /// The largest one [deg].
  double tilt(double from, double until) const {
    double tilt = 0.0;
    for (std::size_t i = at(from); i < at(until); ++i) tilt = std::max(tilt, tilts_[i]);
    return tilt * 180.0 / M_PI;
  }
  /// When an overload was first told [s]; infinity: never.
  double toldOverload() const {
    for (std::size_t i = 0; i < overloaded_.size(); ++i) {
      if (overloaded_[i]) return static_cast<double>(i) * period_;
    }
    return std::numeric_limits<double>::infinity();
  }
  bool crashed() const { return crashed_; }

 private:
  std::size_t at(double time) const {
    return std::min(errors_.size(), static_cast<std::size_t>(time / period_));
  }

  std::vector<Eigen::Vector3d> errors_;
  std::vector<double> tilts_;  // [rad]
  std::vector<bool> overloaded_;
  double period_;
  bool crashed_ = false;
};

}  // namespace aqc::test
