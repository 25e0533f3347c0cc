#include "ros/controller/rotor_claim.h"

#include <ros/master.h>
#include <ros/network.h>
#include <ros/this_node.h>
#include <xmlrpcpp/XmlRpc.h>

#include <cstdint>
#include <stdexcept>
#include <vector>

namespace aqc {
namespace {

constexpr int kName = 0;  // of a system state's entry [topic, [node, ...]]
constexpr int kNodes = 1;

std::vector<std::string> publishersOf(const std::string& topic) {
  XmlRpc::XmlRpcValue request, response, state;
  request[0] = ros::this_node::getName();
  if (!ros::master::execute("getSystemState", request, response, state, false)) return {};
  std::vector<std::string> nodes;
  XmlRpc::XmlRpcValue& publishers = state[0];
  for (int i = 0; i < publishers.size(); ++i) {
    if (static_cast<std::string>(publishers[i][kName]) != topic) continue;
    XmlRpc::XmlRpcValue& names = publishers[i][kNodes];
    for (int k = 0; k < names.size(); ++k) nodes.push_back(names[k]);
  }
  return nodes;
}

bool lives(const std::string& node) {
  XmlRpc::XmlRpcValue request, response, uri;
  request[0] = ros::this_node::getName();
  request[1] = node;
  if (!ros::master::execute("lookupNode", request, response, uri, false)) return false;
  std::string host;
  std::uint32_t port = 0;
  if (!ros::network::splitURI(uri, host, port)) return false;
  XmlRpc::XmlRpcClient client(host.c_str(), static_cast<int>(port), "/");
  XmlRpc::XmlRpcValue question, answer;
  question[0] = ros::this_node::getName();
  const bool answered = client.execute("getPid", question, answer);
  client.close();
  return answered;
}

}  // namespace

void requireSolePublisher(const std::string& topic) {
  for (const std::string& node : publishersOf(topic)) {
    if (node == ros::this_node::getName() || !lives(node)) continue;
    throw std::runtime_error("'" + node + "' publishes '" + topic +
                             "' already: two controllers on the same rotors fight; stop it first");
  }
}

}  // namespace aqc
