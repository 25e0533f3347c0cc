// The targets of fuzz/ without a fuzzer: what the repository has of inputs, and changes of them.

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "fuzz/mutation.h"
#include "fuzz/targets.h"
#include "support/source_tree.h"

namespace aqc {
namespace {

namespace fs = std::filesystem;

constexpr std::uint64_t kMutations = 400;  // of all inputs of a target together

std::vector<std::string> textsOf(const std::string& folder) {
  std::vector<fs::path> paths;
  for (const auto& entry : fs::directory_iterator(test::sourceTree() + "/" + folder)) {
    paths.push_back(entry.path());
  }
  std::sort(paths.begin(), paths.end());
  std::vector<std::string> texts;
  for (const fs::path& path : paths) {
    std::ostringstream text;
    text << std::ifstream(path, std::ios::binary).rdbuf();
    texts.push_back(text.str());
  }
  return texts;
}

class FuzzTest : public ::testing::TestWithParam<fuzz::Target> {
 protected:
  static std::vector<std::string> inputs() {
    std::vector<std::string> inputs = textsOf(std::string("fuzz/corpus/") + GetParam().name);
    if (GetParam().config == nullptr) return inputs;
    for (std::string& text : textsOf(std::string("config/") + GetParam().config)) {
      inputs.push_back(std::move(text));
    }
    return inputs;
  }
};

TEST_P(FuzzTest, FindsNothingInTheCorpus) {
  ASSERT_GT(inputs().size(), 2u);
  for (const std::string& input : inputs()) EXPECT_EQ(GetParam().check(input), "") << input;
}

TEST_P(FuzzTest, FindsNothingInMutations) {
  const std::vector<std::string> inputs = FuzzTest::inputs();
  int tried = 0;
  for (std::uint64_t seed = 0; seed < kMutations; ++seed) {
    const std::string& input = inputs[seed % inputs.size()];
    const std::string mutated = GetParam().config != nullptr ? fuzz::mutatedYaml(input, seed)
                                                             : fuzz::mutatedBytes(input, seed);
    tried += mutated.empty() ? 0 : 1;
    EXPECT_EQ(GetParam().check(mutated), "") << "seed " << seed << " makes\n" << mutated;
  }
  EXPECT_GT(tried, static_cast<int>(kMutations) / 2);
}

INSTANTIATE_TEST_SUITE_P(Targets, FuzzTest, ::testing::ValuesIn(fuzz::kTargets),
                         [](const auto& test) { return std::string(test.param.name); });

}  // namespace
}  // namespace aqc
