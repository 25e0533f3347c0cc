#include "report/progress_bar.h"

#include <gtest/gtest.h>

#include <limits>

namespace aqc {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

TEST(ProgressBar, SaysNothingAwayFromATerminal) {
  ::testing::internal::CaptureStderr();
  ProgressBar progress("work");
  for (const double share : {0.0, 0.5, 2.0, -1.0, kNan}) progress.update(share);
  progress.finish();
  progress.update(1.0);
  EXPECT_EQ(::testing::internal::GetCapturedStderr(), "");
}

}  // namespace
}  // namespace aqc
