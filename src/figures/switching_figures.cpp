#include "figures/switching_figures.h"

#include <algorithm>
#include <cmath>

#include "adaptive_quadrotor_control/law/max_subsystems.h"

namespace aqc {
namespace {

constexpr const char* kActive = "active_subsystem";
constexpr double kStart = 5.0;  // the two metres of before would squeeze the centimetres after [s]

struct Line {
  std::string column;
  std::string title = "";   // in the legend; empty: none
  std::string dashes = "";  // gnuplot's, where curves may coincide
};

std::string subsystemName(int index) {
  return "subsystem_" + std::to_string(index);
}

std::string gain(const std::string& name, int subsystem) {
  return name + "[" + std::to_string(subsystem) + "]";
}

// What the figure of a subsystem, whose title counts it, calls one of its gains.
std::string label(const PlottedFlight& flight, const std::string& name, int subsystem) {
  return withUnit({name, flight.unit(gain(name, subsystem))});
}

// A column from a time on to the end.
Points lineFrom(double from, const PlottedFlight& flight, const std::string& column, double scale) {
  Points line = flight.line(column, scale, 0.0);
  const auto first = std::find_if(line.begin(), line.end(),
                                  [from](const Point& point) { return point.x >= from; });
  line.erase(line.begin(), first);
  return line;
}

// Several columns on one pair of axes, colours in the order of the palette from `first_colour`.
void addPanel(Figure& figure, const PlottedFlight& flight, const std::string& label,
              const std::vector<Line>& lines, double scale = 1.0, double from = 0.0,
              std::size_t first_colour = 0) {
  Panel panel;
  panel.label = label;
  Extent range;
  for (std::size_t i = 0; i < lines.size(); ++i) {
    if (flight.find(lines[i].column) == nullptr) continue;
    const std::string colour = paletteColour(first_colour + i);
    panel.curves.push_back({lineFrom(from, flight, lines[i].column, scale),
                            lineStyle(colour, kCurveWidth) + lines[i].dashes});
    for (const Point& point : panel.curves.back().points) range.include(point.y);
    if (!lines[i].title.empty()) {
      figure.key.push_back({lines[i].title, lineStyle(colour, kKeyWidth) + lines[i].dashes});
    }
  }
  if (panel.curves.empty()) return;
  setRange(panel, range, 1.0);
  figure.panels.push_back(panel);
}

// When `subsystem` was the active one.
std::vector<Figure::Phase> activePhases(const PlottedFlight& flight, int subsystem) {
  std::vector<Figure::Phase> phases;
  const FlightColumn* active = flight.find(kActive);
  bool open = false;
  for (const FlightSample& sample : flight.log->samples) {
    const double time = toSeconds(sample.time);
    const bool now = active->value(sample) == subsystem;
    if (now && !open) phases.push_back({time, flight.end, "active"});
    if (!now && open) phases.back().to = time;
    open = now;
  }
  return phases;
}

Figure switchingFigure(const PlottedFlight& flight, Figure figure) {
  figure.name = "switching";
  figure.title += "switching signal, disturbance, errors";
  figure.phases.clear();
  addPanel(figure, flight, "active subsystem", {{kActive, ""}});
  if (!figure.panels.empty()) figure.panels.back().least_tic = 1.0;
  addPanel(figure, flight, "disturbance, z [N]", {{"disturbance_force_z [N]", ""}});
  addPanel(figure, flight, "disturb., yaw [mN m]", {{"disturbance_moment_z [N m]", ""}}, 1e3);
  addPanel(figure, flight, "z error from 5 s [cm]", {{"error_z [m]", ""}}, 100.0, kStart);
  addPanel(figure, flight, "attitude error [deg]",
           {{"error_roll [rad]", "roll error", " dt (8,8)"},
            {"error_pitch [rad]", "pitch error"},
            {"error_yaw [rad]", "yaw error"}},
           180.0 / M_PI);
  return figure;
}

Figure gainsFigure(const PlottedFlight& flight, Figure figure, int subsystem) {
  figure.name = subsystemName(subsystem);
  figure.title += "gains of subsystem " + std::to_string(subsystem);
  figure.phases = activePhases(flight, subsystem);
  std::vector<Line> thetas;
  for (const char* name : {"theta_0", "theta_1", "theta_2", "theta_3"}) {
    thetas.push_back({gain(name, subsystem), label(flight, name, subsystem)});
  }
  addPanel(figure, flight, "theta", thetas);
  addPanel(figure, flight, label(flight, "zeta", subsystem), {{gain("zeta", subsystem), ""}}, 1.0,
           0.0, thetas.size());
  addPanel(figure, flight, label(flight, "gamma", subsystem), {{gain("gamma", subsystem), ""}}, 1.0,
           0.0, thetas.size() + 1);
  return figure;
}

}  // namespace

bool hasSubsystems(const PlottedFlight& flight) {
  return flight.find(kActive) != nullptr;
}

std::vector<Figure> switchingFigures(const PlottedFlight& flight, const Figure& frame) {
  std::vector<Figure> figures = {switchingFigure(flight, frame)};
  for (int i = 1; flight.find(gain("gamma", i)) != nullptr; ++i) {
    figures.push_back(gainsFigure(flight, frame, i));
  }
  return figures;
}

std::vector<std::string> switchingFigureNames() {
  std::vector<std::string> names = {"switching"};
  for (int i = 1; i <= kMaxSubsystems; ++i) names.push_back(subsystemName(i));
  return names;
}

}  // namespace aqc
