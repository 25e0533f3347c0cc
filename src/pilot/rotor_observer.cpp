#include "adaptive_quadrotor_control/pilot/rotor_observer.h"

#include <Eigen/Geometry>
#include <algorithm>

#include "adaptive_quadrotor_control/math/constants.h"

namespace aqc {
namespace {

constexpr double kBandwidth = 10.0;  // [1/s]: of noise, of what is seen late, and of short pushes
constexpr double kMostGain = 0.5;    // of a long step

// Of one rotor in a hover of the empty vehicle, about an axis across its arm.
double hoverMoment(const Vehicle& vehicle) {
  double arms = 0.0;
  for (const Rotor& rotor : vehicle.rotors) arms += rotor.arm_length;
  const auto count = static_cast<double>(vehicle.rotors.size());
  return vehicle.mass * kGravity / count * (arms / count);
}

}  // namespace

RotorObserver::RotorObserver(const Vehicle& vehicle)
    : inertia_(vehicle.inertia), per_rotor_(1.0 / hoverMoment(vehicle)) {}

void RotorObserver::restart(const Eigen::Vector3d& body_rate) noexcept {
  momentum_ = inertia_ * body_rate;
  unexplained_.setZero();
}

void RotorObserver::observe(const Eigen::Vector3d& body_rate, const Eigen::Vector3d& moment,
                            double dt) noexcept {
  const Eigen::Vector3d momentum = inertia_ * body_rate;
  momentum_ += dt * (moment - body_rate.cross(momentum) + unexplained_);
  unexplained_ = std::min(kBandwidth, kMostGain / dt) * (momentum - momentum_);
}

}  // namespace aqc
