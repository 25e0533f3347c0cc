#include "ros/border/parameter_tree.h"

#include <XmlRpcValue.h>

namespace aqc {
namespace {

YAML::Node toYaml(XmlRpc::XmlRpcValue& value, const std::string& name) {
  using Value = XmlRpc::XmlRpcValue;
  switch (value.getType()) {
    case Value::TypeBoolean:
      return YAML::Node(static_cast<bool>(value));
    case Value::TypeInt:
      return YAML::Node(static_cast<int>(value));
    case Value::TypeDouble:
      return YAML::Node(static_cast<double>(value));
    case Value::TypeString:
      return YAML::Node(static_cast<std::string>(value));
    case Value::TypeArray: {
      YAML::Node list(YAML::NodeType::Sequence);
      for (int i = 0; i < value.size(); ++i) {
        list.push_back(toYaml(value[i], name + "[" + std::to_string(i) + "]"));
      }
      return list;
    }
    case Value::TypeStruct: {
      YAML::Node map(YAML::NodeType::Map);
      for (auto& entry : value) map[entry.first] = toYaml(entry.second, name + "/" + entry.first);
      return map;
    }
    default:
      throw ParameterError("parameter '" + name +
                           "' is of a type that is neither number, text, list nor map");
  }
}

// YAML does not tell numbers and flags from texts; what reads as one of these is one.
XmlRpc::XmlRpcValue toXmlRpc(const YAML::Node& node) {
  XmlRpc::XmlRpcValue value;
  int index = 0;
  if (node.IsMap()) {
    for (const auto& entry : node) value[entry.first.as<std::string>()] = toXmlRpc(entry.second);
    return value;
  }
  if (node.IsSequence()) {
    value.setSize(static_cast<int>(node.size()));
    for (const YAML::Node& entry : node) value[index++] = toXmlRpc(entry);
    return value;
  }
  int whole = 0;
  double number = 0.0;
  if (YAML::convert<int>::decode(node, whole)) return whole;
  if (YAML::convert<double>::decode(node, number)) return number;
  const std::string text = node.Scalar();
  if (text == "true" || text == "false") return XmlRpc::XmlRpcValue(text == "true");
  return XmlRpc::XmlRpcValue(text);
}

}  // namespace

void setParameterTree(const ros::NodeHandle& node, const std::string& key, const YAML::Node& tree) {
  node.setParam(key, toXmlRpc(tree));
}

YAML::Node parameterTree(const ros::NodeHandle& node, const std::string& key) {
  const std::string name = node.resolveName(key);
  XmlRpc::XmlRpcValue value;
  if (!node.getParam(key, value)) {
    if (key.empty()) return YAML::Node(YAML::NodeType::Map);  // a node without any parameters
    throw ParameterError("parameter '" + name + "' is missing; load a YAML file there");
  }
  return toYaml(value, name);
}

ParameterReader parameterReader(const ros::NodeHandle& node, const std::string& key) {
  return ParameterReader(parameterTree(node, key), node.resolveName(key));
}

}  // namespace aqc
