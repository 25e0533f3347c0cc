#include "figures/path_figure.h"

#include <algorithm>
#include <array>
#include <sstream>

namespace aqc {
namespace {

// One way to look at the flight: two axes of the world, and what to write beside them.
struct View {
  std::array<Eigen::Index, 2> axes;
  const char* title;
  bool equal_scale;
};

constexpr std::array<View, 2> kViews = {
    {{{0, 1}, "from above", true}, {{0, 2}, "from the side", false}}};
constexpr int kHeight = 860;  // of the picture [pixels]
constexpr std::array<const char*, 3> kAxes = {"x", "y", "z"};

// Everything that must be seen along one axis: set points, walls, and flights up to a little
// beyond.
Extent extentAlong(Eigen::Index axis, const Scenario& scenario) {
  Extent extent;
  extent.include(scenario.world.start.position[axis]);
  for (const TimedSetPoint& timed : scenario.mission.set_points) {
    extent.include(timed.set_point.position[axis]);
  }
  for (const Box& wall : scenario.world.walls) {
    extent.include(wall.min[axis]);
    extent.include(wall.max[axis]);
  }
  const double margin = 0.08 * std::max(extent.span(), 1.0);
  return {axis == 2 ? 0.0 : extent.low - margin, extent.high + margin};
}

void writeWalls(std::ostream& out, const Scenario& scenario, const View& view) {
  int object = 1;
  for (const Box& wall : scenario.world.walls) {
    out << "set object " << object++ << " rectangle from " << wall.min[view.axes[0]] << ","
        << wall.min[view.axes[1]] << " to " << wall.max[view.axes[0]] << ","
        << wall.max[view.axes[1]]
        << " behind fc rgb '#9a9a9a' fs solid 0.75 border lc rgb '#606060'\n";
  }
}

// Where a flight, or its set point, went: two columns against each other, and what to call them.
struct Path {
  const PlottedFlight& flight;
  std::string prefix;  // of the columns
  std::string style;
  std::string title;
};

Points line(const Path& path, const View& view) {
  const auto column = [&](std::size_t i) {
    const auto axis = static_cast<std::size_t>(view.axes[i]);
    return path.flight.line(path.prefix + kAxes[axis] + " [m]", 1.0, 0.0);
  };
  Points points = column(1);
  const Points across = column(0);
  for (std::size_t i = 0; i < points.size(); ++i) points[i].x = across[i].y;
  return points;
}

void writeCrashes(std::ostream& out, const std::vector<PlottedFlight>& flights, const View& view) {
  for (const PlottedFlight& flight : flights) {
    const auto last =
        std::find_if(flight.log->samples.rbegin(), flight.log->samples.rend(),
                     [&](const FlightSample& s) { return toSeconds(s.time) <= flight.end; });
    if (!flight.log->crash_time || last == flight.log->samples.rend()) continue;
    out << "set label '' at " << last->state.position[view.axes[0]] << ","
        << last->state.position[view.axes[1]] << " point pt 2 ps 2.5 lw 3.5 lc rgb '"
        << flight.colour << "' front\n";
  }
}

// Returns the names of the data blocks.
std::vector<std::string> writePaths(std::ostream& out, const std::vector<Path>& paths,
                                    const Scenario& scenario, const View& view) {
  const double finest = std::min(extentAlong(view.axes[0], scenario).span(),
                                 extentAlong(view.axes[1], scenario).span());
  std::vector<std::string> blocks;
  for (const Path& path : paths) {
    blocks.push_back(std::string("$") + kAxes[static_cast<std::size_t>(view.axes[1])] + "_path" +
                     std::to_string(blocks.size() + 1));
    writeDataBlock(out, blocks.back(), thinnedPath(line(path, view), finest / kHeight));
  }
  return blocks;
}

void writeView(std::ostream& out, const std::vector<PlottedFlight>& flights,
               const Scenario& scenario, const View& view) {
  std::vector<Path> paths;
  for (const PlottedFlight& flight : flights) {
    paths.push_back({flight, "", lineStyle(flight.colour, 2.4), flight.title});
  }
  paths.push_back({flights.front(), "set_", "lw 1.6 dt (9,6) lc rgb '#202020'", "set point"});
  const std::vector<std::string> blocks = writePaths(out, paths, scenario, view);
  writeWalls(out, scenario, view);
  writeCrashes(out, flights, view);
  const char* names[2] = {"x", "y"};
  for (std::size_t i = 0; i < 2; ++i) {
    const Extent extent = extentAlong(view.axes[i], scenario);
    out << "set " << names[i] << "range [" << extent.low << ":" << extent.high << "]\n"
        << "set " << names[i] << "label '" << kAxes[static_cast<std::size_t>(view.axes[i])]
        << " [m]'\n";
  }
  out << "set title '" << view.title << "' font 'Sans,15'\n"
      << (view.equal_scale ? "set size ratio -1\nunset key\n"
                           : "set size noratio\nset key left top Left reverse samplen 2.5\n")
      << "plot ";
  for (std::size_t i = 0; i < blocks.size(); ++i) {
    out << (i > 0 ? ", \\\n     " : "") << blocks[i] << " with lines " << paths[i].style
        << " title " << quoted(paths[i].title);
  }
  out << "\n"
      << "unset object\nunset label\n";
}

}  // namespace

std::string pathScript(const std::vector<PlottedFlight>& flights, const Scenario& scenario) {
  std::ostringstream out;
  out << "# Draws path.png: gnuplot path.gnuplot\n"
      << "set terminal pngcairo noenhanced size 1600," << kHeight
      << " font 'Sans,15' background '#ffffff'\n"
      << "set output 'path.png'\nset encoding utf8\n"
      << "set border 3 lc rgb '#808080'\nset tics nomirror out scale 0.6 tc rgb '#303030'\n"
      << "set grid lc rgb '#dddddd' lw 1 lt 1\n"
      << "set multiplot layout 1,2 margins 0.06,0.98,0.09,0.88 spacing 0.07 title "
      << quoted(scenario.title + " \u2013 path") << " font 'Sans Bold,17'\n";
  for (const View& view : kViews) writeView(out, flights, scenario, view);
  out << "unset multiplot\n";
  return out.str();
}

}  // namespace aqc
