#include "report/resources.h"

#include <algorithm>
#include <filesystem>
#include <stdexcept>
#include <system_error>

namespace aqc {
namespace {

namespace fs = std::filesystem;

bool isYaml(const fs::path& path) {
  return path.extension() == ".yaml" || path.extension() == ".yml";
}

bool isPath(const std::string& name) {
  return name.find('/') != std::string::npos || isYaml(name);
}

std::string join(const std::vector<std::string>& words) {
  std::string all;
  for (const std::string& word : words) all += (all.empty() ? "" : ", ") + word;
  return all;
}

}  // namespace

std::string configFolder() {
  std::error_code ignored;  // without /proc, what is installed cannot be found by this way
  const fs::path program = fs::read_symlink("/proc/self/exe", ignored);
  const fs::path prefix = program.parent_path().parent_path().parent_path();
  const fs::path installed = prefix / "share" / "adaptive_quadrotor_control" / "config";
  if (fs::is_directory(installed, ignored)) return installed.string();
  if (fs::is_directory(AQC_SOURCE_CONFIG, ignored)) return AQC_SOURCE_CONFIG;
  throw std::runtime_error("there is no config folder; looked for '" + installed.string() +
                           "' and '" + AQC_SOURCE_CONFIG + "'");
}

std::vector<std::string> resourceNames(const std::string& config, const std::string& kind) {
  std::vector<std::string> names;
  std::error_code failure;  // a folder that cannot be read holds nothing
  for (const auto& entry : fs::directory_iterator(fs::path(config) / kind, failure)) {
    if (entry.path().extension() == ".yaml") names.push_back(entry.path().stem().string());
  }
  std::sort(names.begin(), names.end());
  return names;
}

std::string findResource(const std::string& config, const std::string& kind,
                         const std::string& name) {
  std::error_code ignored;
  if (isPath(name)) {
    if (!fs::exists(name, ignored)) {
      throw std::runtime_error(kind + " file '" + name + "' does not exist");
    }
    if (fs::is_directory(name, ignored)) {
      throw std::runtime_error(kind + " file '" + name + "' is a folder");
    }
    return name;
  }
  const fs::path file = fs::path(config) / kind / (name + ".yaml");
  if (!name.empty() && fs::is_regular_file(file, ignored)) return file.string();
  throw std::runtime_error("unknown " + kind + " '" + name +
                           "'; there are: " + join(resourceNames(config, kind)));
}

std::string resourceName(const std::string& path) {
  return fs::path(path).stem().string();
}

}  // namespace aqc
