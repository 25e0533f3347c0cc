#include "adaptive_quadrotor_control/tools/flight_files.h"

#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <limits>
#include <optional>
#include <stdexcept>
#include <system_error>
#include <utility>

#include "adaptive_quadrotor_control/model/rotations.h"

namespace aqc {
namespace {

namespace fs = std::filesystem;

constexpr double kNothing = std::numeric_limits<double>::quiet_NaN();
constexpr std::array<const char*, 3> kAxes = {"x", "y", "z"};
constexpr std::array<const char*, 3> kAngles = {"roll", "pitch", "yaw"};

using Vector = Eigen::Vector3d;
using Sample = FlightSample;

// Collects columns; vectors become three of them.
class Columns {
 public:
  template <class Value>
  void add(const std::string& name, const std::string& unit, Value value) {
    columns_.push_back(
        {name + (unit.empty() ? "" : " [" + unit + "]"),
         [value](const Sample& sample) { return static_cast<double>(value(sample)); }});
  }

  template <class Value>
  void addVector(const std::string& prefix, const std::array<const char*, 3>& names,
                 const std::string& unit, Value value) {
    for (Eigen::Index i = 0; i < 3; ++i) {
      add(prefix + names[static_cast<std::size_t>(i)], unit,
          [value, i](const Sample& sample) { return Vector(value(sample))[i]; });
    }
  }

  // Of the set point or of a step of the control law: there only while a set point is active.
  template <class Value>
  void addActiveVector(const std::string& prefix, const std::array<const char*, 3>& names,
                       const std::string& unit, Value value) {
    addVector(prefix, names, unit, [value](const Sample& sample) -> Vector {
      return sample.flying ? Vector(value(sample)) : Vector::Constant(kNothing);
    });
  }

  std::vector<FlightColumn> take() { return std::move(columns_); }

 private:
  std::vector<FlightColumn> columns_;
};

// An entry of an array whose size is known only from the samples.
template <class Array>
double entry(const Array& array, Eigen::Index i) {
  return i < array.size() ? array[i] : kNothing;
}

void addMotion(Columns& columns) {
  columns.addVector("", kAxes, "m", [](const Sample& s) { return s.state.position; });
  columns.addVector("", kAngles, "rad",
                    [](const Sample& s) { return rollPitchYaw(s.state.attitude); });
  columns.addVector("velocity_", kAxes, "m/s", [](const Sample& s) { return s.state.velocity; });
  columns.addVector("body_rate_", kAxes, "rad/s",
                    [](const Sample& s) { return s.state.body_rate; });
}

void addSetPoint(Columns& columns) {
  columns.addActiveVector("set_", kAxes, "m", [](const Sample& s) { return s.set_point.position; });
  columns.add("set_yaw", "rad",
              [](const Sample& s) { return s.flying ? s.set_point.yaw : kNothing; });
  columns.addActiveVector("set_velocity_", kAxes, "m/s",
                          [](const Sample& s) { return s.set_point.velocity; });
  columns.addActiveVector("set_acceleration_", kAxes, "m/s^2",
                          [](const Sample& s) { return s.set_point.acceleration; });
  columns.add("set_yaw_rate", "rad/s",
              [](const Sample& s) { return s.flying ? s.set_point.yaw_rate : kNothing; });
}

void addLaw(Columns& columns) {
  columns.addActiveVector("error_", kAxes, "m",
                          [](const Sample& s) { return s.telemetry.position_error; });
  columns.addActiveVector("error_velocity_", kAxes, "m/s",
                          [](const Sample& s) { return s.telemetry.velocity_error; });
  columns.addActiveVector("error_", kAngles, "rad",
                          [](const Sample& s) { return s.telemetry.attitude_error; });
  columns.addActiveVector("error_rate_", kAxes, "rad/s",
                          [](const Sample& s) { return s.telemetry.rate_error; });
  columns.addActiveVector("desired_", kAngles, "rad", [](const Sample& s) {
    return rollPitchYaw(s.telemetry.desired_attitude);
  });
  columns.addActiveVector("sliding_", kAxes, "m/s",
                          [](const Sample& s) { return s.telemetry.sliding_position; });
  columns.addActiveVector("sliding_", kAngles, "rad/s",
                          [](const Sample& s) { return s.telemetry.sliding_attitude; });
  columns.addActiveVector("force_", kAxes, "N", [](const Sample& s) { return s.telemetry.force; });
  columns.add("mass_estimate", "kg", [](const Sample& s) { return s.telemetry.mass_estimate; });
}

void addRotors(Columns& columns, const FlightLog& log) {
  const auto wrench = [&columns](const std::string& suffix, Wrench Allocation::*member) {
    columns.add("thrust" + suffix, "N",
                [member](const Sample& s) { return (s.allocation.*member).thrust; });
    columns.addVector("moment" + suffix + "_", kAxes, "N m",
                      [member](const Sample& s) { return (s.allocation.*member).moment; });
  };
  wrench("", &Allocation::requested);
  wrench("_achieved", &Allocation::achieved);
  columns.add("saturated", "", [](const Sample& s) { return s.allocation.saturated; });
  const Eigen::Index rotors =
      log.samples.empty() ? 0 : log.samples.front().allocation.speeds.size();
  for (Eigen::Index i = 0; i < rotors; ++i) {
    columns.add("rotor_" + std::to_string(i + 1), "rad/s",
                [i](const Sample& s) { return entry(s.allocation.speeds, i); });
  }
}

// Only where there is one: most scenarios have none.
void addDisturbance(Columns& columns, const FlightLog& log) {
  const auto disturbed = [](const Sample& s) {
    return !s.disturbance.force.isZero(0.0) || !s.disturbance.moment.isZero(0.0);
  };
  if (std::none_of(log.samples.begin(), log.samples.end(), disturbed)) return;
  columns.addVector("disturbance_force_", kAxes, "N",
                    [](const Sample& s) { return s.disturbance.force; });
  columns.addVector("disturbance_moment_", kAxes, "N m",
                    [](const Sample& s) { return s.disturbance.moment; });
}

void appendNumber(std::string& text, double value, int digits) {
  if (std::isnan(value)) return;
  char buffer[32];
  text.append(buffer, static_cast<std::size_t>(
                          std::snprintf(buffer, sizeof buffer, "%.*g", digits, value)));
}

// JSON knows no not-a-number and no infinity.
nlohmann::json number(double value) {
  return std::isfinite(value) ? nlohmann::json(value) : nlohmann::json(nullptr);
}

nlohmann::json number(const std::optional<double>& value) {
  return value ? number(*value) : nlohmann::json(nullptr);
}

nlohmann::json metricsJson(const FlightLog& log, const Scenario& scenario) {
  const FlightMetrics metrics = measure(log, scenario);
  nlohmann::json rms;
  for (std::size_t i = 0; i < 3; ++i) {
    rms[kAxes[i]] = number(metrics.rms.position[static_cast<Eigen::Index>(i)]);
    rms[kAngles[i]] = number(metrics.rms.attitude[static_cast<Eigen::Index>(i)]);
  }
  nlohmann::json refusals = nlohmann::json::array();
  for (const auto& refusal : log.refusals) {
    refusals.push_back({{"time", toSeconds(refusal.time)}, {"reason", refusal.reason}});
  }
  return {
      {"controller", log.controller},
      {"rms", rms},
      {"peak_altitude_error", number(metrics.peak_altitude_error)},
      {"settled_altitude_error", number(metrics.settled_altitude_error)},
      {"final_lateral_error", number(metrics.final_lateral_error)},
      {"crashed", metrics.crash_time.has_value()},
      {"crash_time", number(metrics.crash_time)},
      {"grounded_from", number(metrics.grounded_from)},
      {"refusals", refusals},
      {"duration", number(metrics.duration)},
      {"real_time_factor", number(log.real_time_factor > 0.0 ? log.real_time_factor : kNothing)}};
}

}  // namespace

std::vector<FlightColumn> flightColumns(const FlightLog& log) {
  Columns columns;
  columns.add("t", "s", [](const Sample& s) { return toSeconds(s.time); });
  addMotion(columns);
  addSetPoint(columns);
  addLaw(columns);
  for (std::size_t i = 0; i < log.adaptive_names.size(); ++i) {
    columns.add(log.adaptive_names[i], "", [i](const Sample& s) {
      return entry(s.telemetry.adaptive, static_cast<Eigen::Index>(i));
    });
  }
  addRotors(columns, log);
  columns.add("payload_mass", "kg", [](const Sample& s) { return s.payload_mass; });
  addDisturbance(columns, log);
  columns.add("touching", "", [](const Sample& s) { return s.touching; });
  columns.add("flying", "", [](const Sample& s) { return s.flying; });
  return columns.take();
}

std::string flightCsv(const FlightLog& log) {
  const std::vector<FlightColumn> columns = flightColumns(log);
  std::string text;
  for (const FlightColumn& column : columns) text += (text.empty() ? "" : ",") + column.name;
  for (const FlightSample& sample : log.samples) {
    for (std::size_t i = 0; i < columns.size(); ++i) {
      text += i == 0 ? '\n' : ',';
      appendNumber(text, columns[i].value(sample), i == 0 ? 12 : 9);
    }
  }
  return text + '\n';
}

nlohmann::json flightJson(const std::vector<FlightLog>& logs, const Scenario& scenario) {
  nlohmann::json flights = nlohmann::json::array();
  for (const FlightLog& log : logs) flights.push_back(metricsJson(log, scenario));
  return {{"scenario", scenario.name}, {"flights", flights}};
}

std::string csvName(const FlightLog& log) {
  return log.controller + ".csv";
}

void makeFolder(const std::string& folder) {
  std::error_code failure;
  fs::create_directories(folder, failure);
  if (!failure && access(folder.c_str(), W_OK | X_OK) != 0) {
    failure.assign(errno, std::generic_category());
  }
  if (failure) {
    throw std::runtime_error("cannot write into the folder '" + folder + "': " + failure.message());
  }
}

void writeFile(const std::string& path, const std::string& text) {
  errno = 0;
  std::ofstream file(path, std::ios::binary);
  file << text;
  file.close();  // a full disk may show only now
  if (!file) {
    const std::string reason = errno != 0 ? std::strerror(errno) : "unknown reason";
    throw std::runtime_error("cannot write '" + path + "': " + reason);
  }
}

void writeFlightFiles(const std::string& folder, const std::vector<FlightLog>& logs) {
  makeFolder(folder);
  for (const FlightLog& log : logs) {
    writeFile((fs::path(folder) / csvName(log)).string(), flightCsv(log));
  }
}

void writeJson(const std::string& path, const std::vector<FlightLog>& logs,
               const Scenario& scenario) {
  using nlohmann::json;
  // Names come from files and may hold anything; what is not UTF-8 is replaced.
  writeFile(path,
            flightJson(logs, scenario).dump(2, ' ', false, json::error_handler_t::replace) + '\n');
}

}  // namespace aqc
