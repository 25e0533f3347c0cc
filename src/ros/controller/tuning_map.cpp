#include "ros/controller/tuning_map.h"

#include <algorithm>
#include <functional>

namespace aqc {
namespace {

using dynamic_reconfigure::Config;

// A value of the tree under the names it may have. Nodes are references: assigning changes the
// tree.
using Visit = std::function<void(const std::vector<std::string>& names, YAML::Node leaf)>;

std::string joined(const std::string& prefix, const std::string& name) {
  return prefix.empty() ? name : prefix + "_" + name;
}

std::vector<std::string> entryNames(const std::string& list, std::size_t size, std::size_t i) {
  static const std::vector<std::string> kAxes = {"x", "y", "z"};
  static const std::vector<std::string> kCoordinates = {"z", "roll", "pitch", "yaw"};
  std::vector<std::string> names = {joined(list, std::to_string(i))};
  if (size == kAxes.size()) names.push_back(joined(list, kAxes[i]));
  if (size == kCoordinates.size()) names.push_back(joined(list, kCoordinates[i]));
  return names;
}

void walk(const YAML::Node& node, const std::string& name, const Visit& visit) {
  if (node.IsMap()) {
    for (const auto& entry : node) {
      walk(entry.second, joined(name, entry.first.as<std::string>()), visit);
    }
  } else if (node.IsSequence()) {
    for (std::size_t i = 0; i < node.size(); ++i) {
      if (node[i].IsScalar()) {
        visit(entryNames(name, node.size(), i), node[i]);
      } else {
        walk(node[i], joined(name, std::to_string(i + 1)), visit);
      }
    }
  } else if (node.IsScalar()) {
    visit({name}, node);
  }
}

// The value of one of `names` in a list of dynamic_reconfigure's; null without.
template <class Values>
auto find(Values& values, const std::vector<std::string>& names) -> decltype(&values.front()) {
  for (auto& value : values) {
    if (std::find(names.begin(), names.end(), value.name) != names.end()) return &value;
  }
  return nullptr;
}

bool knows(const Config& values, const std::vector<std::string>& names) {
  return find(values.doubles, names) != nullptr || find(values.ints, names) != nullptr ||
         find(values.strs, names) != nullptr;
}

bool isNumber(const YAML::Node& leaf) {
  double number = 0.0;
  return YAML::convert<double>::decode(leaf, number);
}

}  // namespace

void readTree(const YAML::Node& tree, Config& values) {
  walk(tree, "", [&values](const std::vector<std::string>& names, const YAML::Node& leaf) {
    if (auto* number = find(values.doubles, names)) number->value = leaf.as<double>();
    if (auto* whole = find(values.ints, names)) {
      whole->value = static_cast<int>(leaf.as<double>());
    }
    if (auto* text = find(values.strs, names)) text->value = leaf.as<std::string>();
  });
}

YAML::Node withValues(const YAML::Node& tree, const Config& values) {
  YAML::Node result = YAML::Clone(tree);
  walk(result, "", [&values](const std::vector<std::string>& names, YAML::Node leaf) {
    if (const auto* number = find(values.doubles, names)) {
      // A number that is the same keeps its spelling.
      if (!isNumber(leaf) || leaf.as<double>() != number->value) leaf = number->value;
    }
    if (const auto* whole = find(values.ints, names)) leaf = whole->value;
    if (const auto* text = find(values.strs, names)) leaf = text->value;
  });
  return result;
}

std::vector<std::string> missingNames(const YAML::Node& tree, const Config& values) {
  std::vector<std::string> missing;
  walk(tree, "", [&](const std::vector<std::string>& names, const YAML::Node& leaf) {
    if (isNumber(leaf) && !knows(values, names)) missing.push_back(names.back());
  });
  return missing;
}

}  // namespace aqc
