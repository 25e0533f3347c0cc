#pragma once

#include <yaml-cpp/yaml.h>

#include <functional>
#include <string>

namespace aqc::test {

/// Calls `visit` with the full name of every scalar below `node`, as errors print it, and with the
/// scalar itself, which may be changed; `name` is that of `node`.
inline void forEachLeaf(const YAML::Node& node, const std::string& name,
                        const std::function<void(const std::string&, YAML::Node)>& visit) {
  if (node.IsScalar()) return visit(name, node);
  std::size_t index = 0;
  for (const auto& entry : node) {
    if (node.IsMap()) {
      forEachLeaf(entry.second, name + "/" + entry.first.as<std::string>(), visit);
    } else {
      forEachLeaf(entry, name + "[" + std::to_string(index++) + "]", visit);
    }
  }
}

/// The same for the numbers alone.
inline void forEachNumber(const YAML::Node& node, const std::string& name,
                          const std::function<void(const std::string&, YAML::Node)>& visit) {
  forEachLeaf(node, name, [&](const std::string& full, YAML::Node leaf) {
    double number = 0.0;
    if (YAML::convert<double>::decode(leaf, number)) visit(full, leaf);
  });
}

}  // namespace aqc::test
