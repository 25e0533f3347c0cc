#include "figures/plotted_flight.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>

#include "adaptive_quadrotor_control/flight/metrics.h"
#include "adaptive_quadrotor_control/math/number_text.h"

namespace aqc {
namespace {

// Okabe and Ito's palette.
constexpr std::array<const char*, 7> kPalette = {"#0072b2", "#d55e00", "#009e73", "#cc79a7",
                                                 "#e69f00", "#56b4e9", "#606060"};

const std::map<std::string, std::size_t> kLawColours = {
    {"asmc", 0}, {"smc", 1}, {"geometric", 2}, {"switched", 3}};

std::string withTime(const char* what, double time) {
  return formatted(" (%s %.1f s)", what, time);
}

}  // namespace

void Extent::include(double value) {
  if (std::isfinite(value)) include(Extent{value, value});
}

void Extent::include(const Extent& other) {
  low = std::min(low, other.low);
  high = std::max(high, other.high);
}

const FlightColumn* PlottedFlight::find(const std::string& name) const {
  const auto found = std::find_if(columns.begin(), columns.end(),
                                  [&](const FlightColumn& column) { return column.name == name; });
  return found == columns.end() ? nullptr : &*found;
}

std::string PlottedFlight::unit(const std::string& adaptive_name) const {
  for (const AdaptiveQuantity& quantity : log->adaptive_quantities) {
    if (quantity.name == adaptive_name) return quantity.unit;
  }
  return "";
}

Extent PlottedFlight::extent(const std::string& name) const {
  Extent extent;
  const FlightColumn* column = find(name);
  if (column == nullptr) return extent;
  for (const FlightSample& sample : log->samples) {
    if (toSeconds(sample.time) <= end) extent.include(column->value(sample));
  }
  return extent;
}

Points PlottedFlight::line(const std::string& name, double scale, double offset) const {
  Points points;
  const FlightColumn* column = find(name);
  if (column == nullptr) return points;
  for (const FlightSample& sample : log->samples) {
    const double time = toSeconds(sample.time);
    if (time <= end) points.push_back({time, scale * column->value(sample) + offset});
  }
  return points;
}

std::optional<EndPoint> PlottedFlight::endPoint(const std::string& name, double scale) const {
  const FlightColumn* column = find(name);
  if (!log->crash_time || column == nullptr) return std::nullopt;
  EndPoint point{end, std::numeric_limits<double>::quiet_NaN(), colour};
  for (const FlightSample& sample : log->samples) {
    if (toSeconds(sample.time) <= end) point.value = scale * column->value(sample);
  }
  if (!std::isfinite(point.value)) return std::nullopt;
  return point;
}

PlottedFlight plottedFlight(const FlightLog& log, Nanoseconds duration, const std::string& colour) {
  MetricsWindow whole;
  whole.end = log.samples.empty() ? 0 : std::min(duration, log.samples.back().time);
  const FlightMetrics metrics = measure(log, whole);
  PlottedFlight flight;
  flight.log = &log;
  flight.columns = flightColumns(layoutOf(log));
  flight.colour = colour;
  flight.end = metrics.crash_time.value_or(metrics.duration);
  flight.title = log.controller;
  if (metrics.crash_time) {
    flight.title += withTime("crashed at", *metrics.crash_time);
  } else if (metrics.grounded_from) {
    flight.title += withTime("grounded at", *metrics.grounded_from);
  }
  return flight;
}

std::vector<std::string> flightColours(const std::vector<FlightLog>& logs) {
  std::set<std::size_t> taken;
  for (const FlightLog& log : logs) {
    const auto law = kLawColours.find(log.controller);
    if (law != kLawColours.end()) taken.insert(law->second);
  }
  std::vector<std::string> colours;
  std::size_t next = 0;
  for (const FlightLog& log : logs) {
    const auto law = kLawColours.find(log.controller);
    while (law == kLawColours.end() && taken.count(next) > 0) ++next;
    colours.push_back(paletteColour(law != kLawColours.end() ? law->second : next++));
  }
  return colours;
}

std::string paletteColour(std::size_t index) {
  return kPalette[index % kPalette.size()];
}

std::string lineStyle(const std::string& colour, double width) {
  return formatted("lc rgb '%s' lw %g", colour.c_str(), width);
}

std::string withUnit(const AdaptiveQuantity& quantity) {
  return quantity.unit.empty() ? quantity.name : quantity.name + " [" + quantity.unit + "]";
}

void setRange(Panel& panel, const Extent& range, double scale) {
  if (range.empty()) return;
  const double least = 0.1 * std::abs(range.high) + 1e-9;  // for a constant
  const double margin = 0.05 * std::max(range.span(), least);
  panel.low = (range.low - margin) * scale;
  panel.high = (range.high + margin) * scale;
}

Extent readableRange(const std::vector<PlottedFlight>& flights, const std::string& column,
                     const Extent& reference) {
  constexpr double kWild = 5.0;  // times the span of the calmest flight
  constexpr double kRoom = 0.5;  // of the span, to either side
  double calmest = std::numeric_limits<double>::infinity();
  for (const PlottedFlight& flight : flights) {
    const Extent extent = flight.extent(column);
    if (flight.log->crash_time || extent.empty()) continue;
    calmest = std::min(calmest, std::max(extent.span(), reference.span()));
  }
  const bool nobody_is_calm = std::isinf(calmest);
  Extent range = reference;
  Extent everything = reference;
  for (const PlottedFlight& flight : flights) {
    const Extent extent = flight.extent(column);
    const bool calm = !flight.log->crash_time && extent.span() <= kWild * calmest;
    if (calm || nobody_is_calm) range.include(extent);
    everything.include(extent);
  }
  const double room = kRoom * range.span();
  return {std::max(everything.low, range.low - room), std::min(everything.high, range.high + room)};
}

}  // namespace aqc
