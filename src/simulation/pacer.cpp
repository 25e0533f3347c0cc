#include "adaptive_quadrotor_control/simulation/pacer.h"

#include <cmath>

namespace aqc {

Pacer::Pacer(const Pace& pace, Nanoseconds wall, Nanoseconds plant)
    : pace_(pace), last_published_(wall), wall_start_(wall), plant_start_(plant) {}

int Pacer::due(Nanoseconds wall, Nanoseconds plant) noexcept {
  if (pace_.paused || pace_.lock_step) return 0;
  const double factor = pace_.real_time_factor;
  const double behind =
      static_cast<double>(wall - wall_start_) * factor - static_cast<double>(plant - plant_start_);
  if (behind > static_cast<double>(kLongestBacklog) * factor) {
    restart(wall, plant + pace_.period);
    return 1;
  }
  return behind > 0.0 ? static_cast<int>(behind / static_cast<double>(pace_.period)) : 0;
}

bool Pacer::takes(Nanoseconds stamp, Nanoseconds plant) const noexcept {
  return !pace_.paused && (!pace_.lock_step || stamp == plant);
}

bool Pacer::repeats(Nanoseconds wall) const noexcept {
  return (pace_.paused || pace_.lock_step) && wall - last_published_ > kRepeatAfter;
}

Nanoseconds Pacer::interval() const noexcept {
  if (pace_.lock_step) return kRepeatAfter / 4;
  return std::llround(static_cast<double>(pace_.period) / pace_.real_time_factor);
}

void Pacer::restart(Nanoseconds wall, Nanoseconds plant) noexcept {
  wall_start_ = wall;
  plant_start_ = plant;
}

bool Pacer::resume(Nanoseconds wall, Nanoseconds plant) noexcept {
  if (!pace_.paused) return false;
  pace_.paused = false;
  restart(wall, plant);
  return true;
}

}  // namespace aqc
