#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <regex>
#include <string>

#include "adaptive_quadrotor_control/pilot/guard_rules.h"
#include "support/source_tree.h"

namespace aqc {
namespace {

std::string contents(const std::string& path) {
  std::ifstream file(test::sourceTree() + path);
  return {std::istreambuf_iterator<char>(file), {}};
}

// The table of docs/guard.md must say what the code says, and name a test of each rule.
TEST(GuardTable, OfTheDocumentIsThatOfTheCode) {
  const std::string document = contents("/docs/guard.md");
  const std::string unit_tests = contents("/test/core/pilot/guard_test.cpp");
  const std::regex quoted("`([^`]+)`");
  for (const RuleText& rule : guardRules()) {
    const std::string row =
        std::string("| ") + rule.name + " | " + rule.check + " | " + rule.reaction + " | ";
    const std::size_t at = document.find("\n" + row);
    ASSERT_NE(at, std::string::npos) << "docs/guard.md should hold:\n" << row;
    const std::size_t begin = at + 1 + row.size();
    const std::string tests = document.substr(begin, document.find('\n', begin) - begin);
    std::sregex_iterator name(tests.begin(), tests.end(), quoted);
    ASSERT_NE(name, std::sregex_iterator()) << rule.name << ": no test is named";
    for (; name != std::sregex_iterator(); ++name) {
      const std::string test = (*name)[1];
      const bool flown = std::filesystem::exists(test::sourceTree() + "/test/ros/" + test + "/" +
                                                 test + "_test.py");
      EXPECT_TRUE(flown || unit_tests.find(", " + test + ")") != std::string::npos)
          << rule.name << ": there is no test '" << test << "'";
    }
  }
}

TEST(GuardTable, IsInTheOrderOfItsRules) {
  for (std::size_t i = 0; i < guardRules().size(); ++i) {
    EXPECT_EQ(static_cast<std::size_t>(guardRules()[i].rule), i);
  }
}

}  // namespace
}  // namespace aqc
