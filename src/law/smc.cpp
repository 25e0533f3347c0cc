#include "adaptive_quadrotor_control/law/smc.h"

#include "adaptive_quadrotor_control/law/saturation.h"

namespace aqc {

Smc::Loop::Loop(const ParameterReader& reader)
    : slope(reader.vector3("slope", Range::positive())),
      reaching_gain(reader.vector3("reaching_gain", Range::positive())),
      nominal(reader.vector3("nominal", Range::positive())),
      payload_bound(reader.vector3("payload_bound", Range::nonNegative())),
      boundary_layer(reader.number("boundary_layer", Range::positive())) {}

Eigen::Vector3d Smc::Loop::update(const Eigen::Vector3d& error, const Eigen::Vector3d& rate,
                                  const Eigen::Vector3d& feed_forward,
                                  Eigen::Vector3d& sliding) const noexcept {
  sliding = rate + slope.cwiseProduct(error);
  const Eigen::Vector3d b = feed_forward - slope.cwiseProduct(rate);
  const Eigen::Vector3d kappa = reaching_gain + payload_bound.cwiseProduct(b.cwiseAbs());
  return nominal.cwiseProduct(b) - kappa.cwiseProduct(saturatePerAxis(sliding, boundary_layer));
}

Smc::Smc(const ParameterReader& reader)
    : CascadedLaw(reader),
      position_(reader.child("position")),
      attitude_(reader.child("attitude")) {}

Eigen::Vector3d Smc::force(const PositionErrors& errors, const SetPoint& set_point) noexcept {
  const Eigen::Vector3d feed_forward = set_point.acceleration + kGravity * Eigen::Vector3d::UnitZ();
  return position_.update(errors.position, errors.velocity, feed_forward,
                          telemetry_.sliding_position);
}

Eigen::Vector3d Smc::moment(const State&, const AttitudeErrors& errors) noexcept {
  return attitude_.update(errors.angle, errors.rate, Eigen::Vector3d::Zero(),
                          telemetry_.sliding_attitude);
}

}  // namespace aqc
