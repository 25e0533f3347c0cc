#include "adaptive_quadrotor_control/parameters/parameter_reader.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <fstream>
#include <functional>

#include "support/refusal.h"

namespace aqc {
namespace {

using test::expectRefusal;
using test::readerOf;
using test::replaced;

TEST(ParameterReader, ReadsEveryKindOfValue) {
  const ParameterReader reader = readerOf(R"(
number: 1.5e-3
count: 4
flag: true
text: some words
list: [1, 2.5, -3]
words: [one, two]
inner: {depth: 7}
entries: [{a: 1}, {a: 2}]
)",
                                          "top");
  EXPECT_EQ(reader.number("number", Range::positive()), 1.5e-3);
  EXPECT_EQ(reader.integer("count", 0, 10), 4);
  EXPECT_TRUE(reader.flag("flag", false));
  EXPECT_EQ(reader.text("text"), "some words");
  EXPECT_EQ(reader.numbers("list", 0, Range::any()), (std::vector<double>{1.0, 2.5, -3.0}));
  EXPECT_EQ(reader.vector3("list", Range::any()), Eigen::Vector3d(1.0, 2.5, -3.0));
  EXPECT_EQ(reader.texts("words"), (std::vector<std::string>{"one", "two"}));
  EXPECT_EQ(reader.child("inner").number("depth", Range::any()), 7.0);
  const auto entries = reader.children("entries");
  ASSERT_EQ(entries.size(), 2u);
  EXPECT_EQ(entries[0].number("a", Range::any()), 1.0);
  EXPECT_EQ(entries[1].number("a", Range::any()), 2.0);
  EXPECT_NO_THROW(reader.finish());
  EXPECT_TRUE(reader.has("number"));
  EXPECT_FALSE(reader.has("nothing"));
  EXPECT_EQ(reader.keys().front(), "number");
}

TEST(ParameterReader, FallsBackOnlyWhereAFallbackIsGiven) {
  const ParameterReader reader = readerOf("{a: 1}", "");
  EXPECT_EQ(reader.number("b", Range::positive(), 2.0), 2.0);
  EXPECT_EQ(reader.text("c", "word"), "word");
  EXPECT_TRUE(reader.flag("d", true));
  EXPECT_EQ(reader.vector3("e", Range::any(), {1, 2, 3}), Eigen::Vector3d(1, 2, 3));
  expectRefusal([&] { reader.number("b", Range::positive()); },
                {"'b'", "missing", "a finite number > 0"});
}

TEST(ParameterReader, RefusesWhatIsMissing) {
  const ParameterReader reader = readerOf("{inner: {a: ~}}", "file");
  expectRefusal([&] { reader.number("mass", Range::positive()); },
                {"'file/mass'", "missing", "a finite number > 0"});
  expectRefusal([&] { reader.child("inner").number("a", Range::any()); },
                {"'file/inner/a'", "missing"});
  expectRefusal([&] { reader.child("other"); }, {"'file/other'", "missing"});
  expectRefusal([&] { reader.text("name"); }, {"'file/name'", "missing"});
  expectRefusal([&] { reader.texts("names"); }, {"'file/names'", "missing"});
  expectRefusal([&] { reader.children("list"); }, {"'file/list'", "missing"});
  expectRefusal([&] { reader.numbers("list", 3, Range::any()); }, {"'file/list'", "3 numbers"});
}

TEST(ParameterReader, RefusesNumbersThatAreNotFinite) {
  for (const char* value : {".nan", ".inf", "-.inf", ".NaN"}) {
    const ParameterReader reader = readerOf(std::string("{a: ") + value + "}", "x");
    for (const Range& range : {Range::any(), Range::positive(), Range::nonNegative()}) {
      expectRefusal([&] { reader.number("a", range); }, {"'x/a'", value, "a finite number"});
    }
    expectRefusal([&] { reader.number("a", Range::any(), 1.0); }, {"'x/a'", value});
  }
}

TEST(ParameterReader, RefusesNumbersOutOfRangeAndNamesTheRange) {
  const ParameterReader reader = readerOf("{a: 0, b: -2.5, c: 11, d: [1, 2, -3]}", "x");
  expectRefusal([&] { reader.number("a", Range::positive()); },
                {"'x/a'", "'0'", "a finite number > 0"});
  EXPECT_EQ(reader.number("a", Range::nonNegative()), 0.0);
  expectRefusal([&] { reader.number("b", Range::nonNegative()); }, {"'x/b'", "'-2.5'", ">= 0"});
  expectRefusal([&] { reader.number("c", Range::between(-1, 10)); },
                {"'x/c'", "'11'", ">= -1 and <= 10"});
  expectRefusal([&] { reader.number("c", Range::positiveUpTo(10)); }, {"'x/c'", "> 0 and <= 10"});
  expectRefusal([&] { reader.vector3("d", Range::positive()); }, {"'x/d[2]'", "'-3'", "> 0"});
  expectRefusal([&] { reader.integer("c", 0, 10); }, {"'x/c'", "<= 10"});
}

TEST(ParameterReader, RefusesWhatIsOfAnotherType) {
  const ParameterReader reader =
      readerOf("{a: heavy, b: [1, 2], c: {d: 1}, e: 1.5, f: [1, two, 3], g: 3}", "x");
  expectRefusal([&] { reader.number("a", Range::any()); }, {"'x/a'", "'heavy'", "finite number"});
  expectRefusal([&] { reader.number("b", Range::any()); }, {"'x/b'", "[1, 2]", "finite number"});
  expectRefusal([&] { reader.text("c"); }, {"'x/c'", "a text"});
  expectRefusal([&] { reader.integer("e", 0, 5); }, {"'x/e'", "1.5", "whole number"});
  expectRefusal([&] { reader.flag("a", true); }, {"'x/a'", "'heavy'", "true or false"});
  expectRefusal([&] { reader.vector3("b", Range::any()); }, {"'x/b'", "[1, 2]", "3 numbers"});
  expectRefusal([&] { reader.vector3("f", Range::any()); }, {"'x/f[1]'", "'two'"});
  expectRefusal([&] { reader.vector3("g", Range::any()); }, {"'x/g'", "'3'", "3 numbers"});
  expectRefusal([&] { reader.child("a"); }, {"'x/a'", "'heavy'", "a map"});
  expectRefusal([&] { reader.children("c"); }, {"'x/c'", "a list of maps"});
  expectRefusal([&] { reader.children("b"); }, {"'x/b[0]'", "'1'", "a map"});
  expectRefusal([&] { reader.texts("a"); }, {"'x/a'", "a list of texts"});
}

TEST(ParameterReader, RefusesWordsThatAreNotAllowed) {
  const ParameterReader reader = readerOf("{law: magic}", "x");
  expectRefusal(
      [&] {
        reader.choice("law", {"asmc", "smc"});
      },
      {"'x/law'", "'magic'", "one of asmc, smc"});
}

TEST(ParameterReader, RefusesNamesThatNobodyAskedFor) {
  const ParameterReader reader = readerOf("{a: 1, inner: {b: 2, mispelt: 3}}", "x");
  reader.number("a", Range::any());
  expectRefusal([&] { reader.finish(); }, {"'x/inner'", "unknown"});
  reader.child("inner").number("b", Range::any());
  expectRefusal([&] { reader.finish(); }, {"'x/inner/mispelt'", "unknown"});
  reader.child("inner").number("mispelt", Range::any());
  EXPECT_NO_THROW(reader.finish());
}

TEST(ParameterReader, RefusesUnknownNamesInsideLists) {
  const ParameterReader reader = readerOf("{list: [{a: 1}, {a: 2, b: 3}]}", "x");
  for (const ParameterReader& entry : reader.children("list")) entry.number("a", Range::any());
  expectRefusal([&] { reader.finish(); }, {"'x/list[1]/b'", "unknown"});
}

TEST(ParameterReader, RefusesNamesGivenTwice) {
  const ParameterReader reader = readerOf("{a: 1, a: 2}", "x");
  reader.number("a", Range::any());
  expectRefusal([&] { reader.finish(); }, {"'x/a'", "twice"});
}

TEST(ParameterReader, RefusesKeysThatAreNoTexts) {
  const ParameterReader reader = readerOf("{inner: {[1, 2]: 3}}", "x");
  const ParameterReader inner = reader.child("inner");
  expectRefusal([&] { reader.finish(); }, {"'x/inner'", "[1, 2]", "a text"});
  expectRefusal([&] { inner.keys(); }, {"'x/inner'", "[1, 2]", "a text"});
}

TEST(ParameterReader, ReadsPositiveDefiniteMatrices) {
  const ParameterReader reader = readerOf(
      "{a: [1, 2, 3], b: [2, 2, 2, 1, 0, -1], c: [1, 1, 1, 2, 0, 0], d: [1, 0, 1],"
      " e: [1, 2], f: [1, .nan, 2], g: [-1, -1, -1]}",
      "x");
  EXPECT_EQ(reader.positiveDefinite("a").diagonal(), Eigen::Vector3d(1, 2, 3));
  const Eigen::Matrix3d b = reader.positiveDefinite("b");
  EXPECT_EQ(b(0, 1), 1.0);
  EXPECT_EQ(b(0, 2), 0.0);
  EXPECT_EQ(b(1, 2), -1.0);
  EXPECT_EQ(b, b.transpose());
  expectRefusal([&] { reader.positiveDefinite("c"); }, {"'x/c'", "-1", "positive definite"});
  expectRefusal([&] { reader.positiveDefinite("d"); }, {"'x/d'", "positive definite"});
  expectRefusal([&] { reader.positiveDefinite("e"); }, {"'x/e'", "2 numbers", "[xx, yy, zz]"});
  expectRefusal([&] { reader.positiveDefinite("f"); }, {"'x/f[1]'", ".nan", "finite"});
  expectRefusal([&] { reader.positiveDefinite("g"); }, {"'x/g'", "positive definite"});
}

TEST(ParameterReader, TurnsDegreesIntoRadians) {
  const ParameterReader reader = readerOf("{a_deg: 180, list_deg: [0, -90], b_deg: 91}", "x");
  const Range range = Range::between(-180.0, 180.0);
  EXPECT_EQ(reader.angle("a_deg", range), M_PI);
  EXPECT_EQ(reader.angle("a_deg", range, 1.0), M_PI);
  EXPECT_EQ(reader.angle("c_deg", range, 1.0), 1.0) << "the fallback is in radians";
  EXPECT_EQ(reader.angles("list_deg", range), (std::vector<double>{0.0, -M_PI_2}));
  expectRefusal([&] { reader.angle("b_deg", Range::positiveUpTo(90.0)); },
                {"'x/b_deg'", "'91'", "<= 90"});
  expectRefusal([&] { reader.angle("c_deg", range); }, {"'x/c_deg'", "missing"});
}

TEST(ParameterReader, RefusesForItsCallers) {
  const ParameterReader reader = readerOf("{a: 0.50, list: [1, 2], inner: {b: 1}}", "x");
  expectRefusal([&] { reader.refuse("a", "is odd"); }, {"parameter 'x/a' is odd"});
  expectRefusal([&] { reader.refuseValue("a", "> 1"); },
                {"parameter 'x/a' is '0.50'; it must be > 1"});
  expectRefusal([&] { reader.refuseValue("list", "longer"); }, {"'x/list' is [1, 2]; it must be"});
  expectRefusal([&] { reader.child("inner").refuseValue("c", "there"); },
                {"'x/inner/c' is nothing; it must be there"});
  EXPECT_NO_THROW(reader.requirePositiveDefinite("list", Eigen::Matrix2d::Identity()));
  expectRefusal([&] { reader.requirePositiveDefinite("list", -Eigen::Matrix2d::Identity()); },
                {"'x/list' is [1, 2]", "eigenvalue is -1", "positive definite"});
}

TEST(ParameterReader, PrintsNumbersAsAPersonWould) {
  EXPECT_EQ(numberText(0.1), "0.1");
  EXPECT_EQ(numberText(1234567.891), "1234567.891");
  EXPECT_EQ(numberText(-2.5e-7), "-2.5e-07");
  EXPECT_EQ(numberText(0.1 + 0.2), "0.3") << "no noise";
}

TEST(ParameterReader, SkipsWhatSomebodyElseReads) {
  const std::string yaml = "a: {b: 1, c: [{d: 2}, {e: {f: 3}}], g: [1, 2]}\nh: 4\n";
  const ParameterReader reader = test::readerOf(yaml, "tree");
  reader.skip("a");
  reader.skip("z");  // not there
  expectRefusal([&] { reader.finish(); }, {"'tree/h'", "unknown"});
  reader.skip("h");
  EXPECT_NO_THROW(reader.finish());
}

class YamlFile : public ::testing::Test {
 protected:
  void TearDown() override { std::remove(path_.c_str()); }
  const std::string& holding(const std::string& text) {
    std::ofstream(path_) << text;
    return path_;
  }
  const std::string path_ = ::testing::TempDir() + "aqc_parameter_reader_test.yaml";
};

TEST_F(YamlFile, IsRefusedWhenItCannotBeRead) {
  expectRefusal([] { loadYamlFile("/nowhere/at/all.yaml"); },
                {"'/nowhere/at/all.yaml'", "cannot be read"});
  const std::string folder = ::testing::TempDir();
  expectRefusal([&] { loadYamlFile(folder); }, {folder, "cannot be read"});
}

TEST_F(YamlFile, IsRefusedWhenItIsEmpty) {
  expectRefusal([&] { loadYamlFile(holding("")); }, {path_, "empty"});
  expectRefusal([&] { loadYamlFile(holding("# only a comment\n")); }, {path_, "map"});
}

TEST_F(YamlFile, IsRefusedWhenItIsNotAMap) {
  expectRefusal([&] { loadYamlFile(holding("[1, 2]")); }, {path_, "map"});
  expectRefusal([&] { loadYamlFile(holding("word")); }, {path_, "map"});
}

TEST_F(YamlFile, IsRefusedWithTheLineWhereItBreaks) {
  expectRefusal([&] { loadYamlFile(holding("a: 1\nb: [1, 2\nc: 3\n")); },
                {path_, "not YAML", "line "});
  expectRefusal([&] { loadYamlFile(holding("a: 1\n  b: 2\n")); }, {path_, "not YAML", "line 2"});
}

TEST_F(YamlFile, IsReadWhenItHoldsAMap) {
  EXPECT_EQ(loadYamlFile(holding("a: 1\n"))["a"].as<int>(), 1);
}

// Nine lines of ten aliases each are 1e9 values: whoever walks them does not come back.
TEST(ParameterReader, RefusesAliasesThatMultiply) {
  std::string bomb = "a0: &a0 [1, 1, 1, 1, 1, 1, 1, 1, 1, 1]\n";
  for (int i = 1; i <= 9; ++i) {
    const std::string inner = "*a" + std::to_string(i - 1);
    std::string line = "a" + std::to_string(i) + ": &a" + std::to_string(i) + " [" + inner;
    for (int k = 1; k < 10; ++k) line += ", " + inner;
    bomb += line + "]\n";
  }
  expectRefusal([&] { readerOf(bomb, "file"); },
                {"'file' has more than 200000 values; aliases may multiply them"});
}

TEST(ParameterReader, RefusesAliasesWithinTheirOwnAnchor) {
  for (const char* cycle : {"a: &a [*a]", "a: &a {b: *a}", "a: &a {b: [1, {c: *a}]}"}) {
    expectRefusal([&] { readerOf(cycle, "file"); }, {"'file' is nested deeper than 32 levels"});
  }
}

TEST(ParameterReader, TakesAnchorsThatSaveTyping) {
  const ParameterReader reader = readerOf("a: &a {x: 1}\nb: *a", "file");
  EXPECT_EQ(reader.child("b").number("x", Range::any()), 1.0);
}

TEST(ParameterReader, CutsValuesBeyond120Characters) {
  const std::string longest = "[" + std::string(115, '1') + ", 1]";
  ASSERT_EQ(longest.size(), 120u);
  EXPECT_EQ(readerOf("x: " + longest, "tree").valueText("x"), longest);
  EXPECT_EQ(readerOf("x: " + replaced(longest, " 1]", " 12]"), "tree").valueText("x"),
            replaced(longest, " 1]", " 12") + " ...");
}

}  // namespace
}  // namespace aqc
