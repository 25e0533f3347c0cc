#include "report/flight_csv.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <limits>
#include <stdexcept>
#include <string_view>
#include <utility>

#include "report/flight_columns.h"

namespace aqc {
namespace {

using Fields = std::vector<std::string_view>;

// Between these stand the adaptive quantities, whatever the law calls them.
constexpr const char* kBeforeAdaptive = "mass_estimate [kg]";
constexpr const char* kAfterAdaptive = "thrust [N]";
constexpr const char* kDisturbance = "disturbance_force_x [N]";
constexpr const char* kCrashTime = "crash_time [s]";
constexpr const char* kCrashReason = "crash_reason";

// The shortest text that reads back as the same number.
void appendNumber(std::string& text, double value) {
  if (std::isnan(value)) return;
  char buffer[32];
#ifdef __cpp_lib_to_chars
  text.append(buffer, std::to_chars(std::begin(buffer), std::end(buffer), value).ptr);
#else  // before GCC 11
  std::snprintf(buffer, sizeof buffer, "%.15g", value);
  if (std::strtod(buffer, nullptr) != value) std::snprintf(buffer, sizeof buffer, "%.17g", value);
  text += buffer;
#endif
}

Fields split(std::string_view text, char separator) {
  Fields parts;
  for (std::size_t begin = 0; begin <= text.size();) {
    const std::size_t end = std::min(text.find(separator, begin), text.size());
    parts.push_back(text.substr(begin, end - begin));
    begin = end + 1;
  }
  return parts;
}

// Reads one text, and knows at which line it is.
class Parser {
 public:
  Parser(const std::string& text, const std::string& file) : file_(file) {
    lines_ = split(text, '\n');
    if (lines_.back().empty()) lines_.pop_back();  // behind the end of the last line
    for (std::string_view& line : lines_) {
      if (!line.empty() && line.back() == '\r') line.remove_suffix(1);
    }
  }

  FlightLog parse() {
    if (lines_.empty()) refuse("is empty; it must hold a flight as fly writes it");
    header_ = split(lines_[0], ',');
    FlightLog log;
    const FlightLayout layout = readHeader(log);
    columns_ = flightColumns(layout);
    checkHeader(log.crash_time.has_value());
    for (const std::string& name : layout.adaptive_names) {
      log.adaptive_quantities.push_back({name, ""});
    }
    if (lines_.size() < 2) refuse("ends; there must be a line a sample");
    for (line_ = 1; line_ < lines_.size(); ++line_) {
      log.samples.push_back(readSample());
      if (line_ > 1) checkTime(log.samples[line_ - 2].time, log.samples.back().time);
    }
    if (log.crash_time) readCrash(log);
    return log;
  }

 private:
  [[noreturn]] void refuse(const std::string& problem) const {
    throw std::runtime_error("'" + file_ + "', line " + std::to_string(line_ + 1) + ": " + problem);
  }

  bool names(const char* column) const {
    return std::find(header_.begin(), header_.end(), column) != header_.end();
  }

  // What flightColumns() needs to know; whether it is right shows when names are compared.
  FlightLayout readHeader(FlightLog& log) const {
    FlightLayout layout;
    const auto before = std::find(header_.begin(), header_.end(), kBeforeAdaptive);
    const auto after = std::find(before, header_.end(), kAfterAdaptive);
    if (after != header_.end()) layout.adaptive_names.assign(before + 1, after);
    while (names(("rotor_" + std::to_string(layout.rotors + 1) + " [rad/s]").c_str())) {
      ++layout.rotors;
    }
    layout.disturbed = names(kDisturbance);
    if (names(kCrashTime)) log.crash_time = 0;
    checkCount("adaptive quantities", layout.adaptive_names.size(), kMaxAdaptive);
    checkCount("rotors", static_cast<std::size_t>(layout.rotors), kMaxRotors);
    return layout;
  }

  void checkCount(const std::string& what, std::size_t count, std::size_t most) const {
    if (count <= most) return;
    refuse("there are " + std::to_string(count) + " " + what + "; at most " + std::to_string(most) +
           " are allowed");
  }

  void checkHeader(bool crashed) const {
    std::vector<std::string> expected;
    for (const FlightColumn& column : columns_) expected.push_back(column.name);
    if (crashed) expected.insert(expected.end(), {kCrashTime, kCrashReason});
    for (std::size_t i = 0; i < std::max(expected.size(), header_.size()); ++i) {
      const std::string found = i < header_.size() ? std::string(header_[i]) : "";
      if (i >= expected.size()) refuse("column '" + found + "' is unknown");
      if (found == expected[i]) continue;
      refuse("column '" + expected[i] + "' is missing" +
             (i < header_.size() ? "; '" + found + "' stands there" : ""));
    }
  }

  FlightSample readSample() const {
    const Fields fields = split(lines_[line_], ',');
    if (fields.size() != header_.size()) {
      refuse("has " + std::to_string(fields.size()) + " fields; it must have " +
             std::to_string(header_.size()) + ", as the header has");
    }
    FlightSample sample;
    for (std::size_t i = columns_.size(); i-- > 0;) {  // see FlightColumn::set
      const double value = number(i, fields[i]);
      try {
        if (columns_[i].set) columns_[i].set(sample, value);
      } catch (const std::invalid_argument& error) {
        refuseField(i, fields[i], error.what());
      }
    }
    return sample;
  }

  double number(std::size_t column, std::string_view field) const {
    if (field.empty()) return std::numeric_limits<double>::quiet_NaN();
    const std::string text(field);  // strtod() looks for its end
    char* end = nullptr;
    const double value = std::strtod(text.c_str(), &end);
    if (end != text.c_str() + text.size()) refuseField(column, field, "must be a number or empty");
    return value;
  }

  [[noreturn]] void refuseField(std::size_t column, std::string_view field,
                                const std::string& expected) const {
    refuse("'" + std::string(header_[column]) + "' is '" + std::string(field) + "'; it " +
           expected);
  }

  void checkTime(Nanoseconds before, Nanoseconds time) const {
    if (time > before) return;
    std::string text = "'t [s]' is '";
    appendNumber(text, toSeconds(time));
    text += "'; it must be later than in the line before, '";
    appendNumber(text, toSeconds(before));
    refuse(text + "'");
  }

  // The same in every line.
  void readCrash(FlightLog& log) {
    line_ = 1;
    const Fields fields = split(lines_[line_], ',');
    FlightSample crash;
    const std::size_t column = columns_.size();
    try {
      columns_.front().set(crash, number(column, fields[column]));
    } catch (const std::invalid_argument& error) {
      refuseField(column, fields[column], error.what());
    }
    log.crash_time = crash.time;
    log.crash_reason = fields[column + 1];
  }

  std::string file_;
  Fields lines_;
  Fields header_;
  std::vector<FlightColumn> columns_;
  std::size_t line_ = 0;  // counts from 0
};

}  // namespace

std::string flightCsv(const FlightLog& log) {
  const std::vector<FlightColumn> columns = flightColumns(layoutOf(log));
  std::string text;
  for (const FlightColumn& column : columns) text += (text.empty() ? "" : ",") + column.name;
  std::string crash;
  if (log.crash_time) {
    text += std::string(",") + kCrashTime + "," + kCrashReason;
    crash = ",";
    appendNumber(crash, toSeconds(*log.crash_time));
    crash += "," + log.crash_reason;
  }
  for (const FlightSample& sample : log.samples) {
    for (std::size_t i = 0; i < columns.size(); ++i) {
      text += i == 0 ? '\n' : ',';
      appendNumber(text, columns[i].value(sample));
    }
    text += crash;
  }
  return text + '\n';
}

FlightLog parseFlightCsv(const std::string& text, const std::string& file) {
  return Parser(text, file).parse();
}

FlightLog readFlightCsv(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  std::string text((std::istreambuf_iterator<char>(file)), std::istreambuf_iterator<char>());
  if (!file) throw std::runtime_error("cannot read '" + path + "'");
  FlightLog log = parseFlightCsv(text, path);
  log.controller = std::filesystem::path(path).stem().string();
  return log;
}

}  // namespace aqc
