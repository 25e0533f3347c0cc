#include "fuzz/mutation.h"

#include <yaml-cpp/yaml.h>

#include <array>
#include <random>
#include <vector>

#include "adaptive_quadrotor_control/math/number_text.h"

namespace aqc::fuzz {
namespace {

constexpr std::size_t kMostNodes = 3000;
constexpr int kDeepest = 20;  // an alias may stand within what it means

constexpr std::array<const char*, 34> kWords = {"0",           "-0.0",
                                                "1",           "-1",
                                                "2",           "0.5",
                                                "1e-3",        "1e-9",
                                                "1e-30",       "1e-308",
                                                "5e-324",      "1e3",
                                                "1e6",         "1e9",
                                                "1e12",        "1e30",
                                                "1e154",       "1e308",
                                                "-1e308",      "1e400",
                                                ".nan",        ".inf",
                                                "-.inf",       "2147483648",
                                                "-2147483649", "9223372036854775808",
                                                "0x10",        "true",
                                                "~",           "",
                                                "asmc",        "[]",
                                                "{}",          "[1, 1, 1]"};

class Mutation {
 public:
  explicit Mutation(std::uint64_t seed) : random_(seed) {}

  std::size_t below(std::size_t count) { return static_cast<std::size_t>(random_() % count); }

  // False when there are too many, or none.
  bool collect(const YAML::Node& node, int depth = 0) {
    if (depth > kDeepest || values_.size() > kMostNodes) return false;
    if (node.IsMap()) {
      for (const auto& entry : node) {
        if (!collect(entry.second, depth + 1)) return false;
      }
      if (node.size() > 0) maps_.push_back(node);
    } else if (node.IsSequence()) {
      for (const auto& entry : node) {
        if (!collect(entry, depth + 1)) return false;
      }
      lists_.push_back(node);
    } else {
      values_.push_back(node);
    }
    return depth > 0 || !values_.empty();
  }

  void change() {
    const std::size_t kind = below(16);
    if (kind == 0) {
      leaveOut(maps_.at(below(maps_.size())));
    } else if (kind == 1 && !lists_.empty()) {
      YAML::Node list = lists_.at(below(lists_.size()));
      if (list.IsSequence() && list.size() > 0)
        list.push_back(YAML::Clone(list[below(list.size())]));
    } else if (kind == 2) {
      const std::size_t place = below(maps_.size() + lists_.size());
      YAML::Node whole = place < maps_.size() ? maps_.at(place) : lists_.at(place - maps_.size());
      whole = YAML::Load(kWords.at(below(kWords.size())));
    } else {
      changeValue(values_.at(below(values_.size())));
    }
  }

 private:
  void leaveOut(YAML::Node map) {
    if (!map.IsMap() || map.size() == 0) return;  // an earlier change
    std::size_t place = below(map.size());
    for (const auto& entry : map) {
      if (place-- > 0) continue;
      map.remove(entry.first);
      return;
    }
  }
  void changeValue(YAML::Node value) {
    const std::size_t kind = below(4);
    double number = 0.0;
    if (kind == 0) {
      value = YAML::Clone(values_.at(below(values_.size())));
    } else if (kind == 1 && YAML::convert<double>::decode(value, number)) {
      constexpr std::array<double, 8> kFactors = {-1.0, 0.0, 0.5, 2.0, 10.0, 0.1, 1e3, 1e-3};
      value = numberText(number * kFactors.at(below(kFactors.size())));
    } else {
      value = YAML::Load(kWords.at(below(kWords.size())));
    }
  }

  std::mt19937_64 random_;
  std::vector<YAML::Node> values_, maps_, lists_;
};

}  // namespace

std::string mutatedYaml(const std::string& yaml, std::uint64_t seed) {
  try {
    const YAML::Node tree = YAML::Load(yaml);
    Mutation mutation(seed);
    if (!tree.IsMap() || !mutation.collect(tree)) return "";
    for (std::size_t changes = 1 + mutation.below(3); changes > 0; --changes) mutation.change();
    return YAML::Dump(tree);
  } catch (const YAML::Exception&) {
    return "";
  }
}

std::string mutatedBytes(std::string bytes, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  const auto below = [&](std::size_t count) { return static_cast<std::size_t>(random() % count); };
  for (std::size_t changes = 1 + below(4); changes > 0; --changes) {
    const std::size_t place = below(bytes.size() + 1);
    const char byte = static_cast<char>(below(256));
    const std::size_t kind = below(3);
    if (kind == 0 || place == bytes.size()) {
      bytes.insert(place, 1, byte);
    } else if (kind == 1) {
      bytes[place] = byte;
    } else {
      bytes.erase(place, 1);
    }
  }
  return bytes;
}

}  // namespace aqc::fuzz
