#include "house/sources.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "support/source_tree.h"

namespace aqc::test {
namespace {

namespace fs = std::filesystem;

std::string withoutComments(const std::string& text) {
  std::string code;
  for (std::size_t i = 0; i < text.size();) {
    if (text.compare(i, 2, "//") == 0) {
      i = std::min(text.find('\n', i), text.size());
    } else if (text.compare(i, 2, "/*") == 0) {
      const std::size_t end = text.find("*/", i + 2);
      i = end == std::string::npos ? text.size() : end + 2;
    } else {
      code += text[i++];
    }
  }
  return code;
}

bool isCpp(const fs::path& path) {
  const std::string extension = path.extension().string();
  return extension == ".h" || extension == ".hpp" || extension == ".cpp";
}

}  // namespace

std::string textOf(const std::string& name) {
  std::ifstream file(fs::path(sourceTree()) / name);
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

std::vector<Source> sources(const std::vector<std::string>& left_out) {
  const auto skipped = [&](const fs::path& folder) {
    return std::any_of(folder.begin(), folder.end(), [&](const fs::path& part) {
      return std::find(left_out.begin(), left_out.end(), part) != left_out.end();
    });
  };
  std::vector<Source> all;
  const fs::path root = sourceTree();
  for (const char* top : {"include", "src"}) {
    for (const fs::directory_entry& entry : fs::recursive_directory_iterator(root / top)) {
      const fs::path relative = entry.path().lexically_relative(root);
      if (!isCpp(relative) || skipped(relative.parent_path())) continue;
      all.push_back({relative.string(), withoutComments(textOf(relative.string()))});
    }
  }
  return all;
}

namespace {

TEST(Sources, AreAllThereWithoutTheirComments) {
  const std::vector<Source> all = sources();
  EXPECT_GT(all.size(), 100u) << "the source tree was not found";
  for (const Source& source : all) EXPECT_EQ(source.code.find("//"), std::string::npos);
  EXPECT_LT(sources({"ros"}).size(), all.size());
}

}  // namespace
}  // namespace aqc::test
