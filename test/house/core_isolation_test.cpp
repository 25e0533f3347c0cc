#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <regex>
#include <sstream>
#include <string>
#include <vector>

#include "support/source_tree.h"

// The core is plain C++: no ROS, no clock, no logging, no randomness of its own.
namespace aqc {
namespace {

namespace fs = std::filesystem;

struct Source {
  std::string name;
  std::string code;  // without comments and texts
};

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

/// Every C++ file under include/ and src/ but those in folders of the given names.
std::vector<Source> sources(const std::vector<std::string>& left_out) {
  std::vector<Source> all;
  for (const char* root : {"include", "src"}) {
    const fs::path folder = fs::path(test::sourceTree()) / root;
    for (const fs::directory_entry& entry : fs::recursive_directory_iterator(folder)) {
      const std::string extension = entry.path().extension().string();
      if (extension != ".h" && extension != ".hpp" && extension != ".cpp") continue;
      const fs::path relative = entry.path().lexically_relative(folder);
      bool skipped = false;
      for (const fs::path& part : relative.parent_path()) {
        for (const std::string& name : left_out) skipped = skipped || part == name;
      }
      if (skipped) continue;
      std::ifstream file(entry.path());
      std::ostringstream text;
      text << file.rdbuf();
      all.push_back({std::string(root) + "/" + relative.string(), withoutComments(text.str())});
    }
  }
  return all;
}

void expectNone(const std::vector<Source>& files, const std::string& pattern) {
  const std::regex regex(pattern);
  EXPECT_GT(files.size(), 20u) << "the source tree was not found";
  for (const Source& file : files) {
    std::istringstream lines(file.code);
    std::string line;
    while (std::getline(lines, line)) {
      EXPECT_FALSE(std::regex_search(line, regex)) << file.name << ": " << line;
    }
  }
}

TEST(Core, IncludesNoRos) {
  expectNone(sources({"ros"}),
             R"(#\s*include\s*[<"](ros/|roscpp|tf/|tf2|nodelet|pluginlib|xmlrpcpp|XmlRpc|rosgraph)"
             R"(|catkin|dynamic_reconfigure|diagnostic_updater|[a-z_0-9]*_msgs/|[a-z_0-9]*_srvs/)"
             R"(|adaptive_quadrotor_control/(ros/|[A-Z])))");
  expectNone(sources({"ros"}), R"(\bros::|\bROS_[A-Z]+)");
}

TEST(Core, ReadsNoClock) {
  expectNone(sources({"ros", "apps", "report", "figures"}),
             R"(<chrono>|std::chrono|<ctime>|<time\.h>|<sys/time\.h>|\bgettimeofday\s*\()"
             R"(|\bclock_gettime\s*\(|\bclock\s*\(\s*\)|\b(std::|::)time\s*\()"
             R"(|[^\w.>]time\s*\(\s*(NULL|nullptr|0)\s*\)|\bsleep_for\b|\busleep\s*\()");
}

TEST(Core, PrintsAndLogsNothing) {
  expectNone(
      sources({"ros", "apps", "report", "figures"}),
      R"(<iostream>|<cstdio>.*log|\bstd::(cout|cerr|clog)\b|\b(std::)?(v?f?printf|puts|putchar)"
      R"(|fputs|perror)\s*\(|<syslog\.h>)");
}

TEST(Core, DrawsNoRandomNumbersWithoutASeed) {
  expectNone(sources({"ros", "apps", "report", "figures"}),
             R"(\brandom_device\b|\b(std::)?s?rand\s*\()");
}

TEST(Core, KeepsNoStateInStaticVariables) {
  // static const, constexpr and assert are fine, and so are static member functions.
  expectNone(
      sources({"ros", "apps", "report", "figures"}),
      R"(\bthread_local\b|^\s+static\s+(?!const\b|constexpr\b|inline\b)[\w:<>, ]+\s+\w+\s*(=|;|\{))");
}

}  // namespace
}  // namespace aqc
