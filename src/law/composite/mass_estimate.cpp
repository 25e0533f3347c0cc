#include "adaptive_quadrotor_control/law/composite/mass_estimate.h"

#include <algorithm>
#include <cmath>

#include "adaptive_quadrotor_control/math/constants.h"
#include "adaptive_quadrotor_control/parameters/parameter_reader.h"
#include "law/composite/within.h"
#include "law/gain_ranges.h"

namespace aqc {
namespace {

constexpr double kSampleTime = 0.005;  // [s]: as much as an accelerometer's noise asks for
constexpr double kShiftTime = 0.1;     // [s]
constexpr double kLeastThrust = 0.3;   // of the empty vehicle's weight: less tells too little
constexpr double kLeastLift = 0.3;     // of gravity
// The rotors give less than this share of what the empty vehicle needs: something else holds it.
constexpr double kLiftedShare = 0.8;
constexpr double kLeastMass = 0.7;   // of the empty mass: a force constant may be wrong
constexpr double kMostMass = 0.98;   // of what the rotors can lift
constexpr double kMostForce = 30.0;  // [m/s^2]
const Range kTimeConstant = Range::positiveUpTo(100.0);

}  // namespace

MassEstimate::MassEstimate(const ParameterReader& reader, const Vehicle& vehicle)
    : empty_mass_(vehicle.mass),
      liftable_(vehicle.maxThrust() / kGravity),
      most_(kMostMass * liftable_),
      sample_(kSampleTime),
      mass_lag_(reader.number({"mass_time", "tau_m", "s", "time constant of the mass, with an IMU"},
                              kTimeConstant)),
      force_lag_(reader.number(
          {"force_time", "tau_f", "s", "time constant of the force beside the rotors, with an IMU"},
          kTimeConstant)),
      motion_lag_(reader.number(
          {"acceleration_time", "tau_a", "s", "time constant of the acceleration in the body rate"},
          kTimeConstant)),
      velocity_lag_(1.0 / reader.number({"velocity_bandwidth", "omega_v", "rad/s",
                                         "of the velocity's observer, without an IMU"},
                                        kDecay)),
      shift_lag_(kShiftTime) {
  learned_.mass = values_.mass = empty_mass_;
}

double MassEstimate::within(double mass) const noexcept {
  return std::min(std::max(mass, kLeastMass * empty_mass_), most_);
}

// Until the rotors carry it, the ground does, and nothing can be learned. `lift` is felt [m/s^2].
void MassEstimate::watchLift(double thrust, double lift) noexcept {
  const double weight = empty_mass_ * std::max(lift, kLeastLift * kGravity);
  values_.lifted = learned_.lifted || thrust > kLiftedShare * weight;
}

void MassEstimate::feel(const Eigen::Vector3d& felt, double thrust, const Eigen::Matrix3d& attitude,
                        double dt) noexcept {
  const Eigen::Vector3d sample = aqc::within(felt, 1e3);
  values_ = learned_;
  values_.sees = false;
  values_.feels = true;
  if (!learned_.feels) {
    values_.thrust = thrust;
    values_.felt = values_.smooth = sample;
  } else {
    const double share = sample_.share(dt);
    values_.thrust += share * (thrust - values_.thrust);
    values_.felt += share * (sample - values_.felt);
    values_.smooth += motion_lag_.share(dt) * (sample - values_.smooth);
  }
  watchLift(values_.thrust, values_.felt.z());
  if (!values_.lifted) return;
  const double lift = values_.felt.z();
  if (values_.thrust > kLeastThrust * empty_mass_ * kGravity && lift > kLeastLift * kGravity) {
    const double gap = values_.thrust / lift - values_.mass;
    values_.mass = within(values_.mass + mass_lag_.share(dt) * gap);
  }
  const Eigen::Vector3d sideways =
      attitude.leftCols<2>() * values_.felt.head<2>();  // no rotor pushes there
  values_.force += force_lag_.share(dt) * (sideways - values_.force);
}

void MassEstimate::see(const Eigen::Vector3d& velocity, const Eigen::Vector3d& z_body,
                       double thrust, double elapsed) noexcept {
  values_ = learned_;
  values_.feels = false;
  watchLift(thrust, kGravity);
  if (!learned_.sees || !values_.lifted) {
    values_.velocity = velocity;
    values_.sees = true;
    return;
  }
  if (elapsed <= 0.0) return;
  Eigen::Vector3d acceleration = (thrust / values_.mass) * z_body + values_.force;
  acceleration.z() -= kGravity;
  values_.velocity += elapsed * acceleration;
  const Eigen::Vector3d gap = aqc::within(velocity - values_.velocity, 1e3);
  const double share = velocity_lag_.share(elapsed);
  values_.velocity = velocity - (1.0 - share) * (1.0 - share) * gap;
  values_.force = aqc::within(values_.force + (share * share / elapsed) * gap, kMostForce);

  // What pushes along the thrust is a wrong mass.
  const double lift = thrust / values_.mass + z_body.dot(values_.force);
  if (thrust < kLeastThrust * empty_mass_ * kGravity || lift < kLeastLift * kGravity) return;
  const double old = values_.mass;
  values_.mass = within(old + shift_lag_.share(elapsed) * (thrust / lift - old));
  values_.force += (thrust / old - thrust / values_.mass) * z_body;
}

void MassEstimate::restart() noexcept {
  values_ = learned_;
  values_.feels = values_.sees = false;
}

Eigen::Vector3d MassEstimate::specificForce(double thrust) const noexcept {
  Eigen::Vector3d force(0.0, 0.0, thrust / values_.mass);
  if (values_.feels) force.head<2>() = values_.smooth.head<2>();
  return force;
}

void MassEstimate::reset() noexcept {
  learned_ = Values();
  learned_.mass = within(empty_mass_);
  values_ = learned_;
}

void MassEstimate::adopt(double mass) noexcept {
  reset();
  if (!std::isfinite(mass)) return;
  learned_.mass = within(mass);
  learned_.lifted = true;
  values_ = learned_;
}

void MassEstimate::adopt(const MassEstimate& old) noexcept {
  learned_ = old.learned_;
  learned_.mass = within(learned_.mass);
  values_ = learned_;
}

void MassEstimate::bound(double most) noexcept {
  most_ = std::min(most, kMostMass * liftable_);
  learned_.mass = within(learned_.mass);
  values_.mass = within(values_.mass);
}

bool MassEstimate::finite() const noexcept {
  return std::isfinite(learned_.mass) && learned_.force.allFinite() && learned_.felt.allFinite() &&
         learned_.velocity.allFinite();
}

}  // namespace aqc
