#include <gtest/gtest.h>

#include <fstream>
#include <iterator>
#include <string>

#include "adaptive_quadrotor_control/pilot/guard_rules.h"
#include "support/source_tree.h"

namespace aqc {
namespace {

// The table as docs/guard.md shows it.
std::string table() {
  std::string text = "| rule | check | reaction |\n| --- | --- | --- |\n";
  for (const RuleText& rule : guardRules()) {
    text += std::string("| ") + rule.name + " | " + rule.check + " | " + rule.reaction + " |\n";
  }
  return text;
}

TEST(GuardTable, OfTheDocumentIsThatOfTheCode) {
  std::ifstream file(test::sourceTree() + "/docs/guard.md");
  const std::string text{std::istreambuf_iterator<char>(file), {}};
  EXPECT_NE(text.find(table()), std::string::npos) << "docs/guard.md should hold:\n" << table();
}

TEST(GuardTable, IsInTheOrderOfItsRules) {
  for (std::size_t i = 0; i < guardRules().size(); ++i) {
    EXPECT_EQ(static_cast<std::size_t>(guardRules()[i].rule), i);
  }
}

}  // namespace
}  // namespace aqc
