#pragma once

#include <string>
#include <vector>

#include "figures/curve.h"

namespace aqc {

constexpr double kCurveWidth = 2.0;  ///< of a line; in the key wider, so that its colour is seen
constexpr double kKeyWidth = 4.0;

/// A line against time [s].
struct Curve {
  Points points;
  std::string style;  ///< gnuplot: colour, width, dashes
};

/// The point at which a flight ended early.
struct EndPoint {
  double time = 0.0;  ///< [s]
  double value = 0.0;
  std::string colour;
};

/// One of the axes above each other that a figure consists of.
struct Panel {
  std::string label;  ///< of the vertical axis, with the unit
  double low = 0.0;   ///< range of the vertical axis
  double high = 1.0;
  double least_tic = 0.0;     ///< between two tics; 1 for what is counted
  std::vector<Curve> curves;  ///< the first one is drawn last, on top
  std::vector<EndPoint> ends;
};

/// Everything about a figure.
struct Figure {
  struct KeyEntry {
    std::string title;
    std::string style;
  };
  struct Phase {
    double from = 0.0;  ///< [s]
    double to = 0.0;    ///< [s]
    std::string label;
  };

  std::string name;  ///< of the files, without extension
  std::string title;
  double duration = 0.0;  ///< of the time axis [s]
  std::vector<KeyEntry> key;
  std::vector<Panel> panels;
  std::vector<Phase> phases;  ///< shaded
};

/// The gnuplot script that draws `figure` as `figure.name`.png in the current folder. It holds as
/// many points of every curve as the picture can show: gnuplot needs a second to read a minute of a
/// CSV file, and again for every curve.
std::string figureScript(const Figure& figure);

}  // namespace aqc
