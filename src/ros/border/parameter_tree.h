#pragma once

#include <ros/node_handle.h>
#include <yaml-cpp/yaml.h>

#include <string>

#include "adaptive_quadrotor_control/parameters/parameter_reader.h"

namespace aqc {

/// The ROS parameters below `key` (empty: all of the node handle's namespace) as the same tree that
/// a YAML file gives. Throws ParameterError when there are none below a key that is not empty, or
/// when they hold a type that YAML has no word for.
YAML::Node parameterTree(const ros::NodeHandle& node, const std::string& key);

/// Writes a tree of numbers, texts, lists and maps to the parameters below `key`.
void setParameterTree(const ros::NodeHandle& node, const std::string& key, const YAML::Node& tree);

/// A reader of that tree whose errors print the full ROS names.
ParameterReader parameterReader(const ros::NodeHandle& node, const std::string& key);

/// What `read` makes of that tree; refuses names that it does not read. Throws ParameterError.
template <class Read>
auto readParameters(const ros::NodeHandle& node, const std::string& key, Read read) {
  const ParameterReader reader = parameterReader(node, key);
  auto result = read(reader);
  reader.finish();
  return result;
}

}  // namespace aqc
