#pragma once

#include <ros/node_handle.h>
#include <yaml-cpp/yaml.h>

#include <functional>
#include <memory>
#include <string>

namespace aqc {

/// The dynamic_reconfigure server of one control law.
class TuningServer {
 public:
  /// Applies a whole tree of gains or says why not; then nothing has changed.
  using Apply = std::function<std::string(const YAML::Node&)>;

  virtual ~TuningServer() = default;

  /// Tells the clients that these are the gains now.
  virtual void show(const YAML::Node& gains) = 0;

  /// The server for a law, in the namespace of `node`; null for a law that has none.
  static std::unique_ptr<TuningServer> make(const std::string& law, const ros::NodeHandle& node,
                                            const YAML::Node& gains, Apply apply);
};

}  // namespace aqc
