#include "adaptive_quadrotor_control/law/smc.h"

#include "adaptive_quadrotor_control/law/saturation.h"
#include "adaptive_quadrotor_control/parameters/parameter_reader.h"
#include "law/gain_ranges.h"

namespace aqc {

// What a loop's gains are called and measured in.
struct Smc::Words {
  std::string index;  // of a symbol
  std::string push;   // unit of the command
  std::string rate;   // unit of s
  std::string nominal;
  std::string inertia;  // unit of M0
  std::string told;     // what M0 is
};

Smc::Loop::Loop(const ParameterReader& reader, const Words& words)
    : slope(reader.vector3({"slope", "Phi_" + words.index, "1/s",
                            "how fast the error decays on the sliding surface"},
                           kDecay)),
      reaching_gain(reader.vector3(
          {"reaching_gain", "eta_" + words.index, words.push, "push towards the surface"}, kPush)),
      nominal(reader.vector3(
          {"nominal", words.nominal, words.inertia, "the " + words.told + " it is told"}, kMatter)),
      payload_bound(reader.vector3({"payload_bound", "F_" + words.index, words.inertia,
                                    "what the heaviest payload adds to the " + words.told},
                                   Range::between(0.0, kMatter.max))),
      boundary_layer(reader.number({"boundary_layer", "varpi_" + words.index, words.rate,
                                    "smooths sgn(s); smaller is stiffer"},
                                   kLayer)) {}

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
      position_(reader.child("position"), {"p", "N", "m/s", "m0", "kg", "mass"}),
      attitude_(reader.child("attitude"), {"q", "N m", "rad/s", "J0", "kg m^2", "inertia"}) {}

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
