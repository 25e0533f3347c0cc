#pragma once

#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "figures/figure_script.h"
#include "report/flight_columns.h"

namespace aqc {

/// Smallest and largest of some numbers.
struct Extent {
  double low = std::numeric_limits<double>::infinity();
  double high = -std::numeric_limits<double>::infinity();

  bool empty() const { return !(low <= high); }
  double span() const { return empty() ? 0.0 : high - low; }
  void include(double value);  ///< unless it is not finite
  void include(const Extent& other);
};

/// A flight, and what every figure needs to know about it.
struct PlottedFlight {
  const FlightLog* log = nullptr;
  std::vector<FlightColumn> columns;
  std::string colour;
  std::string title;  ///< in the legend
  double end = 0.0;   ///< when it crashed, otherwise its last sample, within the figure [s]

  const FlightColumn* find(const std::string& name) const;
  /// The unit of an adaptive quantity; empty for a count, for one that the flight does not have,
  /// and where its record does not tell.
  std::string unit(const std::string& adaptive_name) const;
  /// Of a column until `end`: what lies on the ground afterwards tells nothing.
  Extent extent(const std::string& name) const;
  /// A column against time until `end`: scale * value + offset. Empty without that column.
  Points line(const std::string& name, double scale, double offset) const;
  /// The last value of a column before the crash, if there was one.
  std::optional<EndPoint> endPoint(const std::string& name, double scale) const;
};

/// `duration` is that of the figure; this flight may be shorter. Throws std::invalid_argument as
/// measure() does over the whole flight.
PlottedFlight plottedFlight(const FlightLog& log, Nanoseconds duration, const std::string& colour);

/// A colour a flight. The same law has the same colour whatever it is compared with; flights that
/// are not named after a law have the next ones that are free.
std::vector<std::string> flightColours(const std::vector<FlightLog>& logs);

/// Colour `index` of a palette that most colour-blind people can tell apart; repeats.
std::string paletteColour(std::size_t index);

/// How gnuplot draws a line.
std::string lineStyle(const std::string& colour, double width);

/// A quantity's name with its unit, as an axis or a legend calls it; the bare name of one without.
std::string withUnit(const AdaptiveQuantity& quantity);

/// The panel's vertical axis: `range` times `scale` with a margin. An empty range changes nothing.
void setRange(Panel& panel, const Extent& range, double scale);

/// The range that shows `reference` and all flights that did not crash. Those that did may widen it
/// only by half to either side, and so may those many times wilder than the calmest one: a flight
/// that diverges must not squeeze the rest into a line.
Extent readableRange(const std::vector<PlottedFlight>& flights, const std::string& column,
                     const Extent& reference);

}  // namespace aqc
