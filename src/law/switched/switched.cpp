#include "adaptive_quadrotor_control/law/switched/switched.h"

#include <algorithm>
#include <cmath>

#include "adaptive_quadrotor_control/law/switched/switched_parameters.h"
#include "adaptive_quadrotor_control/math/rotations.h"
#include "adaptive_quadrotor_control/parameters/parameter_reader.h"

namespace aqc {
namespace {

constexpr int kValuesPerSubsystem = 6;
static_assert(kMaxSubsystems * kValuesPerSubsystem + 2 <= kMaxAdaptive, "telemetry has no room");

const double kLeastCosine = std::cos(Switched::kSteepest);

// Roll, pitch, yaw and the matrix that turns body rates into their derivatives.
struct EulerKinematics {
  Eigen::Vector3d angles;  // (phi, theta, psi) [rad]
  Eigen::Matrix3d rate_matrix;
};

EulerKinematics eulerKinematics(const Eigen::Matrix3d& R) noexcept {
  const double sin_pitch = std::min(1.0, std::max(-1.0, -R(2, 0)));
  const double cos_pitch = std::hypot(R(2, 1), R(2, 2));  // >= 0
  const double roll = std::atan2(R(2, 1), R(2, 2));
  const double sin_roll = cos_pitch > 0.0 ? R(2, 1) / cos_pitch : 0.0;
  const double cos_roll = cos_pitch > 0.0 ? R(2, 2) / cos_pitch : 1.0;
  const double secant = 1.0 / std::max(cos_pitch, kLeastCosine);
  EulerKinematics euler;
  euler.angles = {roll, std::asin(sin_pitch), std::atan2(R(1, 0), R(0, 0))};
  euler.rate_matrix << 1.0, sin_roll * sin_pitch * secant, cos_roll * sin_pitch * secant,  //
      0.0, cos_roll, -sin_roll,                                                            //
      0.0, sin_roll * secant, cos_roll * secant;
  return euler;
}

}  // namespace

Switched::Switched(const ParameterReader& reader, const Vehicle& vehicle)
    : arm_length_(vehicle.rotors.front().arm_length),
      law_(readSwitchedLaw(reader, kMaxSubsystems)),
      switch_(readSubsystemSwitch(reader, law_)),
      velocity_slope_(reader.number(
          {"acceleration_cut_off", "", "Hz", "of the derivatives of body rate and velocity"},
          Range::positiveUpTo(1e4))),
      rate_slope_(velocity_slope_) {
  report();
}

void Switched::sense(const Sensed& sensed, const SetPoint& set_point, double dt) noexcept {
  const State& state = sensed.state;
  const Eigen::Matrix3d R = state.attitude.toRotationMatrix();
  const EulerKinematics euler = eulerKinematics(R);
  telemetry_.position_error = state.position - set_point.position;
  telemetry_.velocity_error = state.velocity - set_point.velocity;
  telemetry_.attitude_error = {euler.angles.x(), euler.angles.y(),
                               std::remainder(euler.angles.z() - set_point.yaw, 2.0 * M_PI)};
  telemetry_.rate_error = euler.rate_matrix * state.body_rate;
  telemetry_.rate_error.z() -= set_point.yaw_rate;
  telemetry_.desired_attitude = yawRotation(set_point.yaw);

  velocity_slope_.step(state.velocity, dt);
  rate_slope_.step(state.body_rate, dt);
  Eigen::Vector3d linear = velocity_slope_.value();
  if (sensed.specific_force) {
    linear = R * *sensed.specific_force - kGravity * Eigen::Vector3d::UnitZ();
  }
  const Eigen::Vector3d angular = euler.rate_matrix * rate_slope_.value();

  in_.error << telemetry_.position_error.z(), telemetry_.attitude_error,
      telemetry_.velocity_error.z(), telemetry_.rate_error;
  in_.desired_acceleration = {set_point.acceleration.z(), 0.0, 0.0, 0.0};
  in_.acceleration = std::sqrt(linear.squaredNorm() + angular.squaredNorm());
}

Wrench Switched::command(const Sensed& sensed, const SetPoint& set_point, double dt) noexcept {
  sense(sensed, set_point, dt);
  out_ = law_.output(switch_.active() - 1, in_);
  const Eigen::Vector4d& input = out_.input;
  telemetry_.force = input[0] * (sensed.state.attitude * Eigen::Vector3d::UnitZ());
  report();
  return {input[0], {arm_length_ * input[1], arm_length_ * input[2], input[3]}};
}

void Switched::adapt(const Achieved&, double dt) noexcept {
  law_.adapt(switch_.active() - 1, in_, out_.filtered_error.norm(), dt);
  report();
}

void Switched::reset() noexcept {
  law_.reset();
  velocity_slope_.reset();
  rate_slope_.reset();
  out_ = {};
  report();
}

void Switched::adopt(const ControlLaw& old) noexcept {
  const auto* same = dynamic_cast<const Switched*>(&old);
  if (same == nullptr || same->law_.count() != law_.count()) return;
  law_.adopt(same->law_);
  switch_.adopt(same->switch_);
  velocity_slope_.adopt(same->velocity_slope_);
  rate_slope_.adopt(same->rate_slope_);
  out_ = {};
  report();
}

bool Switched::finite() const noexcept {
  return law_.finite() && velocity_slope_.value().allFinite() && rate_slope_.value().allFinite();
}

std::vector<AdaptiveQuantity> Switched::adaptiveQuantities() const {
  // Inside D (...) stand accelerations: of z [m/s^2] and of the angles [rad/s^2].
  const AdaptiveQuantity each[kValuesPerSubsystem] = {
      {"theta_0", "m/s\u00b2"},
      {"theta_1", "m/s\u00b2/\u2016\u03be\u2016"},
      {"theta_2", "m/s\u00b2/\u2016\u03be\u2016\u00b2"},
      {"theta_3", "1"},
      {"zeta", "m/s\u00b2"},
      {"gamma", "m/s\u00b2"}};
  std::vector<AdaptiveQuantity> all;
  for (int i = 1; i <= law_.count(); ++i) {
    for (const AdaptiveQuantity& quantity : each) {
      all.push_back({quantity.name + "[" + std::to_string(i) + "]", quantity.unit});
    }
  }
  all.insert(all.end(), {{"active_subsystem", ""}, {"rho", "m/s\u00b2"}});
  return all;
}

void Switched::report() noexcept {
  telemetry_.sliding_position = {0.0, 0.0, out_.filtered_error[0]};
  telemetry_.sliding_attitude = out_.filtered_error.tail<3>();
  telemetry_.adaptive.resize(kValuesPerSubsystem * law_.count() + 2);
  Eigen::Index next = 0;
  for (int i = 0; i < law_.count(); ++i) {
    const SubsystemGains& gains = law_.subsystem(i).gains();
    telemetry_.adaptive.segment<4>(next) = gains.theta;
    telemetry_.adaptive[next + 4] = gains.zeta;
    telemetry_.adaptive[next + 5] = gains.gamma;
    next += kValuesPerSubsystem;
  }
  telemetry_.adaptive[next] = switch_.active();
  telemetry_.adaptive[next + 1] = out_.robust_gain;
}

}  // namespace aqc
