#pragma once

#include <dynamic_reconfigure/Config.h>
#include <dynamic_reconfigure/ConfigDescription.h>
#include <yaml-cpp/yaml.h>

#include <optional>

#include "adaptive_quadrotor_control/parameters/schema.h"

// From the parameters of a schema to the flat names of dynamic_reconfigure and back.
//
// A flat name is the path joined by underscores, for a list with the name of the entry behind it;
// maps in a list count from 1: entry 3 of subsystems[0]/leak is subsystems_1_leak_3. Every map of
// the tree is a group, named by its path in the same way. Lists of texts are left out: the protocol
// has no place for them.

namespace aqc {

/// What the clients must know: groups, names, types, ranges, descriptions. The values of `schema`
/// are the defaults. Of a range without a bound the bound is infinite; of one that leaves out its
/// least number, that number is told.
dynamic_reconfigure::ConfigDescription describe(const Schema& schema);

/// The values of `schema`.
dynamic_reconfigure::Config valuesOf(const Schema& schema);

/// A copy of `tree`, from which `schema` was read, with the values of `wanted`; none when they are
/// those of `schema`. Whether they are allowed is left to whoever reads the copy. Throws
/// ParameterError for a name that is not there, or a text where there is none.
std::optional<YAML::Node> withValues(const YAML::Node& tree, const Schema& schema,
                                     const dynamic_reconfigure::Config& wanted);

}  // namespace aqc
