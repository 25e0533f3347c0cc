#include "figures/figure_script.h"

#include <algorithm>
#include <cmath>
#include <sstream>

#include "adaptive_quadrotor_control/math/number_text.h"

namespace aqc {
namespace {

// Sizes in pixels.
constexpr double kWidth = 1600;
constexpr double kLeft = 135;
constexpr double kRight = 25;
constexpr double kTop = 122;
constexpr double kBottom = 80;
constexpr double kGap = 20;

// Panels become flatter the more there are.
double height(const Figure& figure) {
  const auto count = static_cast<double>(figure.panels.size());
  const double panel = count <= 3 ? 270 : count <= 4 ? 235 : count <= 5 ? 215 : 190;
  return kTop + kBottom + std::max(count, 2.0) * (panel + kGap) - kGap;
}

std::string print(double value) {
  return formatted("%.9g", value);
}

void writeHead(std::ostream& out, const Figure& figure) {
  const double rows = height(figure);
  const std::string left = print(kLeft / kWidth);
  out << "# Draws " << figure.name << ".png: gnuplot " << figure.name << ".gnuplot\n"
      << "set terminal pngcairo noenhanced size " << print(kWidth) << "," << print(rows)
      << " font 'Sans,15' background '#ffffff'\n"
      << "set output " << quoted(figure.name + ".png") << "\n"
      << "set encoding utf8\n"
      << "set border 3 lc rgb '#808080'\n"
      << "set tics nomirror out scale 0.6 tc rgb '#303030'\n"
      << "set grid lc rgb '#dddddd' lw 1 lt 1\n"
      << "set xrange [0:" << print(figure.duration) << "]\n"
      << "set label 1 " << quoted(figure.title) << " at screen " << left << ", screen "
      << print(1.0 - 28.0 / rows) << " left font 'Sans Bold,17'\n"
      << "set key at screen " << left << ", screen " << print(1.0 - 46.0 / rows)
      << " left top horizontal Left reverse samplen 2.5 width 1 font 'Sans,14'\n"
      << "set multiplot layout " << figure.panels.size() << ",1 margins " << left << ","
      << print(1.0 - kRight / kWidth) << "," << print(kBottom / rows) << ","
      << print(1.0 - kTop / rows) << " spacing " << print(kGap / rows) << "\n";
}

void writePhases(std::ostream& out, const Figure& figure) {
  int object = 1;
  for (const Figure::Phase& phase : figure.phases) {
    out << "set object " << object << " rectangle from " << print(phase.from) << ", graph 0 to "
        << print(phase.to) << ", graph 1 behind fc rgb '#f4efe2' fs solid noborder\n";
    // Above the panel, where no curve can be.
    out << "set label " << ++object << " " << quoted(phase.label) << " at "
        << print(0.5 * (phase.from + phase.to)) << ", graph 1 center offset 0,0.65"
        << " tc rgb '#8a6d1f' font 'Sans,13'\n";
  }
}

// Curves of their own that show nothing but their names, so that the order of the legend does not
// depend on what is drawn on top of what.
void writeKey(std::ostream& out, const Figure& figure) {
  for (const Figure::KeyEntry& entry : figure.key) {
    out << ", \\\n     NaN with lines " << entry.style << " title " << quoted(entry.title);
  }
  out << "\nunset key";
}

// Where a flight ended, on this panel: a line across it and a cross on the curve.
void writeEnds(std::ostream& out, const Panel& panel) {
  int number = 1;
  for (const EndPoint& end : panel.ends) {
    out << "set arrow " << number << " from " << print(end.time) << ", graph 0 to "
        << print(end.time) << ", graph 1 nohead lw 1.6 dt 3 lc rgb " << quoted(end.colour) << "\n"
        << "set label " << 100 + number << " '' at " << print(end.time) << ","
        << print(std::clamp(end.value, panel.low, panel.high)) << " point pt 2 ps 2 lw 3 lc rgb "
        << quoted(end.colour) << " front\n";
    ++number;
  }
}

// At most six steps of 1, 2 or 5 times a power of ten.
double ticStep(const Panel& panel) {
  const double raw = std::max((panel.high - panel.low) / 6.0, panel.least_tic);
  const double power = std::pow(10.0, std::floor(std::log10(raw)));
  for (const double factor : {1.0, 2.0, 5.0}) {
    if (factor * power >= raw) return factor * power;
  }
  return 10.0 * power;
}

// Labels stand at the same place whatever the width of the numbers beside them.
void writeAxes(std::ostream& out, const Panel& panel, bool last) {
  out << "set format x " << (last ? "'%g'" : "''") << "\n"
      << "set label 200 " << quoted(panel.label) << " at screen " << print(22.0 / kWidth)
      << ", graph 0.5 center rotate\n"
      << "set yrange [" << print(panel.low) << ":" << print(panel.high) << "]\n"
      << "set ytics " << print(ticStep(panel)) << "\n";
  if (last) out << "set xlabel 'time [s]' offset 0,0.3\n";
}

void writePanel(std::ostream& out, const Figure& figure, std::size_t index) {
  const Panel& panel = figure.panels[index];
  const double pixel = figure.duration / (kWidth - kLeft - kRight);
  out << "\n";
  std::vector<std::string> blocks;
  for (const Curve& curve : panel.curves) {
    blocks.push_back("$panel" + std::to_string(index + 1) + "_curve" +
                     std::to_string(blocks.size() + 1));
    writeDataBlock(out, blocks.back(), thinned(curve.points, pixel));
  }
  writeEnds(out, panel);
  writeAxes(out, panel, index + 1 == figure.panels.size());
  out << "plot ";
  for (std::size_t i = blocks.size(); i-- > 0;) {
    out << blocks[i] << " with lines " << panel.curves[i].style << " notitle"
        << (i > 0 ? ", \\\n     " : "");
  }
  if (index == 0) writeKey(out, figure);
  out << "\nunset label\nunset arrow\n";
}

}  // namespace

std::string figureScript(const Figure& figure) {
  std::ostringstream out;
  writeHead(out, figure);
  writePhases(out, figure);
  for (std::size_t i = 0; i < figure.panels.size(); ++i) writePanel(out, figure, i);
  out << "\nunset multiplot\n";
  return out.str();
}

}  // namespace aqc
