#include "ros/controller/tuning_map.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "adaptive_quadrotor_control/law/law_factory.h"
#include "adaptive_quadrotor_control/parameters/parameter_reader.h"
#include "support/fixtures.h"
#include "support/refusal.h"

// Without a master: what the clients of dynamic_reconfigure are told of a law's gains, and what
// becomes of their answers.
namespace aqc {
namespace {

using dynamic_reconfigure::Config;
using dynamic_reconfigure::ConfigDescription;
using dynamic_reconfigure::ParamDescription;

constexpr double kUnbounded = std::numeric_limits<double>::infinity();

const char* const kToy = R"(law: toy
lift: 2.50
count: 3
calm: true
policy: refuse
words: [a, b]
loop:
  slope: [1.5, 2, 3]
  leak: [4, 5]
parts: [{drive: 0.1}, {drive: 0.2, inner: {depth: 7}}]
)";

// The reading of a law that nothing else in the package knows.
Schema readToy(const YAML::Node& tree) {
  const ParameterReader reader(tree, "toy.yaml");
  reader.number({"lift", "", "N", "least force"}, Range::positive());
  reader.integer({"count", "N", "", "how many"}, 1, 9);
  reader.flag({"calm", "", "", "whether it is calm"}, false);
  reader.choice({"policy", "", "", "what becomes of a switch"}, {"refuse", "it's fine"});
  reader.texts("words");
  reader.number({"extra", "", "s", "not in the file"}, Range::positiveUpTo(10.0), 6.0);
  const ParameterReader loop = reader.child("loop");
  loop.vector3({"slope", "Phi", "1/s", "how fast it decays"}, Range::positive());
  loop.numbers({"leak", "alpha", "1/s", "forgetting"}, 2, Range::nonNegative());
  loop.vector3("offset", Range::any(), {1.0, 2.0, 3.0});
  const std::vector<ParameterReader> parts = reader.children("parts");
  for (const ParameterReader& part : parts) part.number("drive", Range::any());
  parts[1].child("inner").number("depth", Range::any());
  return reader.schema();
}

Schema toy() {
  return readToy(YAML::Load(kToy));
}

template <class Values>
auto valueOf(const Values& values, const std::string& name) {
  for (const auto& value : values) {
    if (value.name == name) return value.value;
  }
  throw std::out_of_range("there is no " + name);
}

ParamDescription descriptionOf(const ConfigDescription& description, const std::string& name) {
  for (const auto& group : description.groups) {
    for (const ParamDescription& parameter : group.parameters) {
      if (parameter.name == name) return parameter;
    }
  }
  throw std::out_of_range("there is no " + name);
}

Config wanting(const std::string& name, double number) {
  Config wanted;
  wanted.doubles.emplace_back();
  wanted.doubles.back().name = name;
  wanted.doubles.back().value = number;
  return wanted;
}

Config wanting(const std::string& name, const std::string& text) {
  Config wanted;
  wanted.strs.emplace_back();
  wanted.strs.back().name = name;
  wanted.strs.back().value = text;
  return wanted;
}

// The tree with a value of a client; fails where nothing changes.
YAML::Node changed(const Config& wanted) {
  const YAML::Node tree = YAML::Load(kToy);
  const std::string before = YAML::Dump(tree);
  const std::optional<YAML::Node> result = withValues(tree, toy(), wanted);
  EXPECT_EQ(YAML::Dump(tree), before) << "the tree itself stays";
  EXPECT_TRUE(result.has_value());
  return result.value_or(tree);
}

TEST(TuningMap, ServesEveryKindOfGainUnderItsFlatName) {
  const Config values = valuesOf(toy());
  std::map<std::string, double> numbers;
  for (const auto& value : values.doubles) numbers[value.name] = value.value;
  const std::map<std::string, double> expected = {{"lift", 2.5},
                                                  {"extra", 6.0},
                                                  {"loop_slope_x", 1.5},
                                                  {"loop_slope_y", 2.0},
                                                  {"loop_slope_z", 3.0},
                                                  {"loop_leak_0", 4.0},
                                                  {"loop_leak_1", 5.0},
                                                  {"loop_offset_x", 1.0},
                                                  {"loop_offset_y", 2.0},
                                                  {"loop_offset_z", 3.0},
                                                  {"parts_1_drive", 0.1},
                                                  {"parts_2_drive", 0.2},
                                                  {"parts_2_inner_depth", 7.0}};
  EXPECT_EQ(numbers, expected);
  EXPECT_EQ(valueOf(values.ints, "count"), 3);
  EXPECT_EQ(valueOf(values.bools, "calm"), 1);
  EXPECT_EQ(valueOf(values.strs, "policy"), "refuse");
  EXPECT_EQ(values.ints.size() + values.bools.size() + values.strs.size(), 3u)
      << "a list of texts has no place";
}

TEST(TuningMap, TellsTypeRangeAndMeaning) {
  const ConfigDescription description = describe(toy());
  const ParamDescription slope = descriptionOf(description, "loop_slope_z");
  EXPECT_EQ(slope.type, "double");
  EXPECT_EQ(slope.description, "Phi [1/s]: how fast it decays, z");
  EXPECT_EQ(slope.edit_method, "");
  EXPECT_EQ(valueOf(description.min.doubles, "loop_slope_z"), 0.0);
  EXPECT_EQ(valueOf(description.max.doubles, "loop_slope_z"), kUnbounded);
  EXPECT_EQ(valueOf(description.min.doubles, "loop_offset_x"), -kUnbounded);
  EXPECT_EQ(valueOf(description.max.doubles, "extra"), 10.0);
  EXPECT_EQ(valueOf(description.dflt.doubles, "lift"), 2.5);
  EXPECT_EQ(descriptionOf(description, "lift").description, "least force [N]");
  EXPECT_EQ(descriptionOf(description, "count").type, "int");
  EXPECT_EQ(valueOf(description.min.ints, "count"), 1);
  EXPECT_EQ(valueOf(description.max.ints, "count"), 9);
  EXPECT_EQ(descriptionOf(description, "calm").type, "bool");
  EXPECT_EQ(valueOf(description.min.bools, "calm"), 0);
  EXPECT_EQ(valueOf(description.max.bools, "calm"), 1);
  const ParamDescription policy = descriptionOf(description, "policy");
  EXPECT_EQ(policy.type, "str");
  EXPECT_EQ(policy.edit_method,
            R"({'enum': [{'name': 'refuse', 'value': 'refuse', 'type': 'str', )"
            R"('description': 'refuse'}, {'name': 'it\'s fine', 'value': 'it\'s fine', )"
            R"('type': 'str', 'description': 'it\'s fine'}], )"
            R"('enum_description': 'what becomes of a switch'})");
  for (const Config* bound : {&description.min, &description.max, &description.dflt}) {
    EXPECT_EQ(bound->doubles.size(), 13u);
    EXPECT_EQ(valueOf(bound->strs, "policy"), bound == &description.dflt ? "refuse" : "");
  }
}

TEST(TuningMap, MakesAGroupOfEveryMap) {
  const ConfigDescription description = describe(toy());
  std::vector<std::string> groups;
  for (const auto& group : description.groups) {
    groups.push_back(group.name + " " + std::to_string(group.id) + " in " +
                     std::to_string(group.parent));
  }
  EXPECT_EQ(groups, (std::vector<std::string>{"Default 0 in 0", "loop 1 in 0", "parts_1 2 in 0",
                                              "parts_2 3 in 0", "parts_2_inner 4 in 3"}));
  EXPECT_EQ(description.groups[1].parameters.front().name, "loop_slope_x");
  const Config values = valuesOf(toy());
  ASSERT_EQ(values.groups.size(), 5u);
  EXPECT_EQ(values.groups[4].name, "parts_2_inner");
  EXPECT_EQ(values.groups[4].parent, 3);
  EXPECT_TRUE(values.groups[4].state);
}

TEST(TuningMap, PutsValuesBackInTheirPlaces) {
  EXPECT_EQ(changed(wanting("loop_leak_1", 0.25))["loop"]["leak"][1].as<double>(), 0.25);
  EXPECT_EQ(changed(wanting("parts_2_drive", -1.0))["parts"][1]["drive"].as<double>(), -1.0);
  EXPECT_EQ(changed(wanting("parts_2_inner_depth", 8.0))["parts"][1]["inner"]["depth"].as<int>(),
            8);
  EXPECT_EQ(changed(wanting("count", 4.0))["count"].Scalar(), "4");
  EXPECT_EQ(changed(wanting("calm", 0.0))["calm"].Scalar(), "false");
  EXPECT_EQ(changed(wanting("policy", "it's fine"))["policy"].Scalar(), "it's fine");
  const YAML::Node tree = changed(wanting("loop_slope_y", 1.0 / 3.0));
  EXPECT_EQ(tree["loop"]["slope"][1].as<double>(), 1.0 / 3.0) << "every bit";
  EXPECT_EQ(tree["loop"]["slope"][0].Scalar(), "1.5");
  EXPECT_EQ(tree["lift"].Scalar(), "2.50") << "the others keep their spelling";
}

TEST(TuningMap, PutsWhatTheFileLacksThere) {
  EXPECT_EQ(changed(wanting("extra", 7.0))["extra"].as<double>(), 7.0);
  EXPECT_EQ(changed(wanting("loop_offset_y", 9.0))["loop"]["offset"].as<std::vector<double>>(),
            (std::vector<double>{1.0, 9.0, 3.0}));
}

TEST(TuningMap, LeavesToTheReaderWhatIsAllowed) {
  for (const double wrong : {-1.0, std::nan(""), kUnbounded}) {
    test::expectRefusal([&] { readToy(changed(wanting("loop_slope_x", wrong))); },
                        {"'toy.yaml/loop/slope[0]'", "a finite number > 0"});
  }
  test::expectRefusal([&] { readToy(changed(wanting("count", 2.5))); }, {"'toy.yaml/count'"});
  test::expectRefusal([&] { readToy(changed(wanting("calm", 2.0))); }, {"'toy.yaml/calm'"});
  test::expectRefusal([&] { readToy(changed(wanting("policy", "never"))); }, {"'toy.yaml/policy'"});
}

TEST(TuningMap, ChangesNothingWhenNothingIsWanted) {
  const YAML::Node tree = YAML::Load(kToy);
  EXPECT_FALSE(withValues(tree, toy(), Config()).has_value());
  EXPECT_FALSE(withValues(tree, toy(), valuesOf(toy())).has_value()) << "all as it is";
}

TEST(TuningMap, RefusesWhatIsNotThere) {
  test::expectRefusal([] { changed(wanting("loop_slope_w", 1.0)); }, {"'loop_slope_w'"});
  test::expectRefusal([] { changed(wanting("law", "asmc")); }, {"'law'"});
  test::expectRefusal([] { changed(wanting("lift", "high")); }, {"'lift' is a number, not a text"});
  test::expectRefusal([] { changed(wanting("policy", 1.0)); },
                      {"'policy' is a text, not a number"});
}

TEST(TuningMap, GivesEveryGainOfEveryLawANameOfItsOwn) {
  for (const std::string& law : lawNames()) {
    const std::string file = test::configFile("controller/" + law);
    const YAML::Node tree = loadYamlFile(file);
    const ParameterReader reader(tree, file);
    makeLaw(reader, test::pelican());
    const Config values = valuesOf(reader.schema());
    std::set<std::string> names;
    for (const auto& value : values.doubles) {
      EXPECT_TRUE(names.insert(value.name).second) << law << ": " << value.name;
      const std::optional<YAML::Node> other =
          withValues(tree, reader.schema(), wanting(value.name, 1.001 * value.value));
      ASSERT_TRUE(other.has_value()) << value.name;
      const ParameterReader again(*other, file);
      makeLaw(again, test::pelican());
      EXPECT_EQ(valueOf(valuesOf(again.schema()).doubles, value.name), 1.001 * value.value);
    }
    EXPECT_GT(names.size(), 10u);
  }
}

}  // namespace
}  // namespace aqc
