#include "adaptive_quadrotor_control/model/rotor_lag.h"

#include <algorithm>
#include <cmath>

namespace aqc {

double lagDecay(double dt, double time_constant) noexcept {
  return time_constant > 0.0 ? std::exp(-dt / time_constant) : 0.0;
}

RotorLag::RotorLag(const Vehicle& vehicle)
    : time_constant_up_(vehicle.time_constant_up),
      time_constant_down_(vehicle.time_constant_down),
      speeds_(RotorArray::Zero(static_cast<Eigen::Index>(vehicle.rotors.size()))) {}

void RotorLag::prepare(double dt) noexcept {
  if (dt == dt_) return;  // a fixed step pays for the exponentials once
  dt_ = dt;
  decay_up_ = lagDecay(dt, time_constant_up_);
  decay_down_ = lagDecay(dt, time_constant_down_);
}

void RotorLag::lead(RotorArray& command, double lead, double most, double dt) noexcept {
  prepare(dt);
  for (Eigen::Index i = 0; i < speeds_.size(); ++i) {
    const double way = command[i] - speeds_[i];
    const double decay = way > 0.0 ? decay_up_ : decay_down_;
    // In dt it goes the share 1 - decay of the way that it is told.
    const double factor = lead * (1.0 - decay) < 1.0 ? lead : 1.0 / (1.0 - decay);
    command[i] = std::clamp(speeds_[i] + factor * way, 0.0, most);
  }
}

void RotorLag::turn(const RotorArray& command, double dt) noexcept {
  prepare(dt);
  for (Eigen::Index i = 0; i < speeds_.size(); ++i) {
    const double away = speeds_[i] - command[i];
    speeds_[i] = command[i] + away * (away < 0.0 ? decay_up_ : decay_down_);
  }
}

}  // namespace aqc
