#include "figures/flight_figures.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <system_error>

#include "adaptive_quadrotor_control/math/number_text.h"
#include "figures/figure_script.h"
#include "figures/gnuplot.h"
#include "figures/path_figure.h"
#include "figures/plotted_flight.h"
#include "figures/switching_figures.h"
#include "report/flight_files.h"

namespace aqc {
namespace {

namespace fs = std::filesystem;

constexpr double kLeastError = 0.01;  // [m], [rad]
constexpr const char* kMassEstimate = "mass_estimate [kg]";
constexpr const char* kPayloadMass = "payload_mass [kg]";
constexpr double kDegrees = 180.0 / M_PI;
constexpr double kRotorWidth = 1.4;
constexpr const char* kTruthStyle = "lc rgb '#202020' lw 1.6 dt (9,6)";
constexpr const char* kLimitStyle = "lc rgb '#202020' lw 1.6 dt (3,4)";
constexpr std::array<const char*, 5> kNames = {"position", "position_error", "attitude_error",
                                               "adaptation", "rotors"};
constexpr const char* kPathName = "path";

std::vector<Figure::Phase> payloadPhases(const Backdrop& backdrop) {
  std::vector<Figure::Phase> phases;
  for (const Backdrop::PayloadPhase& payload : backdrop.payloads) {
    phases.push_back({toSeconds(payload.from), toSeconds(payload.to.value_or(backdrop.duration)),
                      formatted("payload %g kg", payload.mass)});
  }
  return phases;
}

// What a vector of three columns is called and measured in.
struct VectorColumns {
  std::array<const char*, 3> components;
  const char* prefix;      // of the columns
  const char* set_prefix;  // of the set point's columns, or null
  const char* unit;        // of the columns
  const char* label;       // of the axes, after the component
  double scale;            // from the columns to the axes
};

const VectorColumns kPosition = {{"x", "y", "z"}, "", "set_", " [m]", " [m]", 1.0};
const VectorColumns kPositionError = {{"x", "y", "z"}, "error_",     nullptr,
                                      " [m]",          " error [m]", 1.0};
const VectorColumns kAttitudeError = {{"roll", "pitch", "yaw"}, "error_", nullptr, " [rad]",
                                      " error [deg]",           kDegrees};

// Makes the figures of one set of flights.
class FigureBuilder {
 public:
  FigureBuilder(const std::vector<FlightLog>& logs, const Backdrop& backdrop,
                const Vehicle& vehicle)
      : backdrop_(backdrop), vehicle_(vehicle), duration_(toSeconds(backdrop.duration)) {
    const std::vector<std::string> colours = flightColours(logs);
    for (std::size_t i = 0; i < logs.size(); ++i) {
      flights_.push_back(plottedFlight(logs[i], backdrop.duration, colours[i]));
    }
  }

  /// Where the flights went, in space; worth a figure where there is something to fly around.
  std::string path() const {
    return backdrop_.walls.empty() ? "" : pathScript(flights_, backdrop_);
  }

  /// In the order of kNames, then those of switchingFigures() for the first flight that has
  /// subsystems; one that has nothing to show has no panels.
  std::vector<Figure> figures() const {
    std::vector<Figure> all = {vectors("position", kPosition),
                               vectors("position error", kPositionError),
                               vectors("attitude error", kAttitudeError), adaptation(), rotors()};
    for (std::size_t i = 0; i < all.size(); ++i) all[i].name = kNames[i];
    const auto switched = std::find_if(flights_.begin(), flights_.end(), hasSubsystems);
    if (switched != flights_.end()) {
      const std::vector<Figure> more = switchingFigures(*switched, frame(""));
      all.insert(all.end(), more.begin(), more.end());
    }
    return all;
  }

 private:
  Figure frame(const std::string& what) const {
    Figure figure;
    figure.title = backdrop_.title + " \u2013 " + what;
    figure.duration = duration_;
    figure.phases = payloadPhases(backdrop_);
    return figure;
  }

  // Names in the legend those flights that have a curve in the figure.
  void addFlightKeys(Figure& figure) const {
    for (const PlottedFlight& flight : flights_) {
      const std::string style = lineStyle(flight.colour, kCurveWidth);
      const auto draws = [&](const Panel& panel) {
        return std::any_of(panel.curves.begin(), panel.curves.end(),
                           [&](const Curve& curve) { return curve.style == style; });
      };
      if (std::any_of(figure.panels.begin(), figure.panels.end(), draws)) {
        figure.key.push_back({flight.title, lineStyle(flight.colour, kKeyWidth)});
      }
    }
  }

  // One column of all flights that have it, beside a curve that all flights share.
  Panel panelOf(const std::string& label, const std::string& column, double scale,
                const Extent& reference) const {
    Panel panel;
    panel.label = label;
    setRange(panel, readableRange(flights_, column, reference), scale);
    bool cut = false;
    for (const PlottedFlight& flight : flights_) {
      const Extent extent = flight.extent(column);
      if (extent.empty()) continue;
      cut = cut || extent.low * scale < panel.low || extent.high * scale > panel.high;
      panel.curves.push_back(
          {flight.line(column, scale, 0.0), lineStyle(flight.colour, kCurveWidth)});
      if (const auto end = flight.endPoint(column, scale)) panel.ends.push_back(*end);
    }
    if (cut) panel.label += " (cut)";
    return panel;
  }

  Figure vectors(const std::string& what, const VectorColumns& columns) const {
    Figure figure = frame(what);
    if (columns.set_prefix != nullptr) figure.key.push_back({"set point", kTruthStyle});
    for (const std::string component : columns.components) {
      const bool has_set_point = columns.set_prefix != nullptr;
      const std::string set_point =
          has_set_point ? columns.set_prefix + component + columns.unit : "";
      Extent reference = has_set_point ? flights_.front().extent(set_point) : Extent{0.0, 0.0};
      // Rounding errors of a flight that stands still are not worth a look.
      reference.include(Extent{reference.low - kLeastError, reference.high + kLeastError});
      Panel panel = panelOf(component + columns.label, columns.prefix + component + columns.unit,
                            columns.scale, reference);
      if (has_set_point) {
        panel.curves.insert(panel.curves.begin(),
                            {flights_.front().line(set_point, 1.0, 0.0), kTruthStyle});
      }
      figure.panels.push_back(panel);
    }
    addFlightKeys(figure);
    return figure;
  }

  // The mass estimate beside the truth, and every adaptive quantity any law reports.
  Figure adaptation() const {
    Figure figure = frame("what the control law adapts");
    const auto estimator = std::find_if(flights_.begin(), flights_.end(), estimatesMass);
    if (estimator != flights_.end()) {
      if (vehicle_.mass > 0.0) figure.key.push_back({"true mass with payload", kTruthStyle});
      figure.panels.push_back(massPanel(*estimator));
    }
    for (const AdaptiveQuantity& quantity : adaptiveQuantities()) {
      const Panel panel = panelOf(withUnit(quantity), quantity.name, 1.0, {});
      if (!panel.curves.empty()) figure.panels.push_back(panel);
    }
    addFlightKeys(figure);
    return figure;
  }

  // Each name once, with the first unit that a flight tells.
  std::vector<AdaptiveQuantity> adaptiveQuantities() const {
    std::vector<AdaptiveQuantity> all;
    for (const PlottedFlight& flight : flights_) {
      if (hasSubsystems(flight)) continue;  // its gains have figures of their own
      for (const AdaptiveQuantity& quantity : flight.log->adaptive_quantities) {
        const auto same = std::find_if(all.begin(), all.end(), [&](const AdaptiveQuantity& known) {
          return known.name == quantity.name;
        });
        if (same == all.end()) {
          all.push_back(quantity);
        } else if (same->unit.empty()) {
          same->unit = quantity.unit;
        }
      }
    }
    return all;
  }

  static bool estimatesMass(const PlottedFlight& flight) {
    return !flight.extent(kMassEstimate).empty();
  }

  // `estimator` tells which payloads it really carried.
  Panel massPanel(const PlottedFlight& estimator) const {
    const std::string label = "mass estimate [kg]";
    if (!(vehicle_.mass > 0.0)) return panelOf(label, kMassEstimate, 1.0, {});
    Extent truth = estimator.extent(kPayloadMass);
    truth.low += vehicle_.mass;
    truth.high += vehicle_.mass;
    Panel panel = panelOf(label, kMassEstimate, 1.0, truth);
    panel.curves.insert(panel.curves.begin(),
                        {estimator.line(kPayloadMass, 1.0, vehicle_.mass), kTruthStyle});
    return panel;
  }

  // A panel a flight: how near its rotors come to their limit.
  Figure rotors() const {
    Figure figure = frame("commanded rotor speeds");
    for (std::size_t i = 0; i < vehicle_.rotors.size(); ++i) {
      figure.key.push_back(
          {"rotor " + std::to_string(i + 1), lineStyle(paletteColour(i), kKeyWidth)});
    }
    if (vehicle_.max_rotor_speed > 0.0) {
      figure.key.push_back({formatted("limit %g rad/s", vehicle_.max_rotor_speed), kLimitStyle});
    }
    for (const PlottedFlight& flight : flights_) figure.panels.push_back(rotorPanel(flight));
    return figure;
  }

  Panel rotorPanel(const PlottedFlight& flight) const {
    Panel panel;
    panel.label = flight.log->controller + " [rad/s]";
    double limit = vehicle_.max_rotor_speed;
    if (limit > 0.0) panel.curves.push_back({{{0.0, limit}, {duration_, limit}}, kLimitStyle});
    for (std::size_t i = 0; i < vehicle_.rotors.size(); ++i) {
      const std::string name = "rotor_" + std::to_string(i + 1) + " [rad/s]";
      panel.curves.push_back(
          {flight.line(name, 1.0, 0.0), lineStyle(paletteColour(i), kRotorWidth)});
      if (!(vehicle_.max_rotor_speed > 0.0)) limit = std::max(limit, flight.extent(name).high);
    }
    if (limit > 0.0) panel.high = 1.08 * limit;
    if (auto end = flight.endPoint("rotor_1 [rad/s]", 1.0)) {
      end->value = 0.0;
      panel.ends.push_back(*end);
    }
    return panel;
  }

  const Backdrop& backdrop_;
  const Vehicle& vehicle_;
  double duration_;
  std::vector<PlottedFlight> flights_;
};

}  // namespace

std::vector<std::string> drawFigures(const std::string& folder, const std::vector<FlightLog>& logs,
                                     const Backdrop& backdrop, const Vehicle& vehicle,
                                     const std::function<void(double)>& progress) {
  std::vector<std::string> names = switchingFigureNames();
  names.insert(names.end(), kNames.begin(), kNames.end());
  names.push_back(kPathName);
  for (const std::string& name : names) {
    std::error_code ignored;  // nothing to remove
    fs::remove(fs::path(folder) / (name + ".png"), ignored);
    fs::remove(fs::path(folder) / (name + ".gnuplot"), ignored);
  }
  if (logs.empty()) return {};
  const FigureBuilder builder(logs, backdrop, vehicle);
  std::vector<GnuplotScript> scripts;
  for (const Figure& figure : builder.figures()) {
    if (!figure.panels.empty()) scripts.push_back({figure.name, figureScript(figure)});
  }
  if (const std::string path = builder.path(); !path.empty()) scripts.push_back({kPathName, path});

  return runGnuplot(folder, scripts, progress);
}

}  // namespace aqc
