#include "report/flight_columns.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>

#include "adaptive_quadrotor_control/math/rotations.h"

namespace aqc {
namespace {

constexpr std::array<const char*, 4> kQuaternion = {"x", "y", "z", "w"};  // as Eigen stores it

using Sample = FlightSample;

// Collects columns. An `access` returns a reference into the sample it is given, const or not.
class Columns {
 public:
  void addTime() {
    columns_.push_back({"t [s]", [](const Sample& s) { return toSeconds(s.time); },
                        [](Sample& s, double value) {
                          constexpr double kLongest = 1e6;  // nanoseconds survive till then
                          if (!(std::abs(value) <= kLongest)) {
                            throw std::invalid_argument("must be a time of at most 1e6 s");
                          }
                          s.time = fromSeconds(value);
                        }});
  }

  template <class Access>
  void add(const std::string& name, const std::string& unit, Access access) {
    columns_.push_back({full(name, unit), [access](const Sample& s) { return access(s); },
                        [access](Sample& s, double value) { access(s) = value; }});
  }

  template <class Access>
  void addFlag(const std::string& name, Access access) {
    columns_.push_back({name, [access](const Sample& s) { return access(s) ? 1.0 : 0.0; },
                        [access](Sample& s, double value) {
                          if (value != 0.0 && value != 1.0) {
                            throw std::invalid_argument("must be 0 or 1");
                          }
                          access(s) = value == 1.0;
                        }});
  }

  // Of the set point or of a step of the control law: there only while a set point is active.
  template <class Access>
  void addActive(const std::string& name, const std::string& unit, Access access) {
    columns_.push_back({full(name, unit),
                        [access](const Sample& s) { return s.flying ? access(s) : kNothing; },
                        [access](Sample& s, double value) {
                          if (s.flying) access(s) = value;
                        }});
  }

  // Vectors become a column an entry.
  template <std::size_t Size, class Access>
  void addVector(const std::string& prefix, const std::array<const char*, Size>& names,
                 const std::string& unit, Access access) {
    forEach(prefix, names, [&](const std::string& name, Eigen::Index i) {
      add(
          name, unit, [ access, i ](auto& s) -> auto& { return access(s)[i]; });
    });
  }

  template <std::size_t Size, class Access>
  void addActiveVector(const std::string& prefix, const std::array<const char*, Size>& names,
                       const std::string& unit, Access access) {
    forEach(prefix, names, [&](const std::string& name, Eigen::Index i) {
      addActive(
          name, unit, [ access, i ](auto& s) -> auto& { return access(s)[i]; });
    });
  }

  // Roll, pitch, yaw of a quaternion that has columns of its own.
  template <class Attitude>
  void addAngles(const std::string& prefix, Attitude attitude) {
    forEach(prefix, kAngles, [&](const std::string& name, Eigen::Index i) {
      columns_.push_back(
          {full(name, "rad"), [attitude, i](const Sample& s) { return attitude(s)[i]; }, {}});
    });
  }

  // An entry of an array whose size is known only from the samples.
  template <class Access>
  void addEntry(const std::string& name, const std::string& unit, Access access, Eigen::Index i) {
    columns_.push_back(
        {full(name, unit),
         [access, i](const Sample& s) { return i < access(s).size() ? access(s)[i] : kNothing; },
         [access, i](Sample& s, double value) {
           // The last one comes first; entries at the end that are nothing are not there.
           if (i >= access(s).size() && std::isnan(value)) return;
           if (i >= access(s).size()) access(s).resize(i + 1);
           access(s)[i] = value;
         }});
  }

  std::vector<FlightColumn> take() { return std::move(columns_); }

 private:
  static std::string full(const std::string& name, const std::string& unit) {
    return name + (unit.empty() ? "" : " [" + unit + "]");
  }

  template <std::size_t Size, class Add>
  static void forEach(const std::string& prefix, const std::array<const char*, Size>& names,
                      Add add) {
    for (std::size_t i = 0; i < Size; ++i) add(prefix + names[i], static_cast<Eigen::Index>(i));
  }

  std::vector<FlightColumn> columns_;
};

void addMotion(Columns& columns) {
  columns.addVector(
      "", kAxes, "m", [](auto& s) -> auto& { return s.state.position; });
  columns.addAngles("", [](const Sample& s) { return rollPitchYaw(s.state.attitude); });
  columns.addVector(
      "attitude_", kQuaternion, "", [](auto& s) -> auto& { return s.state.attitude.coeffs(); });
  columns.addVector(
      "velocity_", kAxes, "m/s", [](auto& s) -> auto& { return s.state.velocity; });
  columns.addVector(
      "body_rate_", kAxes, "rad/s", [](auto& s) -> auto& { return s.state.body_rate; });
}

void addSetPoint(Columns& columns) {
  columns.addActiveVector(
      "set_", kAxes, "m", [](auto& s) -> auto& { return s.set_point.position; });
  columns.addActive(
      "set_yaw", "rad", [](auto& s) -> auto& { return s.set_point.yaw; });
  columns.addActiveVector(
      "set_velocity_", kAxes, "m/s", [](auto& s) -> auto& { return s.set_point.velocity; });
  columns.addActiveVector(
      "set_acceleration_", kAxes, "m/s^2",
      [](auto& s) -> auto& { return s.set_point.acceleration; });
  columns.addActive(
      "set_yaw_rate", "rad/s", [](auto& s) -> auto& { return s.set_point.yaw_rate; });
}

void addLaw(Columns& columns) {
  columns.addActiveVector(
      "error_", kAxes, "m", [](auto& s) -> auto& { return s.telemetry.position_error; });
  columns.addActiveVector(
      "error_velocity_", kAxes, "m/s", [](auto& s) -> auto& { return s.telemetry.velocity_error; });
  columns.addActiveVector(
      "error_", kAngles, "rad", [](auto& s) -> auto& { return s.telemetry.attitude_error; });
  columns.addActiveVector(
      "error_rate_", kAxes, "rad/s", [](auto& s) -> auto& { return s.telemetry.rate_error; });
  columns.addAngles("desired_", [](const Sample& s) -> Eigen::Vector3d {
    return s.flying ? rollPitchYaw(s.telemetry.desired_attitude)
                    : Eigen::Vector3d::Constant(kNothing);
  });
  columns.addActiveVector(
      "desired_attitude_", kQuaternion, "",
      [](auto& s) -> auto& { return s.telemetry.desired_attitude.coeffs(); });
  columns.addActiveVector(
      "sliding_", kAxes, "m/s", [](auto& s) -> auto& { return s.telemetry.sliding_position; });
  columns.addActiveVector(
      "sliding_", kAngles, "rad/s", [](auto& s) -> auto& { return s.telemetry.sliding_attitude; });
  columns.addActiveVector(
      "force_", kAxes, "N", [](auto& s) -> auto& { return s.telemetry.force; });
  columns.add(
      "mass_estimate", "kg", [](auto& s) -> auto& { return s.telemetry.mass_estimate; });
}

void addRotors(Columns& columns, Eigen::Index rotors) {
  const auto wrench = [&columns](const std::string& suffix, Wrench Allocation::*member) {
    columns.add(
        "thrust" + suffix,
        "N", [member](auto& s) -> auto& { return (s.allocation.*member).thrust; });
    columns.addVector(
        "moment" + suffix + "_", kAxes,
        "N m", [member](auto& s) -> auto& { return (s.allocation.*member).moment; });
  };
  wrench("", &Allocation::requested);
  wrench("_achieved", &Allocation::achieved);
  columns.addFlag(
      "saturated", [](auto& s) -> auto& { return s.allocation.saturated; });
  for (Eigen::Index i = 0; i < rotors; ++i) {
    columns.addEntry(
        "rotor_" + std::to_string(i + 1), "rad/s",
        [](auto& s) -> auto& { return s.allocation.speeds; }, i);
  }
}

void addDisturbance(Columns& columns) {
  columns.addVector(
      "disturbance_force_", kAxes, "N", [](auto& s) -> auto& { return s.disturbance.force; });
  columns.addVector(
      "disturbance_moment_", kAxes, "N m", [](auto& s) -> auto& { return s.disturbance.moment; });
}

}  // namespace

FlightLayout layoutOf(const FlightLog& log) {
  const auto disturbed = [](const Sample& s) {
    return !s.disturbance.force.isZero(0.0) || !s.disturbance.moment.isZero(0.0);
  };
  FlightLayout layout;
  for (const AdaptiveQuantity& quantity : log.adaptive_quantities) {
    layout.adaptive_names.push_back(quantity.name);
  }
  if (!log.samples.empty()) layout.rotors = log.samples.front().allocation.speeds.size();
  layout.disturbed = std::any_of(log.samples.begin(), log.samples.end(), disturbed);
  return layout;
}

std::vector<FlightColumn> flightColumns(const FlightLayout& layout) {
  Columns columns;
  columns.addTime();
  addMotion(columns);
  addSetPoint(columns);
  addLaw(columns);
  for (std::size_t i = 0; i < layout.adaptive_names.size(); ++i) {
    columns.addEntry(
        layout.adaptive_names[i], "", [](auto& s) -> auto& { return s.telemetry.adaptive; },
        static_cast<Eigen::Index>(i));
  }
  addRotors(columns, layout.rotors);
  columns.add(
      "payload_mass", "kg", [](auto& s) -> auto& { return s.payload_mass; });
  if (layout.disturbed) addDisturbance(columns);  // most scenarios have none
  columns.addFlag(
      "touching", [](auto& s) -> auto& { return s.touching; });
  columns.addFlag(
      "flying", [](auto& s) -> auto& { return s.flying; });
  return columns.take();
}

}  // namespace aqc
