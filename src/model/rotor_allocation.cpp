#include "adaptive_quadrotor_control/model/rotor_allocation.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>

namespace aqc {
namespace {

// An interval of numbers, narrowed until it may be empty.
struct Interval {
  double low;
  double high;
  bool empty() const { return low > high; }
};

// All s in `interval` for which every entry of base + s * direction lies in [0, limit].
Interval narrow(Interval interval, const RotorArray& base, const RotorArray& direction,
                double limit) {
  const double slack = 1e-9 * limit;  // a request exactly at a limit is met, not scaled
  for (Eigen::Index i = 0; i < base.size(); ++i) {
    const double d = direction[i];
    if (std::abs(d) < 1e-12 * limit) {
      if (base[i] < -slack || base[i] > limit + slack) return {1.0, 0.0};
      continue;
    }
    const double at_zero = (-slack - base[i]) / d;
    const double at_limit = (limit + slack - base[i]) / d;
    interval.low = std::max(interval.low, std::min(at_zero, at_limit));
    interval.high = std::min(interval.high, std::max(at_zero, at_limit));
  }
  return interval;
}

}  // namespace

RotorAllocation::RotorAllocation(const Vehicle& vehicle)
    : max_squared_speed_(vehicle.max_rotor_speed * vehicle.max_rotor_speed) {
  const auto count = static_cast<Eigen::Index>(vehicle.rotors.size());
  forward_.resize(4, count);
  for (Eigen::Index i = 0; i < count; ++i) {
    const Rotor& rotor = vehicle.rotors[static_cast<std::size_t>(i)];
    const Eigen::Vector2d hub = rotor.position();
    forward_.col(i) << 1.0, hub.y(), -hub.x(), -rotor.direction * vehicle.moment_constant;
  }
  forward_ *= vehicle.force_constant;
  // The four rows are independent on any vehicle that wellPosed() accepts.
  const Eigen::Matrix4d gram = forward_ * forward_.transpose();
  inverse_ = forward_.transpose() * gram.inverse();
}

bool RotorAllocation::wellPosed() const {
  return ((forward_ * inverse_) - Eigen::Matrix4d::Identity()).norm() < 1e-9;
}

Wrench RotorAllocation::wrench(const RotorArray& speeds) const noexcept {
  Eigen::Vector4d u = Eigen::Vector4d::Zero();
  for (Eigen::Index i = 0; i < speeds.size(); ++i) u += forward_.col(i) * (speeds[i] * speeds[i]);
  return {u[0], u.tail<3>()};
}

double RotorAllocation::mostThrust(const Eigen::Vector3d& moment) const noexcept {
  double most = std::numeric_limits<double>::infinity();
  for (Eigen::Index i = 0; i < inverse_.rows(); ++i) {
    if (inverse_(i, 0) <= 0.0) continue;  // more thrust does not bring it to its limit
    const double tilt = inverse_(i, 1) * moment.x() + inverse_(i, 2) * moment.y();
    most = std::min(most, (max_squared_speed_ - tilt) / inverse_(i, 0));
  }
  return std::max(most, 0.0);
}

void RotorAllocation::fit(const Wrench& request, RotorArray& squared) const noexcept {
  const RotorArray lift = inverse_.col(0) * request.thrust;
  const RotorArray tilt = inverse_.middleCols<2>(1) * request.moment.head<2>();
  const RotorArray yaw = inverse_.col(3) * request.moment.z();

  const Interval yaw_share = narrow({0.0, 1.0}, lift + tilt, yaw, max_squared_speed_);
  if (!yaw_share.empty()) {
    squared = lift + tilt + yaw_share.high * yaw;
    return;
  }
  // No share of the yaw moment helps: move the thrust to where roll and pitch fit.
  const Interval thrusts = narrow({-1e300, 1e300}, tilt, inverse_.col(0), max_squared_speed_);
  if (!thrusts.empty()) {
    squared = tilt + inverse_.col(0) * std::clamp(request.thrust, thrusts.low, thrusts.high);
    return;
  }
  // Even alone they do not fit: half of full thrust leaves the most room for moments.
  const double middle = 0.5 * max_squared_speed_ * forward_.row(0).sum();
  const RotorArray base = inverse_.col(0) * middle;
  const Interval tilt_share = narrow({0.0, 1.0}, base, tilt, max_squared_speed_);
  squared = base + tilt_share.high * tilt;
}

// With the number of rotors known to the compiler, or Eigen::Dynamic: the same operations in the
// same order, in two thirds of the time.
template <int Rotors>
void RotorAllocation::allocate(const Wrench& request, Allocation& result) const noexcept {
  using Speeds = Eigen::Matrix<double, Rotors, 1, Eigen::ColMajor, Rotors == 4 ? 4 : kMaxRotors, 1>;
  const Eigen::Map<
      const Eigen::Matrix<double, Rotors, 4, Eigen::ColMajor, Rotors == 4 ? 4 : kMaxRotors, 4>>
      inverse(inverse_.data(), inverse_.rows(), 4);
  Speeds squared = Speeds::Zero(inverse_.rows());
  result.requested = request;
  result.saturated = !std::isfinite(request.thrust) || !request.moment.allFinite();
  if (!result.saturated) {
    const Eigen::Vector3d& moment = request.moment;
    squared =
        inverse.col(0) * request.thrust +
        (inverse.col(1) * moment.x() + inverse.col(2) * moment.y() + inverse.col(3) * moment.z());
    result.saturated = !(squared.array() >= 0.0 && squared.array() <= max_squared_speed_).all();
    if (result.saturated) {
      RotorArray fitted;
      fit(request, fitted);
      squared = fitted;
    }
    if (!squared.allFinite()) squared.setZero();  // so large a request that the numbers overflow
  }
  squared = squared.cwiseMax(0.0).cwiseMin(max_squared_speed_);
  result.speeds = squared.cwiseSqrt();
  if (result.saturated) {
    const Eigen::Vector4d u = forward_ * RotorArray(squared);
    result.achieved = {u[0], u.tail<3>()};
  } else {
    result.achieved = request;
  }
}

void RotorAllocation::allocate(const Wrench& request, Allocation& result) const noexcept {
  if (inverse_.rows() == 4) return allocate<4>(request, result);
  allocate<Eigen::Dynamic>(request, result);
}

Allocation RotorAllocation::allocate(const Wrench& request) const noexcept {
  Allocation result;
  allocate(request, result);
  return result;
}

}  // namespace aqc
