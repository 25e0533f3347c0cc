#include "report/flight_table.h"

#include <unistd.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>

#include "adaptive_quadrotor_control/flight/metrics.h"
#include "adaptive_quadrotor_control/math/number_text.h"

namespace aqc {
namespace {

// Terminal attributes (ECMA-48).
constexpr const char* kBold = "\033[1m";
constexpr const char* kFaint = "\033[2m";
constexpr const char* kRed = "\033[31m";
constexpr const char* kYellow = "\033[33m";
constexpr const char* kReset = "\033[0m";

constexpr std::size_t kErrors = 6;   // x, y, z, roll, pitch, yaw
constexpr std::size_t kNumbers = 9;  // these, peak and settled altitude error, speed
constexpr int kLabelWidth = 14;
constexpr std::array<int, kNumbers> kWidths = {8, 8, 8, 10, 8, 8, 10, 9, 11};

// One line: a label, numbers as text, and at the end what happened.
struct Row {
  std::string label;
  std::array<std::string, kNumbers> numbers;
  std::string outcome;
};

// A number in a fixed format, unless it is too large to be one.
std::string fixed(double value, int decimals) {
  if (!std::isfinite(value)) return "-";
  if (std::abs(value) >= 1000.0) return formatted("%.1e", value);
  return formatted(decimals == 3 ? "%.3f" : "%.2f", value);
}

std::string seconds(double time) {
  return formatted("%g s", std::round(time * 100.0) / 100.0);
}

std::string pad(const std::string& text, int width, bool left = false) {
  const std::string space(
      static_cast<std::size_t>(std::max(0, width - static_cast<int>(text.size()))), ' ');
  return left ? text + space : space + text;
}

// Columns beside each other under one heading, centred.
std::string centred(const std::string& text, std::size_t first, std::size_t last) {
  int width = 0;
  for (std::size_t i = first; i <= last; ++i) width += kWidths[i];
  constexpr int kGap = 3;  // in front of the first column's numbers
  const int before = kGap + std::max(0, (width - kGap - static_cast<int>(text.size())) / 2);
  return pad(std::string(static_cast<std::size_t>(before), ' ') + text, width, true);
}

std::string line(const Row& row) {
  std::string text = pad(row.label, kLabelWidth, true);
  for (std::size_t i = 0; i < kNumbers; ++i) text += pad(row.numbers[i], kWidths[i]);
  return row.outcome.empty() ? text : text + "   " + row.outcome;
}

std::string rightTrimmed(const std::string& text) {
  return text.substr(0, text.find_last_not_of(' ') + 1);
}

std::string paint(const std::string& text, const char* attribute, TableStyle style) {
  return style == TableStyle::kColoured && !text.empty() ? attribute + text + kReset : text;
}

std::array<double, kErrors> toArray(const RmsErrors& rms) {
  return {rms.position.x(), rms.position.y(), rms.position.z(),
          rms.attitude.x(), rms.attitude.y(), rms.attitude.z()};
}

int decimals(std::size_t i) {
  return i < 3 || i >= kErrors ? 3 : 2;
}  // metres 3, degrees 2

std::string outcome(const FlightLog& log, const FlightMetrics& metrics, TableStyle style) {
  if (metrics.crash_time) {
    const std::string reason = log.crash_reason.empty() ? "" : ": " + log.crash_reason;
    return paint("crashed at " + seconds(*metrics.crash_time) + reason, kRed, style);
  }
  if (!metrics.rms.position.allFinite() || !metrics.rms.attitude.allFinite()) {
    return paint("diverged", kRed, style);
  }
  if (metrics.grounded_from) {
    return paint("on the ground from " + seconds(*metrics.grounded_from), kYellow, style);
  }
  constexpr double kAside = 1.0;  // [m], further than any law that controls x and y should end
  if (!(metrics.final_lateral_error > kAside)) return "flew to the end";
  return paint(formatted("ended %.1f m aside", metrics.final_lateral_error), kYellow, style);
}

Row flownRow(const FlightLog& log, const FlightMetrics& metrics) {
  Row row;
  row.label = log.controller;
  const auto errors = toArray(metrics.rms);
  for (std::size_t i = 0; i < kErrors; ++i) row.numbers[i] = fixed(errors[i], decimals(i));
  row.numbers[6] = fixed(metrics.peak_altitude_error, 3);
  row.numbers[7] = fixed(metrics.settled_altitude_error, 3);
  row.numbers[8] = log.real_time_factor > 0.0 ? formatted("%.3g x", log.real_time_factor) : "-";
  if (log.real_time_factor >= 1000.0) row.numbers[8] = formatted("%.0f x", log.real_time_factor);
  return row;
}

// The published errors, and by how much the flown ones differ from them.
std::array<Row, 2> publishedRows(const RmsErrors& flown, const RmsErrors& published) {
  std::array<Row, 2> rows;
  rows[0].label = "  published";
  rows[1].label = "  difference";
  const auto ours = toArray(flown);
  const auto theirs = toArray(published);
  for (std::size_t i = 0; i < kErrors; ++i) {
    rows[0].numbers[i] = fixed(theirs[i], decimals(i));
    const double percent = 100.0 * (ours[i] - theirs[i]) / theirs[i];
    const bool printable = std::isfinite(percent) && std::abs(percent) < 1e4;
    rows[1].numbers[i] = printable ? formatted("%+.0f %%", percent) : "-";
  }
  return rows;
}

std::string heading(const std::vector<FlightLog>& logs, const Scenario& scenario,
                    const Vehicle& vehicle, TableStyle style) {
  const std::string mass = formatted("%g kg", vehicle.mass);
  std::string text = paint(scenario.title, kBold, style) + "\n";
  text += "Vehicle " + vehicle.name + " (" + mass + " empty). RMS errors from " +
          seconds(toSeconds(scenario.metrics_from)) + " to the end at " +
          seconds(toSeconds(scenario.duration)) + ".\n";
  const Nanoseconds change = scenario.lastPayloadChange();
  text += "Altitude error: peak " +
          (change > 0 ? "after the last payload change at " + seconds(toSeconds(change))
                      : std::string("of the flight")) +
          "; settled: mean of the last 5 s.\n";
  for (const FlightLog& log : logs) {
    if (!log.dwell_time.empty()) text += log.controller + ": " + log.dwell_time + ".\n";
  }
  text += "\n";
  Row units{"", {"x", "y", "z", "roll", "pitch", "yaw", "peak", "settled", "speed"}, "outcome"};
  text += rightTrimmed(pad("", kLabelWidth) + centred("RMS position [m]", 0, 2) +
                       centred("RMS attitude [deg]", 3, 5) + centred("altitude [m]", 6, 7)) +
          "\n";
  const std::string names = line(units);
  return text + names + "\n" + std::string(names.size() + 16, '-') + "\n";
}

// Events of the scenario that this flight made impossible.
std::string refusalLines(const FlightLog& log, TableStyle style) {
  std::string text;
  for (const auto& refusal : log.refusals) {
    if (log.crash_time && refusal.time >= *log.crash_time) break;  // no wonder
    const std::string when = "  at " + seconds(toSeconds(refusal.time)) + ": ";
    text += paint(when + refusal.reason, kYellow, style) + "\n";
  }
  return text;
}

}  // namespace

TableStyle styleOfStdout() {
  const char* terminal = std::getenv("TERM");
  const bool dumb = terminal == nullptr || std::strcmp(terminal, "dumb") == 0;
  const bool colours = isatty(STDOUT_FILENO) == 1 && !dumb && std::getenv("NO_COLOR") == nullptr;
  return colours ? TableStyle::kColoured : TableStyle::kPlain;
}

std::string flightTable(const std::vector<FlightLog>& logs, const Scenario& scenario,
                        const Vehicle& vehicle, TableStyle style) {
  std::string text = heading(logs, scenario, vehicle, style);
  bool ended_early = false;
  for (const FlightLog& log : logs) {
    const FlightMetrics metrics = measure(log, metricsWindow(scenario));
    ended_early = ended_early || metrics.crash_time || metrics.grounded_from;
    text += paint(line(flownRow(log, metrics)), kBold, style) + "   " +
            outcome(log, metrics, style) + "\n";
    const auto published = scenario.published.find(log.controller);
    if (published != scenario.published.end()) {
      for (const Row& row : publishedRows(metrics.rms, published->second)) {
        text += paint(rightTrimmed(line(row)), kFaint, style) + "\n";
      }
    }
    text += refusalLines(log, style);
  }
  if (ended_early) text += "\nErrors keep counting after a crash and on the ground.\n";
  return text + "speed: simulated time / wall time.\n";
}

}  // namespace aqc
