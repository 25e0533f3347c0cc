#pragma once

#include <string>
#include <vector>

namespace aqc {

/// A column of a CSV file against time: scale * value + offset, up to the time `until` [s].
struct Curve {
  std::string file;
  std::string column;
  std::string style;  ///< gnuplot: colour, width, dashes
  double until = 0.0;
  double scale = 1.0;
  double offset = 0.0;
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
  std::vector<Curve> curves;  ///< the first one is drawn last, on top
  std::vector<EndPoint> ends;
};

/// Everything about a figure but where the numbers are: those stay in the CSV files.
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

/// The gnuplot script that draws `figure` as `figure.name`.png in the current folder.
std::string figureScript(const Figure& figure);

}  // namespace aqc
