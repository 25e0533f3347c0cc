#include "adaptive_quadrotor_control/law/asmc.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "adaptive_quadrotor_control/law/saturation.h"
#include "adaptive_quadrotor_control/parameters/parameter_reader.h"
#include "law/gain_ranges.h"

namespace aqc {
namespace {

constexpr double kUnbounded = std::numeric_limits<double>::infinity();

// An upper bound that only a file which has it sets.
double readMost(const ParameterReader& reader, const ParameterKey& key, const Range& range) {
  return reader.has(key.name) ? reader.number(key, range) : kUnbounded;
}

template <std::size_t... Index>
std::array<AdaptiveGain, sizeof...(Index)> readGains(const ParameterReader& reader,
                                                     const std::string& index,
                                                     const std::string& unit,
                                                     std::index_sequence<Index...>) {
  constexpr std::size_t kCount = sizeof...(Index);
  const std::vector<double> leak =
      reader.numbers({"leak", "alpha_" + index, "1/s", "forgetting of K_" + index}, kCount, kDecay);
  const std::vector<double> initial =
      reader.numbers({"initial_gains", "K_" + index, unit, "at the start"}, kCount, kPush);
  std::array<AdaptiveGain, kCount> gains = {AdaptiveGain(initial[Index], leak[Index])...};
  if (!reader.has("most_gains")) return gains;
  const std::vector<double> most =
      reader.numbers({"most_gains", "K_" + index, unit, "at the most"}, kCount, kPush);
  for (std::size_t i = 0; i < kCount; ++i) {
    if (most[i] < initial[i]) reader.refuseValue("most_gains", ">= 'initial_gains' in every entry");
    gains[i].bound(0.0, most[i]);
  }
  return gains;
}

AdaptiveGain readMass(const ParameterReader& reader, double most) {
  const double leak = reader.number(
      {"leak", "alpha_m", "1/s", "forgetting of the mass; a steady sag grows with it"}, kDecay);
  const double initial = reader.number({"initial", "m-hat", "kg", "at the start"}, kMatter);
  AdaptiveGain mass(initial, leak);
  if (most == kUnbounded) return mass;
  if (most < initial) reader.refuseValue("most", ">= 'initial' = " + numberText(initial));
  mass.bound(0.0, most);
  return mass;
}

}  // namespace

// What a loop's gains are called and measured in.
struct Asmc::Words {
  std::string index;    // of a symbol
  std::string damping;  // unit of Lambda
  std::string rate;     // unit of s
  std::string push;     // units of K_0, K_1 ...
  ParameterKey limit;   // the bound of rho
};

template <std::size_t Count>
Asmc::Loop<Count>::Loop(const ParameterReader& reader, const Words& words)
    : slope_(reader.positiveDefinite({"slope", "Phi_" + words.index, "1/s",
                                      "how fast the error decays on the sliding surface"},
                                     kDecay.max)),
      gain_(reader.positiveDefinite(
          {"gain", "Lambda_" + words.index, words.damping, "damping towards the surface"},
          kPush.max)),
      boundary_layer_(reader.number({"boundary_layer", "varpi_" + words.index, words.rate,
                                     "smooths sgn(s); smaller is stiffer"},
                                    kLayer)),
      gains_(readGains(reader, words.index, words.push, std::make_index_sequence<Count>())),
      most_rho_(readMost(reader, words.limit, kPush)) {}

template <std::size_t Count>
Eigen::Vector3d Asmc::Loop<Count>::output(const Eigen::Vector3d& error,
                                          const Eigen::Vector3d& rate) noexcept {
  sliding_ = rate + slope_ * error;
  xi_ = std::sqrt(error.squaredNorm() + rate.squaredNorm());
  double rho = 0.0;
  double power = 1.0;  // ||xi||^i
  for (const AdaptiveGain& gain : gains_) {
    rho += gain.value() * power;
    power *= xi_;
  }
  rho = std::min(rho, most_rho_);
  return -gain_ * sliding_ - rho * saturate(sliding_, boundary_layer_);
}

template <std::size_t Count>
void Asmc::Loop<Count>::adapt(double dt) noexcept {
  double drive = sliding_.norm();  // ||s|| ||xi||^i
  for (AdaptiveGain& gain : gains_) {
    gain.step(drive, dt);
    drive *= xi_;
  }
}

template <std::size_t Count>
void Asmc::Loop<Count>::reset() noexcept {
  for (AdaptiveGain& gain : gains_) gain.reset();
}

template <std::size_t Count>
void Asmc::Loop<Count>::adopt(const Loop& old) noexcept {
  for (std::size_t i = 0; i < Count; ++i) gains_[i].adopt(old.gains_[i].value());
}

template <std::size_t Count>
bool Asmc::Loop<Count>::finite() const noexcept {
  double none = 0.0;
  for (const AdaptiveGain& gain : gains_) none += 0.0 * gain.value();
  return none == 0.0;
}

Asmc::Asmc(const ParameterReader& reader)
    : CascadedLaw(reader),
      position_(reader.child("position"),
                {"p", "N s/m", "m/s", "N, N/|xi|", {"most_force", "rho_p", "N", "at the most"}}),
      attitude_(reader.child("attitude"), {"q",
                                           "N m s/rad",
                                           "rad/s",
                                           "N m, N m/|xi|, N m/|xi|^2",
                                           {"most_moment", "rho_q", "N m", "at the most"}}),
      most_mass_(
          readMost(reader.child("mass_estimate"), {"most", "m-hat", "kg", "at the most"}, kMatter)),
      mass_(readMass(reader.child("mass_estimate"), most_mass_)) {
  report();
}

Eigen::Vector3d Asmc::force(const PositionErrors& errors, const SetPoint&) noexcept {
  Eigen::Vector3d force = position_.output(errors.position, errors.velocity);
  force.z() += mass_.value() * kGravity;
  telemetry_.sliding_position = position_.sliding();
  return force;
}

Eigen::Vector3d Asmc::moment(const State&, const AttitudeErrors& errors) noexcept {
  const Eigen::Vector3d moment = attitude_.output(errors.angle, errors.rate);
  telemetry_.sliding_attitude = attitude_.sliding();
  return moment;
}

void Asmc::adapt(const Achieved&, double dt) noexcept {
  position_.adapt(dt);
  attitude_.adapt(dt);
  mass_.step(-position_.sliding().z() * kGravity, dt);  // -s_p' g_p
  report();
}

void Asmc::reset() noexcept {
  position_.reset();
  attitude_.reset();
  mass_.reset();
  report();
}

void Asmc::adopt(const ControlLaw& old) noexcept {
  if (const auto* same = dynamic_cast<const Asmc*>(&old)) {
    position_.adopt(same->position_);
    attitude_.adopt(same->attitude_);
    mass_.adopt(same->mass_.value());
  } else {
    const double mass = old.telemetry().liftedMass();
    if (mass > mass_.value()) mass_.adopt(mass);
  }
  report();
}

void Asmc::bound(const EstimateBounds& bounds) noexcept {
  mass_.bound(0.0, std::min(bounds.most_mass, most_mass_));
  report();
}

bool Asmc::finite() const noexcept {
  return position_.finite() && attitude_.finite() && std::isfinite(mass_.value());
}

std::vector<AdaptiveQuantity> Asmc::adaptiveQuantities() const {
  return {{"K_p0", "N"},
          {"K_p1", "N/\u2016\u03be\u2016"},
          {"K_q0", "N m"},
          {"K_q1", "N m/\u2016\u03be\u2016"},
          {"K_q2", "N m/\u2016\u03be\u2016\u00b2"}};
}

void Asmc::report() noexcept {
  telemetry_.mass_estimate = mass_.value();
  telemetry_.adaptive.resize(5);
  Eigen::Index i = 0;
  for (const AdaptiveGain& gain : position_.gains()) telemetry_.adaptive[i++] = gain.value();
  for (const AdaptiveGain& gain : attitude_.gains()) telemetry_.adaptive[i++] = gain.value();
}

}  // namespace aqc
