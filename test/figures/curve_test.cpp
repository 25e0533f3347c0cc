#include "figures/curve.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <sstream>

#include "support/fixtures.h"

namespace aqc {

bool operator==(const Point& a, const Point& b) {
  return a.x == b.x && a.y == b.y;
}

namespace {

constexpr double kGap = std::numeric_limits<double>::quiet_NaN();

Points noise(int count) {
  test::Dice dice(1);
  Points line;
  for (int i = 0; i < count; ++i) line.push_back({0.001 * i, dice.between(-1.0, 1.0)});
  return line;
}

// Lowest and highest of the points in [from, to).
std::pair<double, double> extremes(const Points& line, double from, double to) {
  std::pair<double, double> found(kGap, kGap);
  for (const Point& point : line) {
    if (point.x < from || point.x >= to) continue;
    found = {std::fmin(found.first, point.y), std::fmax(found.second, point.y)};
  }
  return found;
}

TEST(Curve, KeepsThePeaksOfEveryColumnOfPixels) {
  const Points line = noise(10000);
  const Points kept = thinned(line, 0.125);
  EXPECT_LE(kept.size(), 80u * 4u);
  for (int i = 0; i < 80; ++i) {
    EXPECT_EQ(extremes(kept, 0.125 * i, 0.125 * (i + 1)),
              extremes(line, 0.125 * i, 0.125 * (i + 1)));
  }
  EXPECT_EQ(kept.front(), line.front());
  EXPECT_EQ(kept.back(), line.back());
  for (std::size_t i = 1; i < kept.size(); ++i) EXPECT_LT(kept[i - 1].x, kept[i].x);
}

TEST(Curve, LeavesAloneWhatThePictureShowsPointByPoint) {
  const Points line = noise(500);
  EXPECT_EQ(thinned(line, 0.0005), line);
  EXPECT_EQ(thinned({}, 1.0), Points{});
}

TEST(Curve, GapsStayGaps) {
  const Points kept =
      thinned({{0.0, kGap}, {0.1, 1.0}, {0.2, kGap}, {0.3, kGap}, {0.4, 2.0}}, 10.0);
  ASSERT_EQ(kept.size(), 3u);
  EXPECT_EQ(kept[0], (Point{0.1, 1.0}));
  EXPECT_TRUE(std::isnan(kept[1].y));
  EXPECT_EQ(kept[2], (Point{0.4, 2.0}));
}

TEST(Curve, APathKeepsItsShapeAndItsEnd) {
  Points line;
  for (int i = 0; i <= 100; ++i) line.push_back({0.01 * i, 0.0});
  line.push_back({1.001, 0.0});
  line.push_back({kGap, kGap});
  line.push_back({0.0, 5.0});
  const Points kept = thinnedPath(line, 0.095);
  EXPECT_EQ(kept.size(), 11u + 2u);
  EXPECT_EQ(kept.back(), line.back());
}

TEST(Curve, IsWrittenAsAGnuplotDataBlock) {
  std::ostringstream out;
  writeDataBlock(out, "$it", {{0.0, 1.0 / 3.0}, {0.5, kGap}, {1.0, -2e-9}});
  EXPECT_EQ(out.str(), "$it << EOD\n0 0.333333\n\n1 -2e-09\nEOD\n");
}

TEST(Curve, TextsAreTakenLiterally) {
  EXPECT_EQ(quoted("it's \"a\"\nb"), "'it''s \"a\" b'");
}

}  // namespace
}  // namespace aqc
