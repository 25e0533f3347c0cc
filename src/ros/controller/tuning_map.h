#pragma once

#include <dynamic_reconfigure/Config.h>
#include <yaml-cpp/yaml.h>

#include <string>
#include <vector>

// From the parameter tree of a control law to the flat names of dynamic_reconfigure and back.
//
// A flat name is the path joined by underscores; entries of a list get the name of their axis (x,
// y, z; or z, roll, pitch, yaw) or their index from 0, whichever dynamic_reconfigure knows; maps in
// a list count from 1: subsystems[0]/leak[3] is subsystems_1_leak_3. cfg/gains.py says the same.

namespace aqc {

/// Puts the tree's numbers and texts into those of `values` that have their names.
void readTree(const YAML::Node& tree, dynamic_reconfigure::Config& values);

/// A copy of the tree with `values` in their places; those without a place are left out.
YAML::Node withValues(const YAML::Node& tree, const dynamic_reconfigure::Config& values);

/// Flat names of numbers in the tree that `values` lacks: they cannot be tuned.
std::vector<std::string> missingNames(const YAML::Node& tree,
                                      const dynamic_reconfigure::Config& values);

}  // namespace aqc
