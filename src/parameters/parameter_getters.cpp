#include <algorithm>
#include <cmath>
#include <utility>

#include "adaptive_quadrotor_control/parameters/parameter_reader.h"

#include "adaptive_quadrotor_control/math/constants.h"

// The getters of ParameterReader.
namespace aqc {
namespace {

std::string join(const std::vector<std::string>& words) {
  std::string all;
  for (const std::string& word : words) all += (all.empty() ? "" : ", ") + word;
  return all;
}

ParameterKey inDegrees(ParameterKey key) {
  if (key.unit.empty()) key.unit = "deg";
  return key;
}

// The first `count` of the entries that a vector or a symmetric matrix has.
ParameterKey alongAxes(ParameterKey key, std::size_t count) {
  static const std::vector<std::string> kAxes = {"x", "y", "z", "xy", "xz", "yz"};
  if (key.entries.empty()) {
    key.entries.assign(kAxes.begin(), kAxes.begin() + static_cast<std::ptrdiff_t>(count));
  }
  return key;
}

}  // namespace

double ParameterReader::number(const ParameterKey& key, const Range& range) const {
  const double value = toNumber(require(key.name, range.text()), fullName(key.name), range);
  keepNumber(key, range, value);
  return value;
}

double ParameterReader::number(const ParameterKey& key, const Range& range, double fallback) const {
  if (has(key.name)) return number(key, range);
  keepNumber(key, range, fallback);
  return fallback;
}

int ParameterReader::integer(const ParameterKey& key, int min, int max) const {
  const Range range = Range::between(min, max);
  const double value = number(key, range);
  if (value != std::floor(value)) refuseValue(key.name, "a whole number");
  keep({key, Parameter::Kind::kInteger, range, {value}, {}, {}});
  return static_cast<int>(value);
}

bool ParameterReader::flag(const ParameterKey& key, bool fallback) const {
  bool value = fallback;
  if (has(key.name)) {
    const YAML::Node node = find(key.name);
    if (!node.IsScalar() || !YAML::convert<bool>::decode(node, value)) {
      refuseValue(key.name, "true or false");
    }
  }
  keep({key, Parameter::Kind::kFlag, Range::between(0.0, 1.0), {value ? 1.0 : 0.0}, {}, {}});
  return value;
}

std::string ParameterReader::text(const ParameterKey& key) const {
  const YAML::Node node = require(key.name, "a text");
  if (!node.IsScalar()) refuseValue(key.name, "a text");
  keep({key, Parameter::Kind::kText, {}, {}, {node.Scalar()}, {}});
  return node.Scalar();
}

std::string ParameterReader::text(const ParameterKey& key, const std::string& fallback) const {
  if (has(key.name)) return text(key);
  keep({key, Parameter::Kind::kText, {}, {}, {fallback}, {}});
  return fallback;
}

std::string ParameterReader::choice(const ParameterKey& key,
                                    const std::vector<std::string>& allowed) const {
  const std::string value = text(key);
  if (std::find(allowed.begin(), allowed.end(), value) == allowed.end()) {
    refuseValue(key.name, "one of " + join(allowed));
  }
  keep({key, Parameter::Kind::kText, {}, {}, {value}, allowed});
  return value;
}

std::vector<double> ParameterReader::numbers(const ParameterKey& key, std::size_t size,
                                             const Range& range) const {
  const std::string count = size == 0 ? "numbers" : std::to_string(size) + " numbers";
  const std::string what = "a list of " + count + ", each " + range.text();
  const YAML::Node node = require(key.name, what);
  if (!node.IsSequence() || (size != 0 && node.size() != size)) {
    refuseValue(key.name, what);
  }
  std::vector<double> values;
  for (std::size_t i = 0; i < node.size(); ++i) {
    const std::string full = fullName(key.name) + "[" + std::to_string(i) + "]";
    values.push_back(toNumber(node[i], full, range));
  }
  keepNumbers(key, range, values);
  return values;
}

double ParameterReader::angle(const ParameterKey& key, const Range& degrees) const {
  return number(inDegrees(key), degrees) * kDegree;
}

double ParameterReader::angle(const ParameterKey& key, const Range& degrees,
                              double fallback) const {
  if (has(key.name)) return angle(key, degrees);
  keepNumber(inDegrees(key), degrees, fallback / kDegree);
  return fallback;
}

std::vector<double> ParameterReader::angles(const ParameterKey& key, const Range& degrees) const {
  std::vector<double> angles = numbers(inDegrees(key), 0, degrees);
  for (double& angle : angles) angle *= kDegree;
  return angles;
}

std::vector<std::string> ParameterReader::texts(const ParameterKey& key) const {
  const YAML::Node node = require(key.name, "a list of texts");
  if (!node.IsSequence()) refuseValue(key.name, "a list of texts");
  std::vector<std::string> values;
  for (const auto& entry : node) {
    if (!entry.IsScalar()) refuseValue(key.name, "a list of texts");
    values.push_back(entry.Scalar());
  }
  keep({key, Parameter::Kind::kTexts, {}, {}, values, {}});
  return values;
}

Eigen::Vector3d ParameterReader::vector3(const ParameterKey& key, const Range& range) const {
  const std::vector<double> values = numbers(alongAxes(key, 3), 3, range);
  return {values[0], values[1], values[2]};
}

Eigen::Vector3d ParameterReader::vector3(const ParameterKey& key, const Range& range,
                                         const Eigen::Vector3d& fallback) const {
  if (has(key.name)) return vector3(key, range);
  keepNumbers(alongAxes(key, 3), range, {fallback.x(), fallback.y(), fallback.z()});
  return fallback;
}

Eigen::Matrix3d ParameterReader::positiveDefinite(const ParameterKey& key, double most) const {
  const Range entry = Range::between(-most, most);
  const std::vector<double> v = numbers(key, 0, entry);
  if (v.size() != 3 && v.size() != 6) {
    refuse(key.name, "has " + std::to_string(v.size()) +
                         " numbers; it must be [xx, yy, zz] or [xx, yy, zz, xy, xz, yz]");
  }
  Eigen::Matrix3d matrix = Eigen::Vector3d(v[0], v[1], v[2]).asDiagonal();
  if (v.size() == 6) {
    matrix(0, 1) = matrix(1, 0) = v[3];
    matrix(0, 2) = matrix(2, 0) = v[4];
    matrix(1, 2) = matrix(2, 1) = v[5];
  }
  requirePositiveDefinite(key.name, matrix);
  keepNumbers(alongAxes(key, v.size()), v.size() == 3 ? Range::positiveUpTo(most) : entry, v);
  return matrix;
}

void ParameterReader::keepNumber(const ParameterKey& key, const Range& range, double value) const {
  keep({key, Parameter::Kind::kNumber, range, {value}, {}, {}});
}

void ParameterReader::keepNumbers(ParameterKey key, const Range& range,
                                  std::vector<double> values) const {
  if (key.entries.size() != values.size()) {
    key.entries.clear();
    for (std::size_t i = 0; i < values.size(); ++i) key.entries.push_back(std::to_string(i));
  }
  keep({std::move(key), Parameter::Kind::kNumbers, range, std::move(values), {}, {}});
}

}  // namespace aqc
