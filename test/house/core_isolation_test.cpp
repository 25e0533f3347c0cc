#include <gtest/gtest.h>

#include <regex>
#include <sstream>
#include <string>
#include <vector>

#include "house/sources.h"

// The core is plain C++: no ROS, no clock, no logging, no randomness of its own.
namespace aqc {
namespace {

using test::Source;
using test::sources;

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
