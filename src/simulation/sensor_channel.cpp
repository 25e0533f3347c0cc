#include "adaptive_quadrotor_control/simulation/sensor_channel.h"

#include <algorithm>
#include <limits>

#include "adaptive_quadrotor_control/math/rotations.h"

namespace aqc {
namespace {

enum Stream : std::uint64_t { kOdometryNoise, kOdometryLink, kImuNoise, kOdometryWander };

bool anyContains(const std::vector<TimeWindow>& windows, Nanoseconds time) {
  return std::any_of(windows.begin(), windows.end(),
                     [time](const TimeWindow& window) { return window.contains(time); });
}

Nanoseconds stampOf(Nanoseconds now, Nanoseconds age, const std::vector<StampError>& errors) {
  for (const StampError& error : errors) {
    if (error.window.contains(age)) now += error.offset;
  }
  return now;
}

// Turns an attitude by a small vector in B [rad].
void turnLittle(const Eigen::Vector3d& angles, Eigen::Quaterniond& attitude) {
  const Eigen::Vector3d half = 0.5 * angles;
  attitude = attitude * Eigen::Quaterniond(1.0, half.x(), half.y(), half.z());
  attitude.normalize();
}

// Whether a measurement is due at `now`; the next one is then due a period after it was.
bool measures(Nanoseconds now, Nanoseconds period, Nanoseconds& due) {
  if (now < due) return false;
  while (due <= now) due += period;
  return true;
}

}  // namespace

OdometryChannel::OdometryChannel(const OdometryFaults& faults, std::uint64_t seed,
                                 Nanoseconds start)
    : faults_(faults),
      start_(start),
      due_(start),
      noise_(seed, kOdometryNoise),
      link_(seed, kOdometryLink),
      slow_(seed, kOdometryWander),
      wanders_(faults.wander.position > 0.0 || faults.wander.attitude > 0.0),
      jumped_(faults.jumps.size()),
      last_arrival_(start) {
  if (!wanders_) return;
  wander_ = faults.wander.position * slow_.normal3();
  lean_ = faults.wander.attitude * slow_.normal3();
}

void OdometryChannel::observe(const State& truth, Nanoseconds now) {
  if (!measures(now, faults_.period, due_)) return;
  const Nanoseconds age = now - start_;
  drift(truth.position);
  jump(age, truth.position);
  const State state = measured(truth, age);
  if (!anyContains(faults_.gaps, age)) send(state, now);
}

// Turns the estimator's world so that the place at `pivot` stays where it was, then shifts it.
void OdometryChannel::moveFrame(double yaw, const Eigen::Vector3d& shift,
                                const Eigen::Vector3d& pivot) {
  if (yaw != 0.0) {
    frame_.shift += yawRotation(frame_.yaw) * pivot - yawRotation(frame_.yaw + yaw) * pivot;
    frame_.yaw += yaw;
  }
  frame_.shift += shift;
}

void OdometryChannel::drift(const Eigen::Vector3d& pivot) {
  if (faults_.position_drift == 0.0 && faults_.yaw_drift == 0.0) return;
  const double root = std::sqrt(toSeconds(faults_.period));
  const double yaw = faults_.yaw_drift * root * noise_.normal();
  moveFrame(yaw, faults_.position_drift * root * noise_.normal3(), pivot);
}

void OdometryChannel::jump(Nanoseconds age, const Eigen::Vector3d& pivot) {
  for (std::size_t i = 0; i < jumped_.size(); ++i) {
    const OdometryJump& jump = faults_.jumps[i];
    const bool on = jump.window.contains(age);
    if (on && !jumped_[i]) {
      const Frame before = frame_;
      moveFrame(jump.yaw, jump.position, pivot);
      jumped_[i] = Frame{jump.yaw, frame_.shift - before.shift};
    } else if (!on && jumped_[i]) {
      frame_.yaw -= jumped_[i]->yaw;
      frame_.shift -= jumped_[i]->shift;
      jumped_[i].reset();
    }
  }
}

State OdometryChannel::measured(const State& truth, Nanoseconds age) {
  State state = truth;
  if (frame_.yaw != 0.0) {
    const Eigen::Quaterniond turn = yawRotation(frame_.yaw);
    state.position = turn * state.position;
    state.velocity = turn * state.velocity;
    state.attitude = turn * state.attitude;
  }
  state.position += frame_.shift;
  if (wanders_) addWander(state);
  addNoise(state);
  if (!anyContains(faults_.freezes, age)) {
    frozen_.reset();
  } else {
    if (!frozen_) frozen_ = state;
    state = *frozen_;
  }
  if (anyContains(faults_.not_a_number, age)) {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    state.position.setConstant(nan);
    state.velocity.setConstant(nan);
    state.attitude.coeffs().setConstant(nan);
    state.body_rate.setConstant(nan);
  }
  return state;
}

void OdometryChannel::addNoise(State& state) {
  const OdometryNoise& sigma = faults_.noise;
  if (sigma.position > 0.0) state.position += sigma.position * noise_.normal3();
  if (sigma.velocity > 0.0) state.velocity += sigma.velocity * noise_.normal3();
  if (sigma.attitude > 0.0) turnLittle(sigma.attitude * noise_.normal3(), state.attitude);
  if (sigma.body_rate > 0.0) state.body_rate += sigma.body_rate * noise_.normal3();
}

void OdometryChannel::addWander(State& state) {
  state.position += wander_;
  turnLittle(lean_, state.attitude);
  const double rest = std::exp(-toSeconds(faults_.period) / faults_.wander.time);
  const double fresh = std::sqrt(1.0 - rest * rest);
  wander_ = rest * wander_ + fresh * faults_.wander.position * slow_.normal3();
  lean_ = rest * lean_ + fresh * faults_.wander.attitude * slow_.normal3();
}

void OdometryChannel::send(const State& state, Nanoseconds now) {
  // As many draws for each message, so that one fault's share does not move another's dice.
  const double late = link_.uniform();
  const bool dropped = link_.chance(faults_.dropped);
  const bool duplicated = link_.chance(faults_.duplicated);
  const bool reordered = link_.chance(faults_.reordered);
  if (dropped) return;
  const auto jitter = static_cast<Nanoseconds>(late * static_cast<double>(faults_.jitter));
  OdometryMessage message{state, stampOf(now, now - start_, faults_.stamps),
                          std::max(now + faults_.delay + jitter, last_arrival_)};
  if (reordered) {
    message.arrival += faults_.period + faults_.period / 2;
  } else {
    last_arrival_ = message.arrival;
  }
  queue_.send(message);
  if (duplicated) queue_.send(message);
}

ImuChannel::ImuChannel(const ImuFaults& faults, std::uint64_t seed, Nanoseconds start)
    : faults_(faults), start_(start), due_(start), noise_(seed, kImuNoise) {}

void ImuChannel::observe(const Eigen::Vector3d& specific_force, const Eigen::Vector3d& body_rate,
                         Nanoseconds now) {
  if (!measures(now, faults_.period, due_)) return;
  const Nanoseconds age = now - start_;
  ImuMessage message{specific_force, body_rate, stampOf(now, age, faults_.stamps),
                     now + faults_.delay};
  message.specific_force += faults_.force_bias;
  message.body_rate += faults_.rate_bias;
  if (faults_.force_noise > 0.0) message.specific_force += faults_.force_noise * noise_.normal3();
  if (faults_.rate_noise > 0.0) message.body_rate += faults_.rate_noise * noise_.normal3();
  if (!anyContains(faults_.gaps, age)) queue_.send(message);
}

}  // namespace aqc
