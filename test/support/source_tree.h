#pragma once

#include <string>

namespace aqc::test {

/// The root of the source tree that the tests were built from.
std::string sourceTree();

/// A file of config/, by its folder and name: configFile("vehicle/pelican").
inline std::string configFile(const std::string& name) {
  return sourceTree() + "/config/" + name + ".yaml";
}

}  // namespace aqc::test
