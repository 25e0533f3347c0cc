#pragma once

#include <string>
#include <vector>

namespace aqc {

/// The package's folder config/: `<prefix>/share/adaptive_quadrotor_control/config` for a program
/// installed as `<prefix>/lib/adaptive_quadrotor_control/<program>`, otherwise that of the source
/// tree it was built from. Throws std::runtime_error when neither exists.
std::string configFolder();

/// Names (without `.yaml`) of what `config`/`kind` holds, in alphabetical order. `kind` is
/// "scenario", "vehicle" or "controller".
std::vector<std::string> resourceNames(const std::string& config, const std::string& kind);

/// The file that `name` means: itself when it is a path (it holds a '/' or ends in .yaml or .yml),
/// otherwise `config`/`kind`/`name`.yaml. Throws std::runtime_error for a bare name that does not
/// exist, listing those that do, and for a path that is no file.
std::string findResource(const std::string& config, const std::string& kind,
                         const std::string& name);

/// What a resource file is called: its name without folder and extension.
std::string resourceName(const std::string& path);

}  // namespace aqc
