#include <gtest/gtest.h>
#include <yaml-cpp/yaml.h>

#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "adaptive_quadrotor_control/law/law_factory.h"
#include "adaptive_quadrotor_control/parameters/parameter_reader.h"
#include "support/fixtures.h"

// A law says of every gain what it is, which every client of dynamic_reconfigure shows; the
// comments of config/controller say it, too, for people. They must not say anything else.
namespace aqc {
namespace {

// The line that holds the value of a path like "subsystems[0]/leak"; from 0.
std::size_t lineOf(const YAML::Node& node, std::string path) {
  for (char& letter : path) {
    if (std::string("[]/").find(letter) != std::string::npos) letter = ' ';
  }
  std::istringstream steps(path);
  YAML::Node place(node);
  for (std::string step; steps >> step;) {
    place.reset(place.IsSequence() ? place[std::stoul(step)] : place[step]);
  }
  return static_cast<std::size_t>(place.Mark().line);
}

std::vector<std::string> linesOf(const std::string& path) {
  std::ifstream file(path);
  std::vector<std::string> lines;
  for (std::string line; std::getline(file, line);) lines.push_back(line);
  return lines;
}

class GainWords : public ::testing::TestWithParam<std::string> {};

TEST_P(GainWords, AreThoseOfTheComments) {
  const std::string path = test::configFile("controller/" + GetParam());
  const std::vector<std::string> lines = linesOf(path);
  const YAML::Node gains = loadYamlFile(path);
  const ParameterReader reader(gains, "");
  makeLaw(reader, test::pelican());
  for (const Parameter& gain : reader.schema()) {
    if (gain.key.name == "law") continue;
    EXPECT_NE(gain.key.description, "") << gain.key.name;
    const std::string& line = lines.at(lineOf(gains, gain.key.name));
    const std::size_t comment = line.find('#');
    if (comment == std::string::npos && gain.key.name.find('[') != std::string::npos) {
      continue;  // what a list repeats need not be said again
    }
    ASSERT_NE(comment, std::string::npos) << line;
    EXPECT_NE(line.find(gain.key.symbol, comment), std::string::npos) << gain.text() << "\n"
                                                                      << line;
    EXPECT_NE(line.find(gain.key.unit, comment), std::string::npos) << gain.text() << "\n" << line;
  }
}

INSTANTIATE_TEST_SUITE_P(Laws, GainWords, ::testing::ValuesIn(lawNames()),
                         [](const auto& parameter) { return parameter.param; });

}  // namespace
}  // namespace aqc
