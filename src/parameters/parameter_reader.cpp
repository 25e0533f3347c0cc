#include "adaptive_quadrotor_control/parameters/parameter_reader.h"

#include <fstream>
#include <utility>

#include "adaptive_quadrotor_control/math/eigenvalues.h"

namespace aqc {
namespace {

std::string print(const YAML::Node& node) {
  if (node.IsScalar()) return "'" + node.Scalar() + "'";
  if (node.IsNull()) return "nothing";
  YAML::Emitter out;
  out << YAML::Flow << node;
  const std::string text = out.c_str();
  constexpr std::size_t kLongest = 120;  // a number for each of 16 rotors fits
  return text.size() <= kLongest ? text : text.substr(0, kLongest) + " ...";
}

// YAML allows lists and maps for keys, too.
std::string keyText(const YAML::Node& key, const std::string& map) {
  if (!key.IsScalar()) {
    throw ParameterError("parameter '" + map + "' has the key " + print(key) +
                         "; every key must be a text");
  }
  return key.Scalar();
}

// Names nobody asked for are nearly always typing mistakes, which would silently fly defaults.
void refuseUnknown(const YAML::Node& node, const std::string& name,
                   const std::set<std::string>& known) {
  if (node.IsSequence()) {
    for (std::size_t i = 0; i < node.size(); ++i) {
      refuseUnknown(node[i], name + "[" + std::to_string(i) + "]", known);
    }
  }
  if (!node.IsMap()) return;
  std::set<std::string> seen;
  for (const auto& entry : node) {
    const std::string key = keyText(entry.first, name);
    const std::string full = name.empty() ? key : name + "/" + key;
    if (known.count(full) == 0) throw ParameterError("parameter '" + full + "' is unknown");
    if (!seen.insert(key).second) throw ParameterError("parameter '" + full + "' is given twice");
    refuseUnknown(entry.second, full, known);
  }
}

constexpr int kDeepest = 32;
constexpr std::size_t kMostNodes = 200'000;

// By anchors and aliases a few lines can be a tree without an end, or one of more nodes than there
// is time to walk.
void requireBounded(const YAML::Node& node, int depth, std::size_t& nodes) {
  if (depth > kDeepest) {
    throw ParameterError("is nested deeper than " + std::to_string(kDeepest) +
                         " levels; an alias may lie within its own anchor");
  }
  if (++nodes > kMostNodes) {
    throw ParameterError("has more than " + std::to_string(kMostNodes) +
                         " values; aliases may multiply them");
  }
  if (node.IsMap()) {
    for (const auto& entry : node) {
      requireBounded(entry.first, depth + 1, nodes);
      requireBounded(entry.second, depth + 1, nodes);
    }
  } else if (node.IsSequence()) {
    for (const YAML::Node& entry : node) requireBounded(entry, depth + 1, nodes);
  }
}

const YAML::Node& bounded(const YAML::Node& tree, const std::string& name) {
  std::size_t nodes = 0;
  try {
    requireBounded(tree, 0, nodes);
  } catch (const ParameterError& error) {
    throw ParameterError("parameter '" + name + "' " + error.what());
  }
  return tree;
}

}  // namespace

ParameterReader::ParameterReader(const YAML::Node& tree, std::string name)
    : ParameterReader(bounded(tree, name), name, std::make_shared<Heard>()) {
  heard_->root = std::move(name);
}

ParameterReader::ParameterReader(const YAML::Node& tree, std::string name,
                                 std::shared_ptr<Heard> heard)
    : tree_(tree), name_(std::move(name)), heard_(std::move(heard)) {
  if (!tree_.IsMap()) {
    throw ParameterError("parameter '" + name_ + "' is " + print(tree_) +
                         "; it must be a map of names and values");
  }
}

std::string ParameterReader::fullName(const std::string& key) const {
  if (key.empty()) return name_;
  return name_.empty() ? key : name_ + "/" + key;
}

std::string ParameterReader::valueText(const std::string& key) const {
  const YAML::Node node = find(key);
  return node.IsDefined() ? print(node) : "nothing";
}

void ParameterReader::refuse(const std::string& key, const std::string& problem) const {
  throw ParameterError("parameter '" + fullName(key) + "' " + problem);
}

void ParameterReader::refuseValue(const std::string& key, const std::string& allowed) const {
  refuse(key, "is " + valueText(key) + "; it must be " + allowed);
}

YAML::Node ParameterReader::find(const std::string& key) const {
  heard_->names.insert(fullName(key));
  const YAML::Node& tree = tree_;  // the const operator[] does not insert
  return tree[key];
}

YAML::Node ParameterReader::require(const std::string& key, const std::string& what) const {
  YAML::Node node = find(key);
  if (!node.IsDefined() || node.IsNull()) refuse(key, "is missing; it must be " + what);
  return node;
}

bool ParameterReader::has(const std::string& key) const {
  return find(key).IsDefined();
}

double ParameterReader::toNumber(const YAML::Node& node, const std::string& full,
                                 const Range& range) const {
  double value = 0.0;
  if (!node.IsScalar() || !YAML::convert<double>::decode(node, value) || !range.contains(value)) {
    throw ParameterError("parameter '" + full + "' is " + print(node) + "; it must be " +
                         range.text());
  }
  return value;
}

void ParameterReader::requirePositiveDefinite(const std::string& key,
                                              const Eigen::MatrixXd& symmetric) const {
  const double smallest = eigenvalueRange(symmetric).min;
  if (!(smallest > 0.0)) {
    refuse(key, "is " + valueText(key) + ", whose smallest eigenvalue is " + numberText(smallest) +
                    "; it must be positive definite (every eigenvalue > 0)");
  }
}

ParameterReader ParameterReader::child(const std::string& key) const {
  return ParameterReader(require(key, "a map of names and values"), fullName(key), heard_);
}

std::vector<ParameterReader> ParameterReader::children(const std::string& key) const {
  const YAML::Node node = require(key, "a list of maps");
  if (!node.IsSequence()) refuseValue(key, "a list of maps");
  std::vector<ParameterReader> readers;
  for (std::size_t i = 0; i < node.size(); ++i) {
    const std::string name = fullName(key) + "[" + std::to_string(i) + "]";
    readers.push_back(ParameterReader(node[i], name, heard_));
  }
  return readers;
}

std::vector<std::string> ParameterReader::keys() const {
  std::vector<std::string> keys;
  for (const auto& entry : tree_) keys.push_back(keyText(entry.first, name_));
  return keys;
}

void ParameterReader::skip(const std::string& key) const {
  const auto skip_all = [](const ParameterReader& map) {
    for (const std::string& name : map.keys()) map.skip(name);
  };
  if (!has(key)) return;
  const YAML::Node node = find(key);
  if (node.IsMap()) skip_all(child(key));
  if (!node.IsSequence() || node.size() == 0 || !node[0].IsMap()) return;
  for (const ParameterReader& entry : children(key)) skip_all(entry);
}

void ParameterReader::finish() const {
  refuseUnknown(tree_, name_, heard_->names);
}

const Schema& ParameterReader::schema() const {
  return heard_->schema;
}

void ParameterReader::keep(Parameter parameter) const {
  const std::string full = fullName(parameter.key.name);
  const std::size_t root = heard_->root.size();
  parameter.key.name = root == 0 ? full : full.substr(root + 1);
  const auto place = heard_->places.emplace(parameter.key.name, heard_->schema.size());
  if (place.second) {
    heard_->schema.push_back(std::move(parameter));
  } else {
    heard_->schema[place.first->second] = std::move(parameter);
  }
}

YAML::Node loadYamlFile(const std::string& path) {
  std::ifstream file(path);
  file.peek();  // a folder opens, but cannot be read
  if (!file.is_open() || file.bad()) throw ParameterError("'" + path + "' cannot be read");
  if (file.eof()) throw ParameterError("'" + path + "' is empty");
  try {
    YAML::Node tree = YAML::Load(file);
    if (!tree.IsMap()) throw ParameterError("'" + path + "' must hold a map of names and values");
    return tree;
  } catch (const YAML::Exception& error) {
    throw ParameterError("'" + path + "' is not YAML: line " + std::to_string(error.mark.line + 1) +
                         ": " + error.msg);
  }
}

}  // namespace aqc
