#include "adaptive_quadrotor_control/law/composite/thrust_share.h"

#include <algorithm>
#include <cmath>

#include "adaptive_quadrotor_control/math/constants.h"

namespace aqc {
namespace {

constexpr double kHeightShare = 0.9;  // of the thrust that a hover leaves
constexpr double kLeastRise = 0.25;   // of the weight: what points up can be steered

double leg(double hypotenuse, double other) noexcept {
  return std::sqrt(std::max(hypotenuse * hypotenuse - other * other, 0.0));
}

}  // namespace

double ThrustShare::claim(double vertical, double mass) const noexcept {
  const double weight = mass * kGravity;
  return std::min(vertical, weight + kHeightShare * (most_ - weight));
}

double ThrustShare::sideways(double mass) const noexcept {
  return leg(most_, claim(most_, mass)) / mass;
}

double ThrustShare::upwards(double mass) const noexcept {
  return most_ / mass - kGravity;
}

ThrustShare::Force ThrustShare::share(const Eigen::Vector3d& asked, double mass) const noexcept {
  const double least = std::min(kLeastRise * mass * kGravity, most_);
  double vertical = std::clamp(asked.z(), least, most_);
  bool clamped = vertical != asked.z();
  const double side = asked.head<2>().norm();
  const double room = std::min(slope_ * vertical, leg(most_, claim(vertical, mass)));
  double kept = 1.0;
  if (side > room) {
    kept = room / side;
    clamped = true;
  }
  const double left = leg(most_, kept * side);
  if (vertical > left) {
    vertical = left;
    clamped = true;
  }
  Force shared;
  shared.force << kept * asked.head<2>(), vertical;
  shared.clamped = clamped;
  return shared;
}

}  // namespace aqc
