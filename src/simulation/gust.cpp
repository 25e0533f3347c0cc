#include "adaptive_quadrotor_control/simulation/gust.h"

#include <algorithm>
#include <cmath>

namespace aqc {
namespace {

constexpr std::uint64_t kGustStream = 100;  // apart from those of the sensors

}  // namespace

// The filters' responses to an impulse are exp(-s) and s exp(-s). Of white noise of unit intensity
// over the time h a state gets the covariances that are the integrals from 0 to h of
//
//     exp(-2 s),  s exp(-2 s),  s^2 exp(-2 s),
//
// and in the end, with h = infinity, it has 1/2, 1/4, 1/4.
Gust::Gust(const SetGust& shape, Nanoseconds step)
    : intensity_(shape.intensity), random_(shape.seed, kGustStream) {
  const double h = shape.speed / shape.length * toSeconds(step);
  decay_ = std::exp(-h);
  carry_ = h * decay_;
  const double left = decay_ * decay_;
  noise_ = rootOf(-0.5 * std::expm1(-2.0 * h), 0.25 * (1.0 - left * (1.0 + 2.0 * h)),
                  0.25 * (1.0 - left * (1.0 + 2.0 * h + 2.0 * h * h)));
  const Root settled = rootOf(0.5, 0.25, 0.25);
  const Eigen::Vector3d draw = random_.normal3();
  first_ = settled.first * draw;
  second_ = settled.cross * draw + settled.second * random_.normal3();
}

Gust::Root Gust::rootOf(double first, double cross, double second) noexcept {
  const double root = std::sqrt(first);
  const double below = cross / root;
  // Of a short step rounding may leave less than nothing.
  return {root, below, std::sqrt(std::max(second - below * below, 0.0))};
}

Eigen::Vector3d Gust::velocity() const noexcept {
  const double root3 = std::sqrt(3.0);
  const Eigen::Vector3d across = root3 * first_ + (1.0 - root3) * second_;
  const Eigen::Vector3d unit(std::sqrt(2.0) * first_.x(), across.y(), across.z());
  return intensity_.cwiseProduct(unit);
}

void Gust::advance() {
  const Eigen::Vector3d draw = random_.normal3();
  second_ =
      carry_ * first_ + decay_ * second_ + noise_.cross * draw + noise_.second * random_.normal3();
  first_ = decay_ * first_ + noise_.first * draw;
}

}  // namespace aqc
