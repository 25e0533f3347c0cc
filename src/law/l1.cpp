#include "adaptive_quadrotor_control/law/l1.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "adaptive_quadrotor_control/parameters/parameter_reader.h"
#include "law/gain_ranges.h"
#include "law/within.h"

namespace aqc {
namespace {

double decay(const ParameterReader& reader, std::size_t which) {
  return reader.numbers(
      {"decay", "a", "1/s", "how fast the predictor forgets its error", {"velocity", "rate"}}, 2,
      kDecay)[which];
}

LowPass filter(const ParameterReader& reader, std::size_t which) {
  const std::vector<double> bandwidth = reader.numbers(
      {"bandwidth", "omega_c", "rad/s", "of the filter of what is answered", {"thrust", "moment"}},
      2, kDecay);
  return LowPass(1.0 / bandwidth[which]);
}

}  // namespace

L1::L1(const ParameterReader& reader, const Vehicle& vehicle)
    : Geometric(reader, vehicle, BodyRate::kJerk),
      inverse_inertia_(inertia().inverse()),
      most_(bearable(vehicle)),
      velocity_(decay(reader.child("predictor"), 0)),
      rate_(decay(reader.child("predictor"), 1)),
      thrust_filter_(filter(reader.child("predictor"), 0)),
      moment_filter_(filter(reader.child("predictor"), 1)) {
  report();
}

Wrench L1::command(const Sensed& sensed, const SetPoint& set_point, double dt) noexcept {
  const Wrench wrench = Geometric::command(sensed, set_point, dt);
  estimate(sensed.state, dt);
  const Eigen::Vector3d z_body = sensed.state.attitude * Eigen::Vector3d::UnitZ();
  Wrench& answer = values_.answer;
  answer.thrust -= thrust_filter_.share(dt) * (values_.force.dot(z_body) + answer.thrust);
  answer.moment -= moment_filter_.share(dt) * (values_.moment + answer.moment);
  telemetry_.force += answer.thrust * z_body;
  state_ = sensed.state;
  given_.reset();
  return {wrench.thrust + answer.thrust, wrench.moment + answer.moment};
}

// The piecewise-constant law lets the predictor's own memory of its error and the last estimate
// cancel each other at the end of each step: what is left is where the rotors alone would have
// taken the state of the last sample.
void L1::estimate(const State& state, double dt) noexcept {
  values_ = learned_;
  if (!given_) return;
  const Eigen::Vector3d& omega = state_.body_rate;
  Eigen::Vector3d acceleration =
      given_->thrust / mass() * (state_.attitude * Eigen::Vector3d::UnitZ());
  acceleration.z() -= kGravity;
  const Eigen::Vector3d turning_up =
      inverse_inertia_ * (given_->moment - omega.cross(inertia() * omega));
  const Eigen::Vector3d velocity_error = state_.velocity + dt * acceleration - state.velocity;
  const Eigen::Vector3d rate_error = omega + dt * turning_up - state.body_rate;
  values_.force = within(-mass() * velocity_.gain(dt) * velocity_error, most_.force);
  const Eigen::Vector3d moment = -rate_.gain(dt) * (inertia() * rate_error);
  values_.moment = moment.cwiseMax(-most_.moment).cwiseMin(most_.moment);
}

void L1::adapt(const Achieved& achieved, double) noexcept {
  learned_ = values_;
  given_ = achieved.allocation.achieved;
  report();
}

void L1::reset() noexcept {
  learned_ = values_ = Values();
  given_.reset();
  report();
}

void L1::adopt(const ControlLaw& old) noexcept {
  if (const auto* same = dynamic_cast<const L1*>(&old)) {
    learned_ = same->learned_;
    state_ = same->state_;
    given_ = same->given_;
  } else {
    learned_ = Values();
    const double weight = (old.telemetry().liftedMass() - mass()) * kGravity;
    learned_.answer.thrust = std::clamp(weight, -most_.force, most_.force);
    learned_.force.z() = -learned_.answer.thrust;
    given_.reset();
  }
  values_ = learned_;
  report();
}

bool L1::finite() const noexcept {
  return learned_.force.allFinite() && learned_.moment.allFinite() &&
         std::isfinite(learned_.answer.thrust) && learned_.answer.moment.allFinite();
}

std::vector<AdaptiveQuantity> L1::adaptiveQuantities() const {
  return {{"sigma_fx", "N"},   {"sigma_fy", "N"},   {"sigma_fz", "N"},
          {"sigma_mx", "N m"}, {"sigma_my", "N m"}, {"sigma_mz", "N m"}};
}

void L1::report() noexcept {
  telemetry_.adaptive.resize(6);
  telemetry_.adaptive << learned_.force, learned_.moment;
}

}  // namespace aqc
