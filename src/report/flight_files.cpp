#include "report/flight_files.h"

#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <limits>
#include <optional>
#include <stdexcept>
#include <system_error>

#include "adaptive_quadrotor_control/flight/metrics.h"
#include "report/flight_csv.h"

namespace aqc {
namespace {

namespace fs = std::filesystem;

// JSON knows no not-a-number and no infinity.
nlohmann::json number(double value) {
  return std::isfinite(value) ? nlohmann::json(value) : nlohmann::json(nullptr);
}

nlohmann::json number(const std::optional<double>& value) {
  return value ? number(*value) : nlohmann::json(nullptr);
}

nlohmann::json metricsJson(const FlightLog& log, const Scenario& scenario) {
  const FlightMetrics metrics = measure(log, metricsWindow(scenario));
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
