#include "ros/controller/tuning_server.h"

#include <ros/console.h>

#include <utility>

#include "ros/controller/tuning_map.h"

namespace aqc {
namespace {

using dynamic_reconfigure::Config;
using dynamic_reconfigure::ConfigDescription;

bool sameButForDefaults(const ConfigDescription& a, const ConfigDescription& b) {
  return a.groups == b.groups && a.min == b.min && a.max == b.max;
}

}  // namespace

TuningServer::TuningServer(const ros::NodeHandle& node, Take take)
    : node_(node), take_(std::move(take)) {
  descriptions_ = node_.advertise<ConfigDescription>("parameter_descriptions", 1, true);
  updates_ = node_.advertise<Config>("parameter_updates", 1, true);
  service_ = node_.advertiseService("set_parameters", &TuningServer::onSet, this);
}

void TuningServer::show(const Schema& schema) {
  const ConfigDescription description = describe(schema);
  if (!sameButForDefaults(description, description_)) {
    description_ = description;
    descriptions_.publish(description_);
  }
  values_ = valuesOf(schema);
  updates_.publish(values_);
}

bool TuningServer::onSet(dynamic_reconfigure::Reconfigure::Request& request,
                         dynamic_reconfigure::Reconfigure::Response& response) {
  const std::string problem = take_(request.config);
  if (!problem.empty()) ROS_WARN("gains refused, nothing changed: %s", problem.c_str());
  response.config = values_;
  return true;
}

}  // namespace aqc
