// What the gains of the law are, and where they are read.

#include <utility>
#include <vector>

#include "adaptive_quadrotor_control/law/composite/composite.h"
#include "adaptive_quadrotor_control/parameters/parameter_reader.h"
#include "law/gain_ranges.h"

namespace aqc {
namespace {

constexpr double kThrustShare = 0.98;       // of full thrust: the rest is for moments
constexpr double kLeastThrustLimit = 1e-3;  // [N]; the law itself never asks for so little
const Range kLead = Range::between(1.0, 100.0);
const Range kSpeed = Range::positiveUpTo(1e3);

const std::vector<std::string> kPositionEntries = {"sideways", "height"};
const std::vector<std::string> kTurnEntries = {"tilt", "yaw"};

Approach readApproach(const ParameterReader& reader, std::size_t which) {
  const auto read = [&](const char* key, const char* symbol, const char* unit, const char* words,
                        const Range& range) {
    return reader.numbers({key, symbol, unit, words, {"sideways", "height"}}, 2, range)[which];
  };
  return {
      read("slope", "Phi_p", "1/s", "how fast a small error decays on the sliding surface", kDecay),
      read("braking", "a", "m/s^2", "strongest braking of an approach, where the motors have it",
           kSpeed),
      read("speed", "v", "m/s", "fastest approach of a set point", kSpeed)};
}

// Two numbers, the first one for x and y.
Eigen::Vector3d readPair(const ParameterReader& reader, ParameterKey key,
                         std::vector<std::string> entries) {
  key.entries = std::move(entries);
  const std::vector<double> pair = reader.numbers(key, 2, kDecay);
  return {pair[0], pair[0], pair[1]};
}

AdaptiveGain readGain(const ParameterReader& reader, const char* symbol, const char* gain) {
  return AdaptiveGain(
      0.0, reader.number({"leak", symbol, "1/s", std::string("forgetting of ") + gain}, kDecay));
}

}  // namespace

Composite::Composite(const ParameterReader& reader, const Vehicle& vehicle)
    : rotor_lead_(reader.number(
          {"rotor_lead", "kappa", "", "how far rotors are told to go, in ways to their place"},
          kLead)),
      tilt_(reader.angle({"max_tilt_deg", "", "deg", "largest tilt commanded"},
                         Range::positiveUpTo(89.0)),
            kLeastThrustLimit),
      sideways_(readApproach(reader.child("position"), 0)),
      vertical_(readApproach(reader.child("position"), 1)),
      gain_(readPair(reader.child("position"),
                     {"gain", "lambda_p", "1/s", "damping towards the surface"}, kPositionEntries)),
      boundary_layer_(
          reader.child("position")
              .number({"boundary_layer", "varpi_p", "m/s", "smooths sgn(s); smaller is stiffer"},
                      kLayer)),
      bias_drive_(readPair(
          reader.child("position"),
          {"bias_drive", "gamma", "1/s^2", "how fast what is left beside the surface is learned"},
          kPositionEntries)),
      turn_slope_(
          readPair(reader.child("attitude"),
                   {"slope", "Phi_q", "1/s", "how fast the error decays on the sliding surface"},
                   kTurnEntries)),
      turn_gain_(readPair(reader.child("attitude"),
                          {"gain", "lambda_q", "1/s", "damping towards the surface"},
                          kTurnEntries)),
      turn_boundary_layer_(
          reader.child("attitude")
              .number({"boundary_layer", "varpi_q", "rad/s", "smooths sgn(s); smaller is stiffer"},
                      kLayer)),
      rotor_time_(0.5 * (vehicle.time_constant_up + vehicle.time_constant_down)),
      share_(kThrustShare * vehicle.maxThrust(), 1.0 / tilt_.least_ratio),
      mass_(reader.child("estimates"), vehicle),
      moment_(reader.child("estimates"), vehicle),
      inertia_(reader.child("estimates"), vehicle),
      gains_{readGain(reader.child("position"), "alpha_p", "K_p"),
             readGain(reader.child("position"), "alpha_p", "K_p")},
      turn_gains_{readGain(reader.child("attitude"), "alpha_q", "K_q"),
                  readGain(reader.child("attitude"), "alpha_q", "K_q"),
                  readGain(reader.child("attitude"), "alpha_q", "K_q")} {
  report();
}

}  // namespace aqc
