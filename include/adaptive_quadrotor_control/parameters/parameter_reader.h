#pragma once

#include <yaml-cpp/yaml.h>

#include <Eigen/Core>
#include <limits>
#include <map>
#include <memory>
#include <set>
#include <stdexcept>
#include <string>
#include <vector>

#include "adaptive_quadrotor_control/math/number_text.h"
#include "adaptive_quadrotor_control/parameters/schema.h"

namespace aqc {

/// A parameter that is missing, unknown, mistyped or out of range. what() names it in full, with
/// its value and what is allowed.
struct ParameterError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// The one validated way from a parameter tree (a YAML file, or a ROS parameter namespace turned
/// into the same tree) to typed values. Every getter throws ParameterError when the parameter is
/// missing, of another type or out of range; finish() refuses names that nobody read. Those with a
/// fallback return it, unchecked, when the parameter is missing. What was read is kept as a schema:
/// a parameter is declared by the getter that reads it, and nowhere else.
class ParameterReader {
 public:
  /// `name` is the prefix that errors print, e.g. "vehicle" or a file name. An empty name prints
  /// the bare keys. Throws ParameterError unless `tree` is a map.
  ParameterReader(const YAML::Node& tree, std::string name);

  /// Whether the key is there, with whatever value.
  bool has(const std::string& key) const;
  double number(const ParameterKey& key, const Range& range) const;
  double number(const ParameterKey& key, const Range& range, double fallback) const;
  /// A whole number in [min, max].
  int integer(const ParameterKey& key, int min, int max) const;
  /// true or false, or what else YAML takes for these.
  bool flag(const ParameterKey& key, bool fallback) const;
  std::string text(const ParameterKey& key) const;
  std::string text(const ParameterKey& key, const std::string& fallback) const;
  /// A text that is one of `allowed`.
  std::string choice(const ParameterKey& key, const std::vector<std::string>& allowed) const;
  /// `size` numbers, all in `range`; a size of 0 takes any count.
  std::vector<double> numbers(const ParameterKey& key, std::size_t size, const Range& range) const;
  /// An angle in radians. The tree, and with it the schema, holds it in degrees, within `degrees`,
  /// under a key that ends in _deg.
  double angle(const ParameterKey& key, const Range& degrees) const;
  /// `fallback` is in radians.
  double angle(const ParameterKey& key, const Range& degrees, double fallback) const;
  /// A list of such angles, of any count.
  std::vector<double> angles(const ParameterKey& key, const Range& degrees) const;
  /// A list of texts, of any count.
  std::vector<std::string> texts(const ParameterKey& key) const;
  /// Three numbers, each in `range`; x, y and z in the schema.
  Eigen::Vector3d vector3(const ParameterKey& key, const Range& range) const;
  Eigen::Vector3d vector3(const ParameterKey& key, const Range& range,
                          const Eigen::Vector3d& fallback) const;
  /// Symmetric positive definite: [xx, yy, zz] or [xx, yy, zz, xy, xz, yz], no entry beyond `most`.
  /// In the schema the entries are x, y, z, xy, xz, yz.
  Eigen::Matrix3d positiveDefinite(const ParameterKey& key,
                                   double most = std::numeric_limits<double>::infinity()) const;

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

  /// What the getters of the outermost reader and of all below it have read so far; a parameter
  /// that was missing stands there with its fallback. One that is read again is as the last getter
  /// read it.
  const Schema& schema() const;

 private:
  // Shared with the children, so that the outermost reader knows of everything.
  struct Heard {
    std::string root;  // name of the outermost reader
    std::set<std::string> names;
    Schema schema;
    std::map<std::string, std::size_t> places;  // in the schema
  };
  ParameterReader(const YAML::Node& tree, std::string name, std::shared_ptr<Heard> heard);
  YAML::Node find(const std::string& key) const;
  YAML::Node require(const std::string& key, const std::string& what) const;
  double toNumber(const YAML::Node& node, const std::string& full, const Range& range) const;
  void keep(Parameter parameter) const;
  void keepNumber(const ParameterKey& key, const Range& range, double value) const;
  void keepNumbers(ParameterKey key, const Range& range, std::vector<double> values) const;

  YAML::Node tree_;
  std::string name_;
  std::shared_ptr<Heard> heard_;
};

/// Reads a YAML file whose top level is a map; throws ParameterError naming the file (and the line)
/// when it cannot be read, is empty or is not YAML.
YAML::Node loadYamlFile(const std::string& path);

}  // namespace aqc
