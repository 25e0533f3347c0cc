#include "adaptive_quadrotor_control/law/switched/switched_parameters.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <vector>

#include "adaptive_quadrotor_control/math/number_text.h"
#include "adaptive_quadrotor_control/parameters/parameter_reader.h"
#include "law/gain_ranges.h"

namespace aqc {
namespace {

// Upper bounds of what gain_ranges.h has none for: at least twenty times what the thesis prints.
constexpr double kMostErrorGain = 1e5;  // [1/s^2]
constexpr double kMostWeight = 1e6;
const Range kLearned = Range::positiveUpTo(1e6);

// Symmetric positive definite: the diagonal, or all numbers row by row; no entry beyond `most`.
template <int Size>
Eigen::Matrix<double, Size, Size> readMatrix(const ParameterReader& reader, const ParameterKey& key,
                                             double most) {
  constexpr std::size_t kDiagonal = Size;
  constexpr std::size_t kFull = kDiagonal * kDiagonal;
  using Matrix = Eigen::Matrix<double, Size, Size>;
  const std::vector<double> v = reader.numbers(key, 0, Range::between(-most, most));
  if (v.size() != kDiagonal && v.size() != kFull) {
    reader.refuse(key.name, "has " + std::to_string(v.size()) + " numbers; it must have " +
                                std::to_string(kDiagonal) + " (the diagonal) or " +
                                std::to_string(kFull) + " (row by row)");
  }
  Matrix matrix = Matrix::Zero();
  if (v.size() == kDiagonal) {
    matrix.diagonal() = Eigen::Map<const Eigen::Matrix<double, Size, 1>>(v.data());
  } else {
    matrix = Eigen::Map<const Matrix>(v.data());
  }
  if (matrix != matrix.transpose()) reader.refuseValue(key.name, "symmetric");
  reader.requirePositiveDefinite(key.name, matrix);
  if (v.size() == kDiagonal)
    reader.numbers(key, kDiagonal, Range::positiveUpTo(most));  // for the schema
  return matrix;
}

Eigen::Vector4d readVector(const ParameterReader& reader, const ParameterKey& key,
                           const Range& range) {
  return Eigen::Vector4d(reader.numbers(key, 4, range).data());
}

// Eq. init: a gain that decays towards its drive must start above it.
double readInitial(const ParameterReader& reader, const ParameterKey& key, double drive,
                   const std::string& drive_key) {
  const double initial = reader.number(key, kLearned);
  if (!(initial > drive)) {
    reader.refuseValue(key.name,
                       "> '" + drive_key + "' = " + numberText(drive) + " (thesis eq. init)");
  }
  return initial;
}

// Eq. alpha. P and varrho are known only now.
void checkLeak(const ParameterReader& reader, const SubsystemParameters& parameters,
               double varrho) {
  if (!(parameters.leak.minCoeff() > 0.5 * varrho)) {
    reader.refuseValue("leak",
                       "> varrho / 2 = " + numberText(0.5 * varrho) +
                           " in every entry; varrho = lambda_min(Q) / lambda_max(P) (eq. alpha)");
  }
}

SubsystemParameters readSubsystem(const ParameterReader& reader) {
  SubsystemParameters p;
  const std::vector<std::string> coordinates = {"z", "roll", "pitch", "yaw"};
  p.error_gain =
      readMatrix<4>(reader, {"error_gain", "K_1", "1/s^2", "stiffness of the error", coordinates},
                    kMostErrorGain);
  p.rate_gain = readMatrix<4>(
      reader, {"rate_gain", "K_2", "1/s", "damping of the error", coordinates}, kDecay.max);
  p.input_gain = readMatrix<4>(reader,
                               {"input_gain", "D", "kg, kg m, kg m, kg m^2",
                                "from the acceleration asked for to the command", coordinates},
                               kMatter.max);
  p.weight =
      readMatrix<8>(reader, {"weight", "Q", "", "of the errors and of their rates"}, kMostWeight);
  p.leak =
      readVector(reader, {"leak", "alpha", "1/s", "forgetting of theta-hat; > varrho / 2"}, kDecay);
  p.gamma_drive = reader.number({"gamma_drive", "epsilon", "", "what gamma decays to"}, kLearned);
  p.zeta_drive = reader.number({"zeta_drive", "bar-epsilon", "", "what zeta decays to"}, kLearned);
  p.initial_theta =
      readVector(reader, {"initial_theta", "theta-hat", "", "at the start"}, kLearned);
  if (reader.has("most_theta")) {
    p.most_theta = readVector(reader, {"most_theta", "theta-hat", "", "at the most"}, kLearned);
    if (!(p.most_theta.array() >= p.initial_theta.array()).all()) {
      reader.refuseValue("most_theta", ">= 'initial_theta' in every entry");
    }
  }
  p.initial_zeta = readInitial(reader, {"initial_zeta", "zeta", "", "at the start; > zeta_drive"},
                               p.zeta_drive, "zeta_drive");
  p.initial_gamma =
      readInitial(reader, {"initial_gamma", "gamma", "", "at the start; > gamma_drive"},
                  p.gamma_drive, "gamma_drive");
  try {
    checkLeak(reader, p, solveSubsystem(p).spectrum.decay());
  } catch (const std::domain_error& error) {
    reader.refuse("weight",
                  std::string("and the gains give no Lyapunov function: ") + error.what());
  }
  return p;
}

// The average dwell time to enforce: the shortest allowed unless the file asks for a longer one.
Nanoseconds readDwellTime(const ParameterReader& reader, const DwellTime& bound) {
  const double longest = toSeconds(DwellTimeMonitor::kLongest);
  if (!(bound.least < longest)) {
    reader.refuse("subsystems",
                  "ask for " + bound.text() + "; it must be < " + numberText(longest) + " s");
  }
  const auto shortest = static_cast<Nanoseconds>(std::floor(bound.least * 1e9)) + 1;
  if (!reader.has("dwell_time")) return shortest;
  const double seconds =
      reader.number({"dwell_time", "", "s", "average time between two switches, > theta*"},
                    Range::positiveUpTo(longest));
  if (!(seconds > bound.least)) {
    reader.refuseValue("dwell_time", "> theta* (" + bound.text() + ", thesis eq. sw_law)");
  }
  return std::max(shortest, fromSeconds(seconds));
}

}  // namespace

SwitchedLaw readSwitchedLaw(const ParameterReader& reader, int most) {
  const std::vector<ParameterReader> children = reader.children("subsystems");
  if (children.empty() || children.size() > static_cast<std::size_t>(most)) {
    reader.refuse("subsystems", "lists " + std::to_string(children.size()) +
                                    " subsystems; it must list 1 to " + std::to_string(most));
  }
  std::vector<SubsystemParameters> subsystems;
  for (const ParameterReader& child : children) subsystems.push_back(readSubsystem(child));
  return SwitchedLaw(subsystems,
                     reader.number({"boundary_layer", "varpi", "",
                                    "of the filtered error r, which mixes m/s and rad/s"},
                                   kLayer, 0.1));
}

SubsystemSwitch readSubsystemSwitch(const ParameterReader& reader, const SwitchedLaw& law) {
  const double kappa_ratio = reader.number({"kappa_ratio", "kappa / varrho", "", "in (0, 1)"},
                                           Range::positiveUpTo(1.0), 0.9);
  if (!(kappa_ratio < 1.0)) {
    reader.refuseValue("kappa_ratio", "> 0 and < 1 (thesis: kappa < varrho)");
  }
  const DwellTime bound = averageDwellTime(law.spectra(), kappa_ratio);
  const Nanoseconds dwell_time = readDwellTime(reader, bound);
  const double chatter_bound =
      reader.number({"chatter_bound", "N_0", "", "how many switches may come at once"},
                    Range::between(1.0, DwellTimeMonitor::kMostChatter));
  const bool warn =
      reader.choice({"switching_policy", "", "", "what becomes of a switch that comes too early"},
                    {"refuse", "warn"}) == "warn";
  const int initial =
      reader.has("initial_subsystem")
          ? reader.integer({"initial_subsystem", "", "", "at the start; subsystems count from 1"},
                           1, law.count())
          : 1;
  return SubsystemSwitch(law.count(), initial, bound, DwellTimeMonitor(dwell_time, chatter_bound),
                         warn ? SubsystemSwitch::Policy::kWarn : SubsystemSwitch::Policy::kRefuse);
}

}  // namespace aqc
