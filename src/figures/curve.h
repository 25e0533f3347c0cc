#pragma once

#include <ostream>
#include <string>
#include <vector>

namespace aqc {

/// A point of a line in a figure.
struct Point {
  double x = 0.0;
  double y = 0.0;
};

/// A line through its points; a point whose y is not finite is a gap.
using Points = std::vector<Point>;

/// What a picture shows of a line whose x never decreases: of the points whose x share a multiple
/// of `pixel` (> 0) the first, the lowest, the highest and the last one. Gaps stay gaps.
Points thinned(const Points& line, double pixel);

/// The same for a line that goes anywhere: points nearer than `pixel` to the last kept one are left
/// out, but for the last one.
Points thinnedPath(const Points& line, double pixel);

/// Writes a gnuplot data block, to be plotted by its name ("$..."). Six digits are more than a
/// picture shows.
void writeDataBlock(std::ostream& out, const std::string& name, const Points& line);

/// A text as gnuplot takes it literally; control characters become blanks.
std::string quoted(const std::string& text);

}  // namespace aqc
