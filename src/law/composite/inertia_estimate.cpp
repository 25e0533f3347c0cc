#include "adaptive_quadrotor_control/law/composite/inertia_estimate.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "adaptive_quadrotor_control/parameters/parameter_reader.h"
#include "law/gain_ranges.h"

namespace aqc {
namespace {

constexpr double kLow = 0.02;         // tl [s]
constexpr double kWide = 0.15;        // tw [s]
constexpr double kMemory = 3.0;       // [s]
constexpr double kRise = 0.1;         // [s]: slowly up, at once down, which is the safe side
constexpr double kForgetting = 30.0;  // of what is known, by a change of mass of one empty vehicle
constexpr double kExcitation = 0.3;   // [rad/s^2 s^1/2], below which the prior rules
// Squared coherence from which on, and up to which, more and more is believed of a fit: a moment
// that nobody told of, as that of a payload just dropped, turns the vehicle against its rotors.
constexpr double kIncoherent = 0.5;
constexpr double kCoherent = 0.8;
constexpr double kLeastInertia = 0.7;  // of J0
constexpr double kMostInertia = 2.5;
constexpr double kMostSlope = 0.07;  // of the bound over the carried mass [m^2]

}  // namespace

InertiaEstimate::InertiaEstimate(const ParameterReader& reader, const Vehicle& vehicle)
    : empty_(vehicle.inertia.diagonal()),
      empty_mass_(vehicle.mass),
      weight_(empty_ * (kExcitation * kExcitation)),
      low_lag_(kLow),
      wide_lag_(kWide),
      forgetting_(kMemory),
      rise_(kRise) {
  const double slope = reader.number(
      {"prior_slope", "", "m^2", "inertia about x and y that a carried kilogram is thought to add"},
      kMatter);
  slope_ = {slope, slope, 0.0};
  reset();
}

void InertiaEstimate::BandPass::start(const Eigen::Vector3d& input) noexcept {
  low = slow = offset = input;
}

Eigen::Vector3d InertiaEstimate::prior(double mass) const noexcept {
  return empty_ + slope_ * std::max(mass - empty_mass_, 0.0);
}

void InertiaEstimate::filter(const Eigen::Vector3d& body_rate, const Eigen::Vector3d& moment,
                             double dt) noexcept {
  if (fresh_) {
    rate_.start(body_rate);
    rate_.offset.setZero();
    moment_.start(moment);
    fresh_ = false;
  }
  const double low = low_lag_.share(dt);
  const double wide = wide_lag_.share(dt);
  moment_.low += low * (moment - moment_.low);
  moment_.slow += wide * (moment_.low - moment_.slow);
  moment_.offset += wide * (moment_.slow - moment_.offset);
  rate_.low += low * (body_rate - rate_.low);
  rate_.slow += wide * (rate_.low - rate_.slow);
  rate_.offset += wide * ((rate_.low - rate_.slow) / kWide - rate_.offset);
}

Eigen::Vector3d InertiaEstimate::trust() const noexcept {
  const Eigen::Array3d both = moment_squares_.cwiseProduct(acceleration_squares_);
  const Eigen::Array3d coherence =
      products_.array().max(0.0).square() / both.max(std::numeric_limits<double>::min());
  return ((coherence - kIncoherent) / (kCoherent - kIncoherent)).max(0.0).min(1.0);
}

void InertiaEstimate::update(const Eigen::Vector3d& body_rate, const Eigen::Vector3d& moment,
                             double mass, double dt) noexcept {
  filter(body_rate, moment, dt);
  const Eigen::Vector3d torque = moment_.slow - moment_.offset;
  const Eigen::Vector3d acceleration = (rate_.low - rate_.slow) / kWide - rate_.offset;
  const double change = std::abs(mass - mass_) / empty_mass_;
  mass_ = mass;
  const double keep = forgetting_.rest(dt) / (1.0 + kForgetting * change);
  moment_squares_ = keep * moment_squares_ + dt * torque.cwiseAbs2();
  products_ = keep * products_ + dt * torque.cwiseProduct(acceleration);
  acceleration_squares_ = keep * acceleration_squares_ + dt * acceleration.cwiseAbs2();
  const Eigen::Vector3d most =
      kMostInertia * empty_.array() + kMostSlope * std::max(mass - empty_mass_, 0.0);
  const Eigen::Vector3d expected = prior(mass);
  const Eigen::Vector3d squares = (moment_squares_ + weight_.cwiseProduct(expected))
                                      .cwiseQuotient((products_ + weight_).cwiseMax(0.2 * weight_));
  const Eigen::Vector3d fit = (expected + trust().cwiseProduct(squares - expected))
                                  .cwiseMax(kLeastInertia * empty_)
                                  .cwiseMin(most);
  const Eigen::Vector3d raised = value_ + rise_.share(dt) * (fit - value_);
  value_ = fit.cwiseMin(raised);
}

void InertiaEstimate::reset() noexcept {
  adopt(empty_mass_);
}

void InertiaEstimate::adopt(double mass) noexcept {
  moment_squares_.setZero();
  products_.setZero();
  acceleration_squares_.setZero();
  rate_.start(Eigen::Vector3d::Zero());
  moment_.start(Eigen::Vector3d::Zero());
  value_ = prior(mass);
  mass_ = mass;
  fresh_ = true;
}

void InertiaEstimate::adopt(const InertiaEstimate& old) noexcept {
  moment_squares_ = old.moment_squares_;
  products_ = old.products_;
  acceleration_squares_ = old.acceleration_squares_;
  rate_ = old.rate_;
  moment_ = old.moment_;
  value_ = old.value_;
  mass_ = old.mass_;
  fresh_ = old.fresh_;
}

}  // namespace aqc
