#pragma once

#include <chrono>
#include <string>

namespace aqc {

/// A line on stderr that shows how far some work has come. It appears only on a terminal and only
/// once the work has lasted half a second; finish() or the destructor removes it.
class ProgressBar {
 public:
  explicit ProgressBar(std::string label);
  ~ProgressBar() { finish(); }
  ProgressBar(const ProgressBar&) = delete;
  ProgressBar& operator=(const ProgressBar&) = delete;

  /// `share` of the work is done: 0 to 1, others are clamped. Cheap enough for every step.
  void update(double share);
  /// Removes the line; update() after this does nothing.
  void finish();

 private:
  using Clock = std::chrono::steady_clock;

  void draw(double share) const;

  std::string label_;
  bool active_;  // stderr is a terminal, and finish() has not been called
  bool drawn_ = false;
  Clock::time_point next_;  // when to draw next
};

}  // namespace aqc
