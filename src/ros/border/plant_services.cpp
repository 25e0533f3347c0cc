#include "ros/border/plant_services.h"

#include "adaptive_quadrotor_control/math/number_text.h"
#include "adaptive_quadrotor_control/parameters/parameter_reader.h"
#include "adaptive_quadrotor_control/simulation/plant_action_reader.h"

namespace aqc {
namespace {

// The tree of a request, of which the readers of scenario files make an action. Numbers are texts
// of 17 digits there, which tell every double from the next: YAML::Node may round them.
YAML::Node toYaml(double number) {
  return YAML::Node(formatted("%.17g", number));
}

YAML::Node toYaml(const geometry_msgs::Vector3& vector) {
  YAML::Node list;
  for (const double number : {vector.x, vector.y, vector.z}) list.push_back(toYaml(number));
  return list;
}

bool isZero(const geometry_msgs::Vector3& vector) {
  return toEigen(vector).isZero(0.0);
}

// The entries of an inertia as both requests that have one carry them.
template <class Request>
void setInertia(const Eigen::Matrix3d& inertia, Request& request) {
  request.inertia = toVector3(inertia.diagonal());
  request.products = toVector3({inertia(0, 1), inertia(0, 2), inertia(1, 2)});
}

template <class Request>
YAML::Node inertiaOf(const Request& request) {
  YAML::Node list = toYaml(request.inertia);
  if (isZero(request.products)) return list;
  for (const YAML::Node& number : toYaml(request.products)) list.push_back(number);
  return list;
}

// How long something lasts, as both requests that tell it carry it.
template <class Request>
YAML::Node lastingTree(const Request& request) {
  YAML::Node tree;
  tree["for_so_long"] = toYaml(request.for_so_long.toSec());
  return tree;
}

template <class Request>
Nanoseconds readDuration(const ParameterReader& reader, const Request& request) {
  reader.number("for_so_long", kDisturbed);  // taken as it came: seconds may round it
  return request.for_so_long.toNSec();
}

void setMount(const RigidMount&, msgs::AttachPayload::Request&) {}

void setMount(const Joint& joint, msgs::AttachPayload::Request& request) {
  request.joint_frequency = joint.frequency;
  request.joint_damping = joint.damping;
}

void setMount(const Cable& cable, msgs::AttachPayload::Request& request) {
  request.cable_length = cable.length;
}

void addMount(const msgs::AttachPayload::Request& request, YAML::Node& tree) {
  if (request.joint_frequency != 0.0 || request.joint_damping != 0.0) {
    tree["joint"]["frequency"] = toYaml(request.joint_frequency);
    tree["joint"]["damping"] = toYaml(request.joint_damping);
  }
  if (request.cable_length != 0.0) tree["cable"]["length"] = toYaml(request.cable_length);
}

}  // namespace

msgs::AttachPayload::Request toRequest(const AttachPayload& action, const ros::Time& at) {
  msgs::AttachPayload::Request request;
  request.at = at;
  request.name = action.name;
  request.mass = action.payload.mass;
  request.size = toVector3(action.payload.size);
  request.offset = toVector3(action.payload.offset);
  setInertia(action.payload.inertia, request);
  std::visit([&](const auto& mount) { setMount(mount, request); }, action.payload.mount);
  return request;
}

AttachPayload toAction(const msgs::AttachPayload::Request& request) {
  YAML::Node tree;
  tree["mass"] = toYaml(request.mass);
  tree["size"] = toYaml(request.size);
  tree["offset"] = toYaml(request.offset);
  const bool solid_box = isZero(request.inertia) && isZero(request.products);
  if (!solid_box) tree["inertia"] = inertiaOf(request);
  addMount(request, tree);
  return {request.name, readPayload(ParameterReader(tree, "payload"))};
}

msgs::DetachPayload::Request toRequest(const DetachPayload&, const ros::Time& at) {
  msgs::DetachPayload::Request request;
  request.at = at;
  return request;
}

DetachPayload toAction(const msgs::DetachPayload::Request&) {
  return {};
}

msgs::SetWind::Request toRequest(const SetWind& action, const ros::Time& at) {
  msgs::SetWind::Request request;
  request.at = at;
  request.velocity = toVector3(action.velocity);
  return request;
}

SetWind toAction(const msgs::SetWind::Request& request) {
  YAML::Node tree;
  tree["velocity"] = toYaml(request.velocity);
  return readWind(ParameterReader(tree, "wind"));
}

msgs::SetBody::Request toRequest(const SetBody& action, const ros::Time& at) {
  msgs::SetBody::Request request;
  request.at = at;
  request.mass = action.mass;
  setInertia(action.inertia, request);
  return request;
}

SetBody toAction(const msgs::SetBody::Request& request) {
  YAML::Node tree;
  tree["mass"] = toYaml(request.mass);
  tree["inertia"] = inertiaOf(request);
  return readBody(ParameterReader(tree, "body"));
}

msgs::ApplyDisturbance::Request toRequest(const ApplyDisturbance& action, const ros::Time& at) {
  msgs::ApplyDisturbance::Request request;
  request.at = at;
  request.for_so_long.fromNSec(action.duration);
  request.force = toVector3(action.amplitude.force);
  request.moment = toVector3(action.amplitude.moment);
  request.angular_frequency = action.angular_frequency;
  return request;
}

ApplyDisturbance toAction(const msgs::ApplyDisturbance::Request& request) {
  YAML::Node tree = lastingTree(request);
  tree["force"] = toYaml(request.force);
  tree["moment"] = toYaml(request.moment);
  tree["angular_frequency"] = toYaml(request.angular_frequency);
  const ParameterReader reader(tree, "disturbance");
  return readDisturbance(reader, readDuration(reader, request));
}

msgs::SetRotor::Request toRequest(const SetRotor& action, const ros::Time& at) {
  msgs::SetRotor::Request request;
  request.at = at;
  request.number = static_cast<std::uint8_t>(action.number);
  request.effectiveness = action.condition.effectiveness;
  request.stuck = action.condition.stuck_at.has_value();
  request.stuck_at = action.condition.stuck_at.value_or(0.0);
  request.slower = action.condition.slower;
  return request;
}

SetRotor toAction(const msgs::SetRotor::Request& request) {
  YAML::Node tree;
  tree["number"] = std::to_string(request.number);
  tree["effectiveness"] = toYaml(request.effectiveness);
  if (request.stuck) tree["stuck_at"] = toYaml(request.stuck_at);
  if (request.slower != 0.0) tree["slower"] = toYaml(request.slower);
  return readRotor(ParameterReader(tree, "rotor"));
}

msgs::SetBattery::Request toRequest(const SetBattery& action, const ros::Time& at) {
  msgs::SetBattery::Request request;
  request.at = at;
  request.voltage = action.voltage;
  request.over.fromNSec(action.over);
  return request;
}

SetBattery toAction(const msgs::SetBattery::Request& request) {
  YAML::Node tree;
  tree["voltage"] = toYaml(request.voltage);
  tree["over"] = toYaml(request.over.toSec());
  return readBattery(ParameterReader(tree, "battery"));
}

msgs::SetGust::Request toRequest(const SetGust& action, const ros::Time& at) {
  msgs::SetGust::Request request;
  request.at = at;
  request.intensity = toVector3(action.intensity);
  request.length = action.length;
  request.speed = action.speed;
  request.seed = static_cast<std::uint32_t>(action.seed);
  return request;
}

SetGust toAction(const msgs::SetGust::Request& request) {
  YAML::Node tree;
  tree["intensity"] = toYaml(request.intensity);
  if (request.length != 0.0) tree["length"] = toYaml(request.length);
  if (request.speed != 0.0) tree["speed"] = toYaml(request.speed);
  tree["seed"] = std::to_string(request.seed);
  return readGust(ParameterReader(tree, "gust"));
}

msgs::LoseCommands::Request toRequest(const LoseCommands& action, const ros::Time& at) {
  msgs::LoseCommands::Request request;
  request.at = at;
  request.share = action.share;
  request.for_so_long.fromNSec(action.duration);
  request.seed = static_cast<std::uint32_t>(action.seed);
  return request;
}

LoseCommands toAction(const msgs::LoseCommands::Request& request) {
  YAML::Node tree = lastingTree(request);
  tree["share"] = toYaml(request.share);
  tree["seed"] = std::to_string(request.seed);
  const ParameterReader reader(tree, "lose_commands");
  return readLostCommands(reader, readDuration(reader, request));
}

}  // namespace aqc
