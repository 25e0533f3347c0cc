#include "figure_script.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <sstream>

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
  const double panel = count <= 3 ? 270 : count <= 4 ? 235 : 190;
  return kTop + kBottom + std::max(count, 2.0) * (panel + kGap) - kGap;
}

// A text as gnuplot takes it literally: nothing is special inside single quotes.
std::string quote(const std::string& text) {
  std::string quoted = "'";
  for (const char c : text) {
    const bool control = static_cast<unsigned char>(c) < ' ';
    quoted += control ? " " : c == '\'' ? "''" : std::string(1, c);
  }
  return quoted + "'";
}

// A CSV file of this folder. The "./" keeps names that begin with '<' from being commands.
std::string quoteFile(const std::string& name) {
  return quote("./" + name);
}

std::string print(double value) {
  char buffer[32];
  std::snprintf(buffer, sizeof buffer, "%.9g", value);
  return buffer;
}

void writeHead(std::ostream& out, const Figure& figure) {
  const double rows = height(figure);
  const std::string left = print(kLeft / kWidth);
  out << "# Draws " << figure.name << ".png from the CSV files of this folder:\n"
      << "#   gnuplot " << figure.name << ".gnuplot\n"
      << "set terminal pngcairo noenhanced size " << print(kWidth) << "," << print(rows)
      << " font 'Sans,15' background '#ffffff'\n"
      << "set output " << quote(figure.name + ".png") << "\n"
      << "set encoding utf8\n"
      << "set datafile separator ','\n"
      << "set key autotitle columnheader\n"
      << "until(end, value) = column('t [s]') <= end ? value : NaN\n\n"
      << "set border 3 lc rgb '#808080'\n"
      << "set tics nomirror out scale 0.6 tc rgb '#303030'\n"
      << "set grid lc rgb '#dddddd' lw 1 lt 1\n"
      << "set xrange [0:" << print(figure.duration) << "]\n"
      << "set label 1 " << quote(figure.title) << " at screen " << left << ", screen "
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
    out << "set label " << ++object << " " << quote(phase.label) << " at "
        << print(0.5 * (phase.from + phase.to)) << ", graph 1 center offset 0,0.65"
        << " tc rgb '#8a6d1f' font 'Sans,13'\n";
  }
}

// Curves of their own that show nothing but their names, so that the order of the legend does not
// depend on what is drawn on top of what.
void writeKey(std::ostream& out, const Figure& figure) {
  for (const Figure::KeyEntry& entry : figure.key) {
    out << ", \\\n     NaN with lines " << entry.style << " title " << quote(entry.title);
  }
  out << "\nunset key";
}

// Where a flight ended, on this panel: a line across it and a cross on the curve.
void writeEnds(std::ostream& out, const Panel& panel) {
  int number = 1;
  for (const EndPoint& end : panel.ends) {
    out << "set arrow " << number << " from " << print(end.time) << ", graph 0 to "
        << print(end.time) << ", graph 1 nohead lw 1.6 dt 3 lc rgb " << quote(end.colour) << "\n"
        << "set label " << 100 + number << " '' at " << print(end.time) << ","
        << print(std::clamp(end.value, panel.low, panel.high)) << " point pt 2 ps 2 lw 3 lc rgb "
        << quote(end.colour) << " front\n";
    ++number;
  }
}

std::string curveText(const Curve& curve, double duration) {
  std::string value = quote(curve.column);
  if (curve.scale != 1.0 || curve.offset != 0.0 || curve.until < duration) {
    value = "column(" + value + ")";
    if (curve.scale != 1.0) value += "*" + print(curve.scale);
    if (curve.offset != 0.0) value += "+" + print(curve.offset);
    if (curve.until < duration) value = "until(" + print(curve.until) + ", " + value + ")";
    value = "(" + value + ")";
  }
  return quoteFile(curve.file) + " using 't [s]':" + value + " with lines " + curve.style +
         " notitle";
}

// At most six steps of 1, 2 or 5 times a power of ten.
double ticStep(const Panel& panel) {
  const double raw = (panel.high - panel.low) / 6.0;
  const double power = std::pow(10.0, std::floor(std::log10(raw)));
  for (const double factor : {1.0, 2.0, 5.0}) {
    if (factor * power >= raw) return factor * power;
  }
  return 10.0 * power;
}

// Labels stand at the same place whatever the width of the numbers beside them.
void writeAxes(std::ostream& out, const Panel& panel, bool last) {
  out << "set format x " << (last ? "'%g'" : "''") << "\n"
      << "set label 200 " << quote(panel.label) << " at screen " << print(22.0 / kWidth)
      << ", graph 0.5 center rotate\n"
      << "set yrange [" << print(panel.low) << ":" << print(panel.high) << "]\n"
      << "set ytics " << print(ticStep(panel)) << "\n";
  if (last) out << "set xlabel 'time [s]' offset 0,0.3\n";
}

void writePanel(std::ostream& out, const Figure& figure, std::size_t index) {
  const Panel& panel = figure.panels[index];
  out << "\n";
  writeEnds(out, panel);
  writeAxes(out, panel, index + 1 == figure.panels.size());
  out << "plot ";
  for (auto curve = panel.curves.rbegin(); curve != panel.curves.rend(); ++curve) {
    out << (curve == panel.curves.rbegin() ? "" : ", \\\n     ")
        << curveText(*curve, figure.duration);
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
