#include "adaptive_quadrotor_control/parameters/parameter_reader.h"

#include <cmath>
#include <fstream>
#include <utility>

#include "adaptive_quadrotor_control/math/eigenvalues.h"

namespace aqc {
namespace {

constexpr double kDegree = M_PI / 180.0;  // [rad]

std::string print(const YAML::Node& node) {
  if (node.IsScalar()) return "'" + node.Scalar() + "'";
  if (node.IsNull()) return "nothing";
  YAML::Emitter out;
  out << YAML::Flow << node;
  const std::string text = out.c_str();
  constexpr std::size_t kLongest = 120;  // a number for each of 16 rotors fits
  return text.size() <= kLongest ? text : text.substr(0, kLongest) + " ...";
}

std::string join(const std::vector<std::string>& words) {
  std::string all;
  for (const std::string& word : words) all += (all.empty() ? "" : ", ") + word;
  return all;
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

}  // namespace

bool Range::contains(double value) const {
  return std::isfinite(value) && value <= max && (exclusive_min ? value > min : value >= min);
}

std::string Range::text() const {
  std::string text = "a finite number";
  if (std::isfinite(min)) text += (exclusive_min ? " > " : " >= ") + numberText(min);
  if (std::isfinite(max)) text += (std::isfinite(min) ? " and <= " : " <= ") + numberText(max);
  return text;
}

ParameterReader::ParameterReader(YAML::Node tree, std::string name)
    : ParameterReader(std::move(tree), std::move(name), std::make_shared<Names>()) {}

ParameterReader::ParameterReader(YAML::Node tree, std::string name, std::shared_ptr<Names> known)
    : tree_(std::move(tree)), name_(std::move(name)), known_(std::move(known)) {
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
  known_->insert(fullName(key));
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

double ParameterReader::number(const std::string& key, const Range& range) const {
  return toNumber(require(key, range.text()), fullName(key), range);
}

double ParameterReader::number(const std::string& key, const Range& range, double fallback) const {
  return has(key) ? number(key, range) : fallback;
}

int ParameterReader::integer(const std::string& key, int min, int max) const {
  const double value = number(key, Range::between(min, max));
  if (value != std::floor(value)) refuseValue(key, "a whole number");
  return static_cast<int>(value);
}

bool ParameterReader::flag(const std::string& key, bool fallback) const {
  if (!has(key)) return fallback;
  const YAML::Node node = find(key);
  bool value = false;
  if (!node.IsScalar() || !YAML::convert<bool>::decode(node, value)) {
    refuseValue(key, "true or false");
  }
  return value;
}

std::string ParameterReader::text(const std::string& key) const {
  const YAML::Node node = require(key, "a text");
  if (!node.IsScalar()) refuseValue(key, "a text");
  return node.Scalar();
}

std::string ParameterReader::text(const std::string& key, const std::string& fallback) const {
  return has(key) ? text(key) : fallback;
}

std::string ParameterReader::choice(const std::string& key,
                                    const std::vector<std::string>& allowed) const {
  const std::string value = text(key);
  for (const std::string& word : allowed) {
    if (value == word) return value;
  }
  refuseValue(key, "one of " + join(allowed));
}

std::vector<double> ParameterReader::numbers(const std::string& key, std::size_t size,
                                             const Range& range) const {
  const std::string count = size == 0 ? "numbers" : std::to_string(size) + " numbers";
  const std::string what = "a list of " + count + ", each " + range.text();
  const YAML::Node node = require(key, what);
  if (!node.IsSequence() || (size != 0 && node.size() != size)) {
    refuseValue(key, what);
  }
  std::vector<double> values;
  for (std::size_t i = 0; i < node.size(); ++i) {
    values.push_back(toNumber(node[i], fullName(key) + "[" + std::to_string(i) + "]", range));
  }
  return values;
}

double ParameterReader::angle(const std::string& key, const Range& degrees) const {
  return number(key, degrees) * kDegree;
}

double ParameterReader::angle(const std::string& key, const Range& degrees, double fallback) const {
  return has(key) ? angle(key, degrees) : fallback;
}

std::vector<double> ParameterReader::angles(const std::string& key, const Range& degrees) const {
  std::vector<double> angles = numbers(key, 0, degrees);
  for (double& angle : angles) angle *= kDegree;
  return angles;
}

std::vector<std::string> ParameterReader::texts(const std::string& key) const {
  const YAML::Node node = require(key, "a list of texts");
  if (!node.IsSequence()) refuseValue(key, "a list of texts");
  std::vector<std::string> values;
  for (const auto& entry : node) {
    if (!entry.IsScalar()) refuseValue(key, "a list of texts");
    values.push_back(entry.Scalar());
  }
  return values;
}

Eigen::Vector3d ParameterReader::vector3(const std::string& key, const Range& range) const {
  const std::vector<double> values = numbers(key, 3, range);
  return {values[0], values[1], values[2]};
}

Eigen::Vector3d ParameterReader::vector3(const std::string& key, const Range& range,
                                         const Eigen::Vector3d& fallback) const {
  return has(key) ? vector3(key, range) : fallback;
}

void ParameterReader::requirePositiveDefinite(const std::string& key,
                                              const Eigen::MatrixXd& symmetric) const {
  const double smallest = eigenvalueRange(symmetric).min;
  if (!(smallest > 0.0)) {
    refuse(key, "is " + valueText(key) + ", whose smallest eigenvalue is " + numberText(smallest) +
                    "; it must be positive definite (every eigenvalue > 0)");
  }
}

Eigen::Matrix3d ParameterReader::positiveDefinite(const std::string& key) const {
  const std::vector<double> v = numbers(key, 0, Range::any());
  if (v.size() != 3 && v.size() != 6) {
    refuse(key, "has " + std::to_string(v.size()) +
                    " numbers; it must be [xx, yy, zz] or [xx, yy, zz, xy, xz, yz]");
  }
  Eigen::Matrix3d matrix = Eigen::Vector3d(v[0], v[1], v[2]).asDiagonal();
  if (v.size() == 6) {
    matrix(0, 1) = matrix(1, 0) = v[3];
    matrix(0, 2) = matrix(2, 0) = v[4];
    matrix(1, 2) = matrix(2, 1) = v[5];
  }
  requirePositiveDefinite(key, matrix);
  return matrix;
}

ParameterReader ParameterReader::child(const std::string& key) const {
  return ParameterReader(require(key, "a map of names and values"), fullName(key), known_);
}

std::vector<ParameterReader> ParameterReader::children(const std::string& key) const {
  const YAML::Node node = require(key, "a list of maps");
  if (!node.IsSequence()) refuseValue(key, "a list of maps");
  std::vector<ParameterReader> readers;
  for (std::size_t i = 0; i < node.size(); ++i) {
    const std::string name = fullName(key) + "[" + std::to_string(i) + "]";
    readers.push_back(ParameterReader(node[i], name, known_));
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
  refuseUnknown(tree_, name_, *known_);
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
