#include "figures/curve.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

namespace aqc {
namespace {

bool isGap(const Point& point) {
  return !std::isfinite(point.y);
}

// The points of one column of pixels, of which at most four are kept.
class Column {
 public:
  void add(const Point* point) {
    if (kept_[0] == nullptr) kept_.fill(point);
    if (point->y < kept_[1]->y) kept_[1] = point;
    if (point->y > kept_[2]->y) kept_[2] = point;
    kept_[3] = point;
  }

  void flush(Points& line) {
    if (kept_[0] == nullptr) return;
    std::sort(kept_.begin(), kept_.end());  // as they came: they lie in one array
    const auto end = std::unique(kept_.begin(), kept_.end());
    for (auto point = kept_.begin(); point != end; ++point) line.push_back(**point);
    kept_.fill(nullptr);
  }

 private:
  std::array<const Point*, 4> kept_ = {};  // first, lowest, highest, last
};

}  // namespace

Points thinned(const Points& line, double pixel) {
  Points kept;
  Column column;
  double number = 0.0;  // of the column
  for (const Point& point : line) {
    const double next = std::floor(point.x / pixel);
    if (isGap(point) || next != number) column.flush(kept);
    number = next;
    if (!isGap(point)) {
      column.add(&point);
    } else if (!kept.empty() && !isGap(kept.back())) {
      kept.push_back(point);
    }
  }
  column.flush(kept);
  return kept;
}

Points thinnedPath(const Points& line, double pixel) {
  Points kept;
  for (const Point& point : line) {
    const bool near = !kept.empty() && !isGap(kept.back()) && &point != &line.back() &&
                      std::hypot(point.x - kept.back().x, point.y - kept.back().y) < pixel;
    if (!near) kept.push_back(point);
  }
  return kept;
}

void writeDataBlock(std::ostream& out, const std::string& name, const Points& line) {
  out << name << " << EOD\n";
  for (const Point& point : line) {
    char text[64] = "\n";  // gnuplot interrupts the line at an empty one
    if (!isGap(point)) std::snprintf(text, sizeof text, "%.6g %.6g\n", point.x, point.y);
    out << text;
  }
  out << "EOD\n";
}

std::string quoted(const std::string& text) {
  std::string result = "'";
  for (const char c : text) {
    const bool control = static_cast<unsigned char>(c) < ' ';
    result += control ? " " : c == '\'' ? "''" : std::string(1, c);
  }
  return result + "'";
}

}  // namespace aqc
