#include "ros/controller/tuning_map.h"

#include <algorithm>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "adaptive_quadrotor_control/parameters/parameter_reader.h"

namespace aqc {
namespace {

using dynamic_reconfigure::Config;
using dynamic_reconfigure::ConfigDescription;
using Kind = Parameter::Kind;

// One value of a parameter; a list has several.
struct Leaf {
  const Parameter* parameter;
  std::size_t entry;
  std::string name;  // flat

  bool isText() const { return parameter->kind == Kind::kText; }
  double number() const { return isText() ? 0.0 : parameter->numbers[entry]; }
  std::string text() const { return isText() ? parameter->texts[entry] : ""; }
};

std::string flat(const std::string& path) {
  std::string name;
  for (std::size_t i = 0; i < path.size(); ++i) {
    if (path[i] == '[') {
      name += "_" + std::to_string(std::stoul(path.substr(i + 1)) + 1);
      i = path.find(']', i);
    } else {
      name += path[i] == '/' ? '_' : path[i];
    }
  }
  return name;
}

std::vector<Leaf> leavesOf(const Parameter& parameter) {
  const std::string name = flat(parameter.key.name);
  if (parameter.kind == Kind::kTexts) return {};
  if (parameter.kind != Kind::kNumbers) return {{&parameter, 0, name}};
  std::vector<Leaf> leaves;
  for (std::size_t i = 0; i < parameter.numbers.size(); ++i) {
    leaves.push_back({&parameter, i, name + "_" + parameter.key.entries[i]});
  }
  return leaves;
}

template <class Values, class Value>
void append(Values& values, const std::string& name, const Value& value) {
  values.emplace_back();
  values.back().name = name;
  values.back().value = value;
}

// Puts a value for a leaf into the list of its type.
void put(Config& config, const Leaf& leaf, double number, const std::string& text) {
  switch (leaf.parameter->kind) {
    case Kind::kFlag:
      return append(config.bools, leaf.name, static_cast<std::uint8_t>(number != 0.0));
    case Kind::kInteger:
      return append(config.ints, leaf.name, static_cast<std::int32_t>(number));
    case Kind::kText:
    case Kind::kTexts:
      return append(config.strs, leaf.name, text);
    case Kind::kNumber:
    case Kind::kNumbers:
      return append(config.doubles, leaf.name, number);
  }
}

std::string typeOf(Kind kind) {
  switch (kind) {
    case Kind::kFlag:
      return "bool";
    case Kind::kInteger:
      return "int";
    case Kind::kText:
    case Kind::kTexts:
      return "str";
    case Kind::kNumber:
    case Kind::kNumbers:
      break;
  }
  return "double";
}

// Clients evaluate what they may choose from as Python.
std::string pythonText(const std::string& text) {
  std::string quoted = "'";
  for (const char letter : text) {
    if (letter == '\'' || letter == '\\') quoted += '\\';
    quoted += letter;
  }
  return quoted + "'";
}

std::string editMethod(const Parameter& parameter) {
  std::string options;
  for (const std::string& choice : parameter.choices) {
    const std::string word = pythonText(choice);
    options += (options.empty() ? "{'name': " : ", {'name': ") + word + ", 'value': " + word +
               ", 'type': 'str', 'description': " + word + "}";
  }
  if (options.empty()) return "";
  return "{'enum': [" + options +
         "], 'enum_description': " + pythonText(parameter.key.description) + "}";
}

// The groups of a schema, in the order in which they come up.
class Groups {
 public:
  Groups() { add("Default", 0); }

  dynamic_reconfigure::Group& of(const Parameter& parameter) {
    return groups_[index(mapOf(parameter.key.name))];
  }
  const std::vector<dynamic_reconfigure::Group>& all() const { return groups_; }

 private:
  static std::string mapOf(const std::string& path) {
    const std::size_t slash = path.rfind('/');
    return slash == std::string::npos ? "" : path.substr(0, slash);
  }

  std::size_t index(const std::string& map) {
    if (map.empty()) return 0;
    const auto known = indices_.find(map);
    if (known != indices_.end()) return known->second;
    const std::size_t parent = index(mapOf(map));
    return indices_[map] = add(flat(map), parent);
  }

  std::size_t add(const std::string& name, std::size_t parent) {
    groups_.emplace_back();
    groups_.back().name = name;
    groups_.back().id = static_cast<std::int32_t>(groups_.size() - 1);
    groups_.back().parent = static_cast<std::int32_t>(parent);
    return groups_.size() - 1;
  }

  std::vector<dynamic_reconfigure::Group> groups_;  // each at the index that is its id
  std::map<std::string, std::size_t> indices_;      // by the path of their map
};

std::vector<dynamic_reconfigure::Group> groupsOf(const Schema& schema) {
  Groups groups;
  for (const Parameter& parameter : schema) {
    dynamic_reconfigure::Group& group = groups.of(parameter);
    for (const Leaf& leaf : leavesOf(parameter)) {
      dynamic_reconfigure::ParamDescription description;
      description.name = leaf.name;
      description.type = typeOf(parameter.kind);
      description.description = parameter.text();
      if (parameter.kind == Kind::kNumbers) {
        description.description += ", " + parameter.key.entries[leaf.entry];
      }
      description.edit_method = editMethod(parameter);
      group.parameters.push_back(description);
    }
  }
  return groups.all();
}

// The place of a path below a node, made where it is missing.
YAML::Node at(YAML::Node node, const std::string& path) {
  if (path.empty()) return node;
  if (path.front() == '/') return at(node, path.substr(1));
  if (path.front() == '[') {
    return at(node[std::stoul(path.substr(1))], path.substr(path.find(']') + 1));
  }
  const std::size_t end = std::min(path.find_first_of("/["), path.size());
  return at(node[path.substr(0, end)], path.substr(end));
}

// Takes over what a client wants, value by value.
class Change {
 public:
  Change(const YAML::Node& tree, const Schema& schema) : tree_(YAML::Clone(tree)) {
    for (const Parameter& parameter : schema) {
      for (const Leaf& leaf : leavesOf(parameter)) leaves_.emplace(leaf.name, leaf);
    }
  }

  void setNumber(const std::string& name, double number) {
    const Leaf& leaf = named(name, false);
    if (leaf.number() == number) return;  // it keeps its spelling
    if (leaf.parameter->kind == Kind::kFlag && (number == 0.0 || number == 1.0)) {
      place(leaf) = number != 0.0;
    } else {
      place(leaf) = number;
    }
  }
  void setText(const std::string& name, const std::string& text) {
    const Leaf& leaf = named(name, true);
    if (leaf.text() != text) place(leaf) = text;
  }

  std::optional<YAML::Node> result() const {
    return changed_ ? std::optional<YAML::Node>(tree_) : std::nullopt;
  }

 private:
  const Leaf& named(const std::string& name, bool text) const {
    const auto leaf = leaves_.find(name);
    if (leaf == leaves_.end()) throw ParameterError("there is no gain '" + name + "'");
    if (leaf->second.isText() != text) {
      throw ParameterError("gain '" + name + "' is a " + (text ? "number" : "text") + ", not a " +
                           (text ? "text" : "number"));
    }
    return leaf->second;
  }

  YAML::Node place(const Leaf& leaf) {
    changed_ = true;
    YAML::Node node = at(tree_, leaf.parameter->key.name);
    if (leaf.parameter->kind != Kind::kNumbers) return node;
    if (!node.IsSequence()) node = leaf.parameter->numbers;
    return node[leaf.entry];
  }

  YAML::Node tree_;
  std::map<std::string, Leaf> leaves_;  // by their names
  bool changed_ = false;
};

}  // namespace

ConfigDescription describe(const Schema& schema) {
  ConfigDescription description;
  description.groups = groupsOf(schema);
  for (const Parameter& parameter : schema) {
    for (const Leaf& leaf : leavesOf(parameter)) {
      put(description.min, leaf, parameter.range.min, "");
      put(description.max, leaf, parameter.range.max, "");
    }
  }
  description.dflt = valuesOf(schema);
  description.min.groups = description.max.groups = description.dflt.groups;
  return description;
}

Config valuesOf(const Schema& schema) {
  Config values;
  for (const Parameter& parameter : schema) {
    for (const Leaf& leaf : leavesOf(parameter)) put(values, leaf, leaf.number(), leaf.text());
  }
  for (const dynamic_reconfigure::Group& group : groupsOf(schema)) {
    dynamic_reconfigure::GroupState state;
    state.name = group.name;
    state.state = true;
    state.id = group.id;
    state.parent = group.parent;
    values.groups.push_back(state);
  }
  return values;
}

std::optional<YAML::Node> withValues(const YAML::Node& tree, const Schema& schema,
                                     const Config& wanted) {
  Change change(tree, schema);
  for (const auto& value : wanted.bools) change.setNumber(value.name, value.value != 0 ? 1.0 : 0.0);
  for (const auto& value : wanted.ints) change.setNumber(value.name, value.value);
  for (const auto& value : wanted.doubles) change.setNumber(value.name, value.value);
  for (const auto& value : wanted.strs) change.setText(value.name, value.value);
  return change.result();
}

}  // namespace aqc
