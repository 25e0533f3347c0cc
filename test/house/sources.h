#pragma once

#include <string>
#include <vector>

namespace aqc::test {

/// A C++ file of include/ or src/.
struct Source {
  std::string name;  ///< from the root of the source tree: "src/law/asmc.cpp"
  std::string code;  ///< without comments
};

/// A whole file; empty when it cannot be read. `name` counts from the root of the source tree.
std::string textOf(const std::string& name);

/// Every C++ file under include/ and src/ but those in folders of the given names.
std::vector<Source> sources(const std::vector<std::string>& left_out = {});

}  // namespace aqc::test
