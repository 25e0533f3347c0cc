#pragma once

#include <cstdint>
#include <string>

namespace aqc::fuzz {

/// The text of a YAML map with 1 to 3 of its values changed: to numbers and words that a reader may
/// not have been thought through for, to another of its values, or left out or given twice; or a
/// list or a map to such a word. Bytes changed at random are hardly ever YAML. Empty when the text
/// is no such map, or a very large one. The same seed makes the same change.
std::string mutatedYaml(const std::string& yaml, std::uint64_t seed);

/// 1 to 4 bytes changed, left out or put in.
std::string mutatedBytes(std::string bytes, std::uint64_t seed);

}  // namespace aqc::fuzz
