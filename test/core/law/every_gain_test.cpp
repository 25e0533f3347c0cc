#include <gtest/gtest.h>
#include <yaml-cpp/yaml.h>

#include <functional>
#include <string>
#include <vector>

#include "adaptive_quadrotor_control/law/law_factory.h"
#include "adaptive_quadrotor_control/law/switched/subsystem_switch.h"
#include "adaptive_quadrotor_control/parameters/parameter_reader.h"
#include "support/fixtures.h"

// A gain that is read and then forgotten would look well wherever gains are shown: every number of
// config/controller must change what its law does.
namespace aqc {
namespace {

// Everything a law says in some wild and some calm steps, with switches now too early, now not.
class Diary {
 public:
  explicit Diary(ControlLaw& law) : law_(law) {
    if (law_.subsystems() != nullptr) text_ = law_.subsystems()->text();
    for (int i = 0; i < 600; ++i) {
      if (law_.subsystems() != nullptr && i % 25 == 24) requestSwitch(i);
      step(i);
    }
  }

  bool operator==(const Diary& other) const {
    return text_ == other.text_ && numbers_ == other.numbers_;
  }

 private:
  void requestSwitch(int i) {
    const SwitchVerdict verdict =
        law_.subsystems()->request(1 + dice_.index(3), fromSeconds(0.1 * i));
    numbers_.push_back(static_cast<double>(verdict.outcome));
    numbers_.push_back(toSeconds(verdict.earliest));
  }

  void step(int i) {
    State state = dice_.airborneState();
    SetPoint set_point = dice_.setPoint();
    if (i % 2 == 0) state.attitude = Eigen::Quaterniond(0.999, 0.02, 0.03, 0.01).normalized();
    if (i % 2 == 0) state.body_rate = dice_.vector(0.05);
    set_point.position = state.position + dice_.vector(i % 4 < 2 ? 0.01 : 3.0);
    set_point.velocity = state.velocity + dice_.vector(i % 4 < 2 ? 0.01 : 3.0);
    Sensed sensed = {state};
    if (i % 3 != 0) sensed.specific_force = dice_.vector(20.0);
    const Wrench wrench = test::step(law_, sensed, set_point, 0.01);
    numbers_.insert(numbers_.end(),
                    {wrench.thrust, wrench.moment.x(), wrench.moment.y(), wrench.moment.z()});
    const AdaptiveValues& adaptive = law_.telemetry().adaptive;
    numbers_.insert(numbers_.end(), adaptive.begin(), adaptive.end());
  }

  ControlLaw& law_;
  test::Dice dice_{7};
  std::string text_;
  std::vector<double> numbers_;
};

Diary diary(const YAML::Node& gains) {
  const ParameterReader reader(gains, "gains");
  const auto law = makeLaw(reader, test::pelican());
  reader.finish();
  return Diary(*law);
}

// Calls `visit` with the name of every number and choice below `node`, and the number itself.
void forEachLeaf(const YAML::Node& node, const std::string& name,
                 const std::function<void(const std::string&, YAML::Node)>& visit) {
  if (node.IsScalar()) return visit(name, node);
  std::size_t index = 0;
  for (const auto& entry : node) {
    if (node.IsMap()) {
      forEachLeaf(entry.second, name + "/" + entry.first.as<std::string>(), visit);
    } else {
      forEachLeaf(entry, name + "[" + std::to_string(index++) + "]", visit);
    }
  }
}

// Another value that the law takes.
std::string changed(const std::string& value) {
  if (value == "refuse") return "warn";
  if (value.find_first_of(".e") == std::string::npos) return std::to_string(std::stoi(value) + 1);
  return std::to_string(1.01 * std::stod(value));
}

class EveryGain : public ::testing::TestWithParam<std::string> {};

TEST_P(EveryGain, ChangesWhatTheLawDoes) {
  const YAML::Node gains = loadYamlFile(test::configFile("controller/" + GetParam()));
  const Diary before = diary(gains);
  EXPECT_TRUE(before == diary(gains)) << "the same gains do the same";
  int count = 0;
  forEachLeaf(gains, "", [&](const std::string& name, YAML::Node leaf) {
    if (name == "/law") return;
    const std::string value = leaf.Scalar();
    leaf = changed(value);
    EXPECT_FALSE(before == diary(gains)) << name << ": " << value << " to " << leaf.Scalar();
    leaf = value;
    ++count;
  });
  EXPECT_GT(count, 10);
}

INSTANTIATE_TEST_SUITE_P(Laws, EveryGain, ::testing::ValuesIn(lawNames()),
                         [](const auto& parameter) { return parameter.param; });

}  // namespace
}  // namespace aqc
