#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>

namespace aqc::fuzz {

/// What is tried with inputs that nobody wrote. Each answers with what is wrong; empty: nothing is.
/// Only refusals that the core documents may be thrown, ParameterError and std::invalid_argument
/// with a text, and they are no finding. In every flight the rotor speeds are finite and within
/// their range. Sanitizers and a core with assertions see to the rest.

/// A vehicle's YAML: read, and flown for a quarter of a second with each law.
std::string flyVehicleText(const std::string& yaml);
/// A law's YAML: read, and flown for half a second in each of two vehicles.
std::string flyLawText(const std::string& yaml);
/// A scenario's YAML: read, and its first seconds flown.
std::string flyScenarioText(const std::string& yaml);
/// Bytes as a stream of messages, orders and times to a pilot. Once killed it stays so, disarmed
/// its rotors stand still, and a guard keeps the law and the set points finite.
std::string flyEvents(const std::string& bytes);

/// A byte for the kind of message, then the message as it stands on the wire, to a guarded pilot in
/// a hover, which must stay in range and finite. Only with ROS.
std::string hearWire(const std::string& bytes);

struct Target {
  const char* name;  ///< of its folder in fuzz/corpus, and of its program fuzz_test_NAME
  const char*
      config;  ///< the folder of config/ with more of its inputs; null: none, it is not text
  std::string (*check)(const std::string& input);
};

/// Those of the core.
constexpr std::array<Target, 4> kTargets = {{{"vehicle", "vehicle", flyVehicleText},
                                             {"law", "controller", flyLawText},
                                             {"scenario", "scenario", flyScenarioText},
                                             {"events", nullptr, flyEvents}}};

}  // namespace aqc::fuzz
