#include "report/progress_bar.h"

#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <utility>

namespace aqc {
namespace {

constexpr std::chrono::milliseconds kPatience(500);  // shorter work needs no bar
constexpr std::chrono::milliseconds kPeriod(50);     // between two drawings
constexpr int kWidth = 30;
constexpr int kLongestLabel = 38;  // all together fits into 80 columns

}  // namespace

ProgressBar::ProgressBar(std::string label)
    : label_(std::move(label)),
      active_(isatty(STDERR_FILENO) == 1),
      next_(Clock::now() + kPatience) {}

void ProgressBar::update(double share) {
  if (!active_) return;
  const Clock::time_point now = Clock::now();
  if (now < next_) return;
  next_ = now + kPeriod;
  drawn_ = true;
  draw(std::isfinite(share) ? std::clamp(share, 0.0, 1.0) : 0.0);
}

void ProgressBar::draw(double share) const {
  const int full = static_cast<int>(share * kWidth);
  std::string bar(static_cast<std::size_t>(full), '#');
  bar.resize(kWidth, '-');
  std::fprintf(stderr, "\r%.*s [%s] %3d %%\033[K", kLongestLabel, label_.c_str(), bar.c_str(),
               static_cast<int>(share * 100.0));
  std::fflush(stderr);
}

void ProgressBar::finish() {
  if (active_ && drawn_) {
    std::fputs("\r\033[K", stderr);
    std::fflush(stderr);
  }
  active_ = false;
}

}  // namespace aqc
