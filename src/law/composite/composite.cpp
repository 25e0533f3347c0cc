#include "adaptive_quadrotor_control/law/composite/composite.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "adaptive_quadrotor_control/law/saturation.h"
#include "law/within.h"

namespace aqc {
namespace {

constexpr double kLongest = 0.05;       // [s]: over longer steps nothing is observed
constexpr double kOldest = 0.2;         // [s]: nothing is predicted further
constexpr double kFarthest = 1e3;       // of errors and rates: nobody flies there
constexpr double kMostSliding = 2.0;    // [m/s]
constexpr double kMostBias = 3.0;       // [m/s^2]
constexpr double kBiasLeak = 0.05;      // sigma [1/s]
constexpr double kShedding = 1.0;       // [s]: what loses its mass faster than in this has shed it
constexpr double kMostTurn = 3.0;       // [rad/s], of the feed-forward
constexpr double kSidewaysShare = 0.7;  // of the acceleration that the thrust leaves
constexpr double kDownwardShare = 0.8;
constexpr double kLeastSideways = 0.3;  // [m/s^2]
constexpr double kLeastDownward = 0.2;

// Sideways by the norm, and by itself the height.
Eigen::Vector3d bounded(const Eigen::Vector3d& vector, double most) noexcept {
  const double side = std::max(vector.head<2>().norm(), most);
  Eigen::Vector3d result;
  result << vector.head<2>() * (most / side), std::clamp(vector.z(), -most, most);
  return result;
}

template <std::size_t Count>
void adaptGains(std::array<AdaptiveGain, Count>& gains, double size, double xi,
                double dt) noexcept {
  double drive = std::min(size, 1.0);
  const double factor = std::min(xi, 1.0);
  for (AdaptiveGain& gain : gains) {
    gain.step(drive, dt);
    drive *= factor;
  }
}

// rho = sum_i K_i ||xi||^i
template <std::size_t Count>
double robust(const std::array<AdaptiveGain, Count>& gains, double xi) noexcept {
  double rho = 0.0;
  for (std::size_t i = Count; i-- > 0;) rho = rho * xi + gains[i].value();
  return rho;
}

Ages agesOf(const Ages& ages) noexcept {
  const auto limited = [](double age) { return std::clamp(age, 0.0, kOldest); };
  return {limited(ages.pose), limited(ages.body_rate), limited(ages.specific_force)};
}

}  // namespace

Wrench Composite::command(const Sensed& sensed, const SetPoint& set_point, double dt) noexcept {
  sense(sensed, dt);
  const Motion now = predict(sensed);
  const Pushed pushed = push(now, set_point);
  const Eigen::Vector3d moment = this->moment(now, pushed, set_point);
  telemetry_.position_error = sensed.state.position - set_point.position;
  telemetry_.velocity_error = sensed.state.velocity - set_point.velocity;
  telemetry_.force = pushed.force;
  followed_ = false;
  return {std::max(0.0, pushed.force.dot(now.attitude.col(2))), moment};
}

// Estimates take in what came; adapt() makes it stay.
void Composite::sense(const Sensed& sensed, double dt) noexcept {
  const Ages before = ages_;
  ages_ = agesOf(sensed.ages);
  given_ = meanwhile(applied_, ages_);
  rate_ = within(sensed.state.body_rate, kFarthest);
  follows_ = followed_ && dt <= kLongest;
  // What was heard before is no news: its age grew as time went by.
  rate_elapsed_ = follows_ ? std::max(dt - (ages_.body_rate - before.body_rate), 0.0) : 0.0;
  if (follows_) {
    if (rate_elapsed_ > 0.0) {
      mean_moment_ = applied_.mean(given_.body_rate, ages_.body_rate, rate_elapsed_).moment;
    }
    const bool gyroscope = sensed.specific_force && !sensed.rate_of_odometry;
    const auto source =
        gyroscope ? MomentObserver::Source::kGyroscope : MomentObserver::Source::kOdometry;
    moment_.see(rate_, mean_moment_, inertia_.value(), rate_elapsed_, source);
  } else {
    moment_.restart(rate_);
    mass_.restart();
  }
  if (sensed.specific_force) {
    const double age = ages_.specific_force;
    const double thrust =
        age > 0.0 ? applied_.mean(std::max(age - 0.5 * dt, 0.0), dt).thrust : applied_.now().thrust;
    const Eigen::Matrix3d attitude = sensed.state.attitude.toRotationMatrix();
    mass_.feel(*sensed.specific_force, thrust, attitude, std::min(dt, kLongest));
  } else {
    const double elapsed = follows_ ? std::max(dt - (ages_.pose - before.pose), 0.0) : 0.0;
    const double thrust = elapsed > 0.0 ? applied_.mean(given_.pose, ages_.pose, elapsed).thrust
                                        : applied_.now().thrust;
    mass_.see(within(sensed.state.velocity, kFarthest),
              sensed.state.attitude * Eigen::Vector3d::UnitZ(), thrust, elapsed);
  }
}

Composite::Motion Composite::predict(const Sensed& sensed) const noexcept {
  Motion now;
  const Eigen::Vector3d& inertia = inertia_.value();
  now.state.body_rate = predictedRate(moment_, given_.body_rate, inertia, ages_.body_rate);
  now.state.attitude = predictedAttitude(sensed.state.attitude, moment_, given_, inertia, ages_);
  now.attitude = now.state.attitude.toRotationMatrix();
  now.acceleration = now.attitude * mass_.specificForce(applied_.now().thrust) + bias_;
  if (mass_.seesOnly()) now.acceleration += mass_.force();
  now.acceleration.z() -= kGravity;
  const double age = ages_.pose;
  now.state.velocity = sensed.state.velocity + age * now.acceleration;
  now.state.position =
      sensed.state.position + age * sensed.state.velocity + (0.5 * age * age) * now.acceleration;
  return now;
}

// The force that takes the vehicle to the surface, and how it is about to change.
Composite::Pushed Composite::push(const Motion& now, const SetPoint& set_point) noexcept {
  const double mass = mass_.mass();
  const Eigen::Vector3d error = within(now.state.position - set_point.position, kFarthest);
  const Eigen::Vector3d rate = within(now.state.velocity - set_point.velocity, kFarthest);
  Approach sideways = sideways_;
  sideways.braking = std::clamp(kSidewaysShare * share_.sideways(mass), kLeastSideways,
                                std::max(sideways_.braking, kLeastSideways));
  Approach vertical = vertical_;
  if (error.z() > 0.0) {  // what sinks brakes by thrust, what rises by its weight
    vertical.braking = std::clamp(kDownwardShare * share_.upwards(mass), kLeastDownward,
                                  std::max(vertical_.braking, kLeastDownward));
  }
  const BoundedSurface surface(error, sideways, vertical);
  const Eigen::Vector3d sliding = rate + surface.value();
  const Eigen::Vector3d sliding_bounded = bounded(sliding, kMostSliding);
  const double xi = std::sqrt(error.squaredNorm() + rate.squaredNorm());

  const Eigen::Vector3d slope_rate = surface.slopeTimes(rate);
  Eigen::Vector3d wanted =
      set_point.acceleration - slope_rate - gain_.cwiseProduct(sliding_bounded) -
      robust(gains_, xi) * saturate(sliding, boundary_layer_) - mass_.force() - bias_;
  wanted.z() += kGravity;
  const ThrustShare::Force shared = share_.share(mass * wanted, mass);
  telemetry_.sliding_position = sliding;
  outer_ = {
      sliding_bounded, sliding.norm(), xi, surface.linearSideways(), surface.linearVertically(),
      shared.clamped};

  const Eigen::Vector3d miss = now.acceleration - set_point.acceleration;
  Eigen::Vector3d jerk = set_point.jerk - surface.slopeTimes(miss);
  if (!shared.clamped) jerk -= gain_.cwiseProduct(miss + slope_rate);
  return {shared.force, jerk};
}

Eigen::Vector3d Composite::moment(const Motion& now, const Pushed& pushed,
                                  const SetPoint& set_point) noexcept {
  const Eigen::Vector3d& inertia = inertia_.value();
  const Eigen::Matrix3d desired = desiredAttitude(pushed.force, set_point.yaw, tilt_);
  const Eigen::Vector3d z = desired.col(2);
  // What turns z_d as the force turns: omega_d = z_d x h.
  const Eigen::Vector3d turning =
      within(pushed.jerk, kFarthest) * (mass_.mass() / pushed.force.norm());
  const Eigen::Vector3d turn = within(z.cross(turning), kMostTurn);
  AttitudeErrors errors = attitudeErrors(now.state, desired, set_point.yaw_rate);
  errors.rate -= now.attitude.transpose() * turn;

  // What the rotors will still do on their way counts as done.
  const Eigen::Vector3d coming =
      (applied_.now().moment + moment_.moment()).cwiseQuotient(inertia) * rotor_time_;
  const Eigen::Vector3d sliding = errors.rate + coming + turn_slope_.cwiseProduct(errors.angle);
  const double xi = std::sqrt(errors.angle.squaredNorm() + errors.rate.squaredNorm());
  inner_ = {sliding.norm(), xi};
  telemetry_.attitude_error = errors.angle;
  telemetry_.rate_error = errors.rate;
  telemetry_.sliding_attitude = sliding;
  telemetry_.desired_attitude = Eigen::Quaterniond(desired);

  const Eigen::Vector3d turning_up =
      -turn_slope_.cwiseProduct(errors.rate) - turn_gain_.cwiseProduct(sliding) -
      robust(turn_gains_, xi) * saturate(sliding, turn_boundary_layer_);
  const Eigen::Vector3d& omega = now.state.body_rate;
  return inertia.cwiseProduct(turning_up) + omega.cross(inertia.cwiseProduct(omega)) -
         moment_.moment();
}

void Composite::adapt(const Achieved& achieved, double dt) noexcept {
  const double kept = mass_.mass() / mass_.learnedMass();
  mass_.keep();
  moment_.keep();
  if (rate_elapsed_ > 0.0) {
    const Eigen::Vector3d before = inertia_.value();
    const Eigen::Vector3d spin = before.cwiseProduct(rate_);
    inertia_.update(rate_, mean_moment_ - rate_.cross(spin), mass_.mass(), rate_elapsed_);
    if (kept < 1.0 - dt / kShedding) {
      moment_.shrink(inertia_.value().cwiseQuotient(before).cwiseMin(1.0));
    }
  } else if (!follows_) {
    inertia_.restart();
  }
  followed_ = true;
  if (!outer_.clamped && !achieved.allocation.saturated) {
    adaptGains(gains_, outer_.size, outer_.xi, dt);
    adaptGains(turn_gains_, inner_.size, inner_.xi, dt);
    if (mass_.lifted()) learnBias(std::min(dt, kLongest));
  }
  report();
}

void Composite::learnBias(double dt) noexcept {
  const Eigen::Vector3d drive = bias_drive_.cwiseProduct(outer_.sliding) - kBiasLeak * bias_;
  if (outer_.learns_sideways) bias_.head<2>() += dt * drive.head<2>();
  if (outer_.learns_vertically) bias_.z() += dt * drive.z();
  bias_ = within(bias_, kMostBias);
}

void Composite::reset() noexcept {
  mass_.reset();
  moment_.reset();
  inertia_.reset();
  bias_.setZero();
  for (AdaptiveGain& gain : gains_) gain.reset();
  for (AdaptiveGain& gain : turn_gains_) gain.reset();
  ages_ = {};
  rate_.setZero();
  mean_moment_.setZero();
  rate_elapsed_ = 0.0;
  followed_ = false;
  outer_ = {};
  inner_ = {};
  report();
}

void Composite::adopt(const ControlLaw& old) noexcept {
  if (const auto* same = dynamic_cast<const Composite*>(&old)) {
    mass_.adopt(same->mass_);
    moment_.adopt(same->moment_);
    inertia_.adopt(same->inertia_);
    bias_ = same->bias_;
    for (std::size_t i = 0; i < gains_.size(); ++i) gains_[i].adopt(same->gains_[i].value());
    for (std::size_t i = 0; i < turn_gains_.size(); ++i) {
      turn_gains_[i].adopt(same->turn_gains_[i].value());
    }
    applied_ = same->applied_;
    ages_ = same->ages_;
    followed_ = same->followed_;
  } else {
    mass_.adopt(old.telemetry().liftedMass());
    inertia_.adopt(mass_.mass());
  }
  report();
}

void Composite::bound(const EstimateBounds& bounds) noexcept {
  mass_.bound(bounds.most_mass);
  report();
}

bool Composite::finite() const noexcept {
  const auto isFinite = [](const AdaptiveGain& gain) { return std::isfinite(gain.value()); };
  return mass_.finite() && moment_.finite() && inertia_.finite() && bias_.allFinite() &&
         std::all_of(gains_.begin(), gains_.end(), isFinite) &&
         std::all_of(turn_gains_.begin(), turn_gains_.end(), isFinite);
}

std::vector<AdaptiveQuantity> Composite::adaptiveQuantities() const {
  std::vector<AdaptiveQuantity> quantities = {{"K_p0", "m/s\u00b2"},
                                              {"K_p1", "m/s\u00b2/\u2016\u03be\u2016"},
                                              {"K_q0", "rad/s\u00b2"},
                                              {"K_q1", "rad/s\u00b2/\u2016\u03be\u2016"},
                                              {"K_q2", "rad/s\u00b2/\u2016\u03be\u2016\u00b2"}};
  for (const auto& [symbol, unit] : {std::pair("d_f", "m/s\u00b2"), std::pair("d_s", "m/s\u00b2"),
                                     std::pair("d_q", "N m"), std::pair("J", "kg m\u00b2")}) {
    for (const char* axis : {"x", "y", "z"}) {
      quantities.push_back({std::string(symbol) + axis, unit});
    }
  }
  return quantities;
}

void Composite::report() noexcept {
  telemetry_.mass_estimate = mass_.learnedMass();
  telemetry_.weighed_mass = mass_.weighed();
  telemetry_.adaptive.resize(17);
  telemetry_.adaptive << gains_[0].value(), gains_[1].value(), turn_gains_[0].value(),
      turn_gains_[1].value(), turn_gains_[2].value(), mass_.force(), bias_, moment_.moment(),
      inertia_.value();
}

}  // namespace aqc
