#include "adaptive_quadrotor_control/parameters/schema.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "support/refusal.h"

namespace aqc {
namespace {

using test::readerOf;
using Kind = Parameter::Kind;

constexpr double kUnbounded = std::numeric_limits<double>::infinity();

const Parameter& find(const Schema& schema, const std::string& key) {
  const auto found = std::find_if(schema.begin(), schema.end(), [&](const Parameter& parameter) {
    return parameter.key.name == key;
  });
  if (found == schema.end()) throw std::out_of_range("the schema has no '" + key + "'");
  return *found;
}

std::vector<std::string> keysOf(const Schema& schema) {
  std::vector<std::string> keys;
  for (const Parameter& parameter : schema) keys.push_back(parameter.key.name);
  return keys;
}

// What a law does: every gain is declared where it is read.
Schema readToy() {
  const ParameterReader reader = readerOf(
      "{inner: {slope: [1, 2, 3]}, parts: [{leak: [4, 5]}, {leak: [6]}], count: 7, calm: true}",
      "file.yaml");
  reader.child("inner").vector3({"slope", "Phi", "1/s", "how fast it decays"}, Range::positive());
  for (const ParameterReader& part : reader.children("parts")) {
    part.numbers({"leak", "alpha", "1/s", "forgetting"}, 0, Range::nonNegative());
  }
  reader.integer({"count", "N", "", "how many"}, 1, 9);
  reader.flag({"calm", "", "", "whether it is calm"}, false);
  reader.finish();
  return reader.schema();
}

TEST(Schema, HoldsWhatWasReadInThatOrder) {
  EXPECT_EQ(keysOf(readToy()), (std::vector<std::string>{"inner/slope", "parts[0]/leak",
                                                         "parts[1]/leak", "count", "calm"}));
}

TEST(Schema, KnowsRangeShapeAndValueOfEach) {
  const Schema schema = readToy();
  const Parameter& slope = find(schema, "inner/slope");
  EXPECT_EQ(slope.kind, Kind::kNumbers);
  EXPECT_EQ(slope.numbers, (std::vector<double>{1.0, 2.0, 3.0}));
  EXPECT_EQ(slope.key.entries, (std::vector<std::string>{"x", "y", "z"}));
  EXPECT_EQ(slope.range.min, 0.0);
  EXPECT_TRUE(slope.range.exclusive_min);
  EXPECT_EQ(slope.range.max, kUnbounded);
  const Parameter& leak = find(schema, "parts[0]/leak");
  EXPECT_EQ(leak.key.entries, (std::vector<std::string>{"0", "1"}));
  EXPECT_FALSE(leak.range.exclusive_min);
  EXPECT_EQ(find(schema, "parts[1]/leak").numbers, std::vector<double>{6.0});
  const Parameter& count = find(schema, "count");
  EXPECT_EQ(count.kind, Kind::kInteger);
  EXPECT_EQ(count.numbers, std::vector<double>{7.0});
  EXPECT_EQ(count.range.min, 1.0);
  EXPECT_EQ(count.range.max, 9.0);
  EXPECT_EQ(find(schema, "calm").kind, Kind::kFlag);
  EXPECT_EQ(find(schema, "calm").numbers, std::vector<double>{1.0});
}

TEST(Schema, TellsAPersonWhatEachIs) {
  const Schema schema = readToy();
  EXPECT_EQ(find(schema, "inner/slope").text(), "Phi [1/s]: how fast it decays");
  EXPECT_EQ(find(schema, "count").text(), "N: how many");
  EXPECT_EQ(find(schema, "calm").text(), "whether it is calm");
  const auto text = [](const ParameterKey& key) {
    return Parameter{key, Kind::kNumber, {}, {}, {}, {}}.text();
  };
  EXPECT_EQ(text({"a", "", "m", "height"}), "height [m]");
  EXPECT_EQ(text({"a", "h", "m", ""}), "h [m]");
  EXPECT_EQ(text({"a", "", "m", ""}), "[m]");
  EXPECT_EQ(text("a"), "");
}

TEST(Schema, HoldsTextsAndWhatTheyMayBe) {
  const ParameterReader reader = readerOf("{policy: warn, name: some, words: [a, b]}", "");
  reader.choice("policy", {"refuse", "warn"});
  reader.text("name");
  reader.texts("words");
  EXPECT_EQ(keysOf(reader.schema()), (std::vector<std::string>{"policy", "name", "words"}));
  const Parameter& policy = find(reader.schema(), "policy");
  EXPECT_EQ(policy.kind, Kind::kText);
  EXPECT_EQ(policy.texts, std::vector<std::string>{"warn"});
  EXPECT_EQ(policy.choices, (std::vector<std::string>{"refuse", "warn"}));
  EXPECT_EQ(find(reader.schema(), "name").texts, std::vector<std::string>{"some"});
  EXPECT_TRUE(find(reader.schema(), "name").choices.empty());
  EXPECT_EQ(find(reader.schema(), "words").kind, Kind::kTexts);
  EXPECT_EQ(find(reader.schema(), "words").texts, (std::vector<std::string>{"a", "b"}));
}

TEST(Schema, HoldsTheFallbackOfWhatIsMissing) {
  const ParameterReader reader = readerOf("{}", "x");
  reader.number("a", Range::positive(), 2.0);
  reader.text("b", "word");
  reader.flag("c", true);
  reader.vector3("d", Range::any(), {1.0, 2.0, 3.0});
  EXPECT_EQ(find(reader.schema(), "a").numbers, std::vector<double>{2.0});
  EXPECT_EQ(find(reader.schema(), "b").texts, std::vector<std::string>{"word"});
  EXPECT_EQ(find(reader.schema(), "c").numbers, std::vector<double>{1.0});
  EXPECT_EQ(find(reader.schema(), "d").numbers, (std::vector<double>{1.0, 2.0, 3.0}));
  EXPECT_EQ(find(reader.schema(), "d").key.entries, (std::vector<std::string>{"x", "y", "z"}));
}

TEST(Schema, HoldsAnglesAsTheFileHasThem) {
  const ParameterReader reader = readerOf("{a_deg: 90, list_deg: [30, 45]}", "x");
  const Range range = Range::between(-180.0, 180.0);
  reader.angle("a_deg", range);
  reader.angle("b_deg", range, M_PI);
  reader.angles("list_deg", range);
  const Parameter& angle = find(reader.schema(), "a_deg");
  EXPECT_EQ(angle.numbers, std::vector<double>{90.0});
  EXPECT_EQ(angle.range.max, 180.0);
  EXPECT_EQ(angle.text(), "[deg]");
  EXPECT_EQ(find(reader.schema(), "b_deg").numbers, std::vector<double>{180.0});
  EXPECT_EQ(find(reader.schema(), "list_deg").numbers, (std::vector<double>{30.0, 45.0}));
}

TEST(Schema, NamesTheEntriesOfAMatrix) {
  const ParameterReader reader = readerOf("{a: [1, 2, 3], b: [2, 2, 2, 1, 0, -1]}", "x");
  reader.positiveDefinite({"a", "J", "kg m^2", "inertia"});
  reader.positiveDefinite("b");
  const Parameter& diagonal = find(reader.schema(), "a");
  EXPECT_EQ(diagonal.key.entries, (std::vector<std::string>{"x", "y", "z"}));
  EXPECT_EQ(diagonal.key.unit, "kg m^2");
  EXPECT_TRUE(diagonal.range.exclusive_min) << "of a positive definite diagonal";
  const Parameter& full = find(reader.schema(), "b");
  EXPECT_EQ(full.key.entries, (std::vector<std::string>{"x", "y", "z", "xy", "xz", "yz"}));
  EXPECT_TRUE(full.range.contains(-1.0));
}

TEST(Schema, TakesTheEntriesOfItsGetterWhenTheyAreAsMany) {
  const ParameterReader reader = readerOf("{a: [1, 2], b: [1, 2, 3], c: [1, 2, 3]}", "x");
  const std::vector<std::string> entries = {"left", "right"};
  reader.numbers({"a", "", "", "", entries}, 0, Range::any());
  reader.numbers({"b", "", "", "", entries}, 0, Range::any());
  reader.vector3({"c", "", "", "", {"roll", "pitch", "yaw"}}, Range::any());
  EXPECT_EQ(find(reader.schema(), "a").key.entries, entries);
  EXPECT_EQ(find(reader.schema(), "b").key.entries, (std::vector<std::string>{"0", "1", "2"}));
  EXPECT_EQ(find(reader.schema(), "c").key.entries,
            (std::vector<std::string>{"roll", "pitch", "yaw"}));
}

TEST(Schema, HoldsWhatIsReadTwiceOnceAsItWasReadLast) {
  const ParameterReader reader = readerOf("{a: 2, b: 3}", "");
  reader.number("a", Range::any());
  reader.number("b", Range::any());
  reader.integer({"a", "n", "", ""}, 0, 5);
  EXPECT_EQ(keysOf(reader.schema()), (std::vector<std::string>{"a", "b"}));
  EXPECT_EQ(find(reader.schema(), "a").kind, Kind::kInteger);
  EXPECT_EQ(find(reader.schema(), "a").key.symbol, "n");
}

TEST(Schema, HoldsNothingThatWasRefused) {
  const ParameterReader reader = readerOf("{a: -1}", "x");
  test::expectRefusal([&] { reader.number("a", Range::positive()); }, {"'x/a'"});
  EXPECT_TRUE(reader.schema().empty());
  EXPECT_TRUE(reader.has("a"));
  EXPECT_TRUE(reader.schema().empty()) << "has() declares nothing";
}

}  // namespace
}  // namespace aqc
