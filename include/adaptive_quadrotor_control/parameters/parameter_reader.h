#pragma once

#include <yaml-cpp/yaml.h>

#include <Eigen/Core>
#include <limits>
#include <memory>
#include <set>
#include <stdexcept>
#include <string>
#include <vector>

#include "adaptive_quadrotor_control/math/number_text.h"

namespace aqc {

/// A parameter that is missing, unknown, mistyped or out of range. what() names it in full, with
/// its value and what is allowed.
struct ParameterError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// The numbers that a parameter may take. Not-a-number and infinities are never allowed.
struct Range {
  double min = -std::numeric_limits<double>::infinity();
  double max = std::numeric_limits<double>::infinity();
  bool exclusive_min = false;

  /// Every finite number.
  static Range any() { return {}; }
  /// > 0
  static Range positive() { return {0.0, std::numeric_limits<double>::infinity(), true}; }
  /// >= 0
  static Range nonNegative() { return {0.0, std::numeric_limits<double>::infinity(), false}; }
  /// [low, high]
  static Range between(double low, double high) { return {low, high, false}; }
  /// (0, high]
  static Range positiveUpTo(double high) { return {0.0, high, true}; }

  /// False for not-a-number and infinities, whatever the bounds.
  bool contains(double value) const;
  /// "a finite number > 0", as an error message says it.
  std::string text() const;
};

/// The one validated way from a parameter tree (a YAML file, or a ROS parameter namespace turned
/// into the same tree) to typed values. Every getter throws ParameterError when the parameter is
/// missing, of another type or out of range; finish() refuses names that nobody read. Those with a
/// fallback return it, unchecked, when the parameter is missing.
class ParameterReader {
 public:
  /// `name` is the prefix that errors print, e.g. "vehicle" or a file name. An empty name prints
  /// the bare keys. Throws ParameterError unless `tree` is a map.
  ParameterReader(YAML::Node tree, std::string name);

  /// Whether the key is there, with whatever value.
  bool has(const std::string& key) const;
  double number(const std::string& key, const Range& range) const;
  double number(const std::string& key, const Range& range, double fallback) const;
  /// A whole number in [min, max].
  int integer(const std::string& key, int min, int max) const;
  /// true or false, or what else YAML takes for these.
  bool flag(const std::string& key, bool fallback) const;
  std::string text(const std::string& key) const;
  std::string text(const std::string& key, const std::string& fallback) const;
  /// A text that is one of `allowed`.
  std::string choice(const std::string& key, const std::vector<std::string>& allowed) const;
  /// `size` numbers, all in `range`; a size of 0 takes any count.
  std::vector<double> numbers(const std::string& key, std::size_t size, const Range& range) const;
  /// An angle in radians. The tree holds it in degrees, within `degrees`, under a key that ends in
  /// _deg.
  double angle(const std::string& key, const Range& degrees) const;
  /// `fallback` is in radians.
  double angle(const std::string& key, const Range& degrees, double fallback) const;
  /// A list of such angles, of any count.
  std::vector<double> angles(const std::string& key, const Range& degrees) const;
  /// A list of texts, of any count.
  std::vector<std::string> texts(const std::string& key) const;
  /// Three numbers, each in `range`.
  Eigen::Vector3d vector3(const std::string& key, const Range& range) const;
  Eigen::Vector3d vector3(const std::string& key, const Range& range,
                          const Eigen::Vector3d& fallback) const;
  /// Symmetric positive definite: [xx, yy, zz] or [xx, yy, zz, xy, xz, yz].
  Eigen::Matrix3d positiveDefinite(const std::string& key) const;

  /// A nested map.
  ParameterReader child(const std::string& key) const;
  /// A list of maps.
  std::vector<ParameterReader> children(const std::string& key) const;
  /// The keys of this map in the file's order.
  std::vector<std::string> keys() const;

  /// The full name of a key, as errors print it; of an empty one that of this map itself.
  std::string fullName(const std::string& key) const;
  /// The value of a key, as errors print it: as the file has it, shortened when it is long.
  std::string valueText(const std::string& key) const;
  /// Throws "parameter '<full name>' <problem>". For what a getter cannot judge by itself.
  [[noreturn]] void refuse(const std::string& key, const std::string& problem) const;
  /// Throws "parameter '<full name>' is <value>; it must be <allowed>".
  [[noreturn]] void refuseValue(const std::string& key, const std::string& allowed) const;
  /// Refuses `key` unless the symmetric matrix that was made of it is positive definite.
  void requirePositiveDefinite(const std::string& key, const Eigen::MatrixXd& symmetric) const;

  /// Takes the key, if it is there, and all names below it as read, whatever they hold: for who
  /// needs a part of a tree whose other parts somebody else reads.
  void skip(const std::string& key) const;

  /// Throws when the tree holds a name that no getter asked for, or one name twice. Call it on the
  /// outermost reader, after everything is read.
  void finish() const;

 private:
  using Names = std::set<std::string>;
  ParameterReader(YAML::Node tree, std::string name, std::shared_ptr<Names> known);
  YAML::Node find(const std::string& key) const;
  YAML::Node require(const std::string& key, const std::string& what) const;
  double toNumber(const YAML::Node& node, const std::string& full, const Range& range) const;

  YAML::Node tree_;
  std::string name_;
  std::shared_ptr<Names> known_;  // shared with the children, so that finish() sees everything
};

/// Reads a YAML file whose top level is a map; throws ParameterError naming the file (and the line)
/// when it cannot be read, is empty or is not YAML.
YAML::Node loadYamlFile(const std::string& path);

}  // namespace aqc
