#include <gtest/gtest.h>
#include <yaml-cpp/yaml.h>

#include <memory>
#include <string>
#include <vector>

#include "adaptive_quadrotor_control/law/law_factory.h"
#include "adaptive_quadrotor_control/law/switched/subsystem_switch.h"
#include "adaptive_quadrotor_control/parameters/parameter_reader.h"
#include "support/fixtures.h"
#include "support/leaves.h"
#include "support/refusal.h"

// A gain that is read and then forgotten would look well wherever gains are shown: every number of
// config/controller must change what its law does.
namespace aqc {
namespace {

// Everything a law says in some wild and some calm steps, with switches now too early, now not.
class Diary {
 public:
  explicit Diary(ControlLaw& law) : law_(law) {
    if (law_.subsystems() != nullptr) text_ = law_.subsystems()->text();
    numbers_.push_back(law_.rotorLead());
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
    if (i % 7 == 6) set_point.acceleration.z() -= 15.0;  // asks for less lift than none
    Sensed sensed = {state};
    if (i % 5 < 3) sensed.specific_force = dice_.vector(20.0);
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

std::unique_ptr<ControlLaw> made(const YAML::Node& gains) {
  const ParameterReader reader(gains, "gains");
  std::unique_ptr<ControlLaw> law = makeLaw(reader, test::pelican());
  reader.finish();
  return law;
}

Diary diary(const YAML::Node& gains) {
  return Diary(*made(gains));
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
  test::forEachLeaf(gains, "", [&](const std::string& name, YAML::Node leaf) {
    if (name == "/law") return;
    const std::string value = leaf.Scalar();
    leaf = changed(value);
    EXPECT_FALSE(before == diary(gains)) << name << ": " << value << " to " << leaf.Scalar();
    leaf = value;
    ++count;
  });
  EXPECT_GT(count, 10);
}

// With the options of laws that have them.
YAML::Node allGains(const std::string& law) {
  YAML::Node gains = loadYamlFile(test::configFile("controller/" + law));
  if (law == "asmc") {
    gains["position"]["most_gains"] = YAML::Load("[20.0, 20.0]");
    gains["position"]["most_force"] = 20.0;
    gains["mass_estimate"]["most"] = 4.0;
    gains["attitude"]["most_gains"] = YAML::Load("[1.0, 1.0, 1.0]");
    gains["attitude"]["most_moment"] = 0.3;
  } else if (law == "switched") {
    gains["subsystems"][0]["most_theta"] = YAML::Load("[1e3, 1e3, 1e3, 1e3]");
    gains["dwell_time"] = 1000.0;
  }
  return gains;
}

TEST_P(EveryGain, IsRefusedByNameWhenItIsAbsurd) {
  YAML::Node gains = allGains(GetParam());
  made(gains);
  test::forEachNumber(gains, "gains", [&](const std::string& name, YAML::Node leaf) {
    const std::string value = leaf.Scalar();
    for (const char* absurd : {"1e300", "1e12"}) {
      leaf = absurd;
      test::expectRefusal([&] { made(gains); }, {"'" + name + "'", absurd});
    }
    leaf = value;
  });
}

// Vehicles far heavier than those of config/ ask for larger gains.
TEST_P(EveryGain, MayBeTwentyTimesWhatShipped) {
  YAML::Node gains = allGains(GetParam());
  test::forEachNumber(gains, "gains", [&](const std::string& name, YAML::Node leaf) {
    for (const char* bounded : {"max_tilt_deg", "kappa_ratio", "initial_subsystem"}) {
      if (name.find(bounded) != std::string::npos) return;
    }
    const std::string value = leaf.Scalar();
    leaf = std::to_string(20.0 * std::stod(value));
    EXPECT_NO_THROW(made(gains)) << name << " " << leaf.Scalar();
    leaf = value;
  });
}

INSTANTIATE_TEST_SUITE_P(Laws, EveryGain, ::testing::ValuesIn(lawNames()),
                         [](const auto& parameter) { return parameter.param; });

}  // namespace
}  // namespace aqc
