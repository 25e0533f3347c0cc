#include "adaptive_quadrotor_control/law/integral.h"

#include "adaptive_quadrotor_control/parameters/parameter_reader.h"
#include "law/gain_ranges.h"
#include "law/within.h"

namespace aqc {

// What the gains of one integral are called and measured in.
struct Integral::Words {
  std::string index;  // of a symbol
  std::string unit;   // of k_I
  std::string error;  // what is integrated
};

Integral::Action::Action(const ParameterReader& reader, const Words& words)
    : gain(reader.vector3({"gain", "k_I" + words.index, words.unit,
                           "how fast the integral of the " + words.error + " grows"},
                          kPush)),
      mix(reader.number(
          {"mix", "c_" + words.index, "1/s", "weight of the " + words.error + " beside its rate"},
          kDecay)) {}

Eigen::Vector3d Integral::Action::drive(const Eigen::Vector3d& error,
                                        const Eigen::Vector3d& rate) const noexcept {
  return gain.cwiseProduct(rate + mix * error);
}

Integral::Integral(const ParameterReader& reader, const Vehicle& vehicle)
    : Geometric(reader, vehicle, BodyRate::kJerk),
      force_action_(reader.child("force_integral"), {"p", "N/m", "position's error"}),
      moment_action_(reader.child("moment_integral"), {"q", "N m/rad", "attitude's error"}),
      most_(bearable(vehicle)) {
  report();
}

Eigen::Vector3d Integral::force(const PositionErrors& errors, const SetPoint& set_point) noexcept {
  position_errors_ = errors;
  return Geometric::force(errors, set_point) - force_;
}

Eigen::Vector3d Integral::moment(const State& state, const AttitudeErrors& errors) noexcept {
  attitude_errors_ = errors;
  z_body_ = state.attitude * Eigen::Vector3d::UnitZ();
  return Geometric::moment(state, errors) - moment_;
}

void Integral::adapt(const Achieved& achieved, double dt) noexcept {
  Eigen::Vector3d push =
      dt * force_action_.drive(position_errors_.position, position_errors_.velocity);
  Eigen::Vector3d turn = dt * moment_action_.drive(attitude_errors_.angle, attitude_errors_.rate);
  const Allocation& allocation = achieved.allocation;
  if (allocation.saturated) {
    // What the integrals take away from the command grows with them: against the sign of what was
    // asked for in vain they would ask for more of it.
    const Wrench& asked = allocation.requested;
    const Wrench& given = allocation.achieved;
    const double along = push.dot(z_body_);
    if (along * (asked.thrust - given.thrust) < 0.0) push -= along * z_body_;
    const Eigen::Vector3d missing = asked.moment - given.moment;
    turn = (turn.cwiseProduct(missing).array() < 0.0).select(0.0, turn);
  }
  force_ = within(force_ + push, most_.force);
  moment_ = (moment_ + turn).cwiseMax(-most_.moment).cwiseMin(most_.moment);
  report();
}

void Integral::reset() noexcept {
  force_.setZero();
  moment_.setZero();
  report();
}

void Integral::adopt(const ControlLaw& old) noexcept {
  if (const auto* same = dynamic_cast<const Integral*>(&old)) {
    force_ = same->force_;
    moment_ = same->moment_;
  } else {
    const double weight = (mass() - old.telemetry().liftedMass()) * kGravity;
    force_ = within(Eigen::Vector3d(0.0, 0.0, weight), most_.force);
    moment_.setZero();
  }
  report();
}

bool Integral::finite() const noexcept {
  return force_.allFinite() && moment_.allFinite();
}

std::vector<AdaptiveQuantity> Integral::adaptiveQuantities() const {
  return {{"f_Ix", "N"},   {"f_Iy", "N"},   {"f_Iz", "N"},
          {"m_Ix", "N m"}, {"m_Iy", "N m"}, {"m_Iz", "N m"}};
}

void Integral::report() noexcept {
  telemetry_.adaptive.resize(6);
  telemetry_.adaptive << force_, moment_;
}

}  // namespace aqc
