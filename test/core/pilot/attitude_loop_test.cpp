#include "adaptive_quadrotor_control/pilot/attitude_loop.h"

#include <gtest/gtest.h>
#include <yaml-cpp/yaml.h>

#include <string>

#include "adaptive_quadrotor_control/parameters/parameter_reader.h"
#include "support/guarded_flight.h"

namespace aqc {
namespace {

constexpr double kPeriod = 0.004;

std::unique_ptr<ControlLaw> lawWith(const YAML::Node& gains) {
  return makeLaw(ParameterReader(gains, "gains"), test::pelican());
}

YAML::Node gainsOf(const std::string& law) {
  return loadYamlFile(test::configFile("controller/" + law));
}

const char* judged(const ControlLaw& law, double lag = 0.0125) {
  return unstableAxis(law, test::pelican().inertia.diagonal(), lag, kPeriod);
}

TEST(AttitudeLoop, OfEveryLawAsItIsFlownIsStable) {
  for (const std::string& name : lawNames()) {
    EXPECT_EQ(judged(*test::lawNamed(name, test::pelican())), nullptr) << name;
  }
}

// J lag s^3 + J s^2 + k_omega s + k_R has roots to the right when k_R > k_omega / lag, here 17.6;
// the hold of half a step makes it less.
TEST(AttitudeLoop, OfTheGeometricLawHasTheLimitOfRouthAndHurwitz) {
  YAML::Node gains = gainsOf("geometric");
  const auto judgedWith = [&](double attitude_gain) {
    gains["attitude_gain"][1] = attitude_gain;
    return std::string(judged(*lawWith(gains)) == nullptr ? "" : judged(*lawWith(gains)));
  };
  EXPECT_EQ(judgedWith(14.0), "");
  EXPECT_EQ(judgedWith(17.6), "y");
  EXPECT_EQ(judgedWith(50.0), "y");
}

// Rate alone: a gain of 2 J / T = 5 turns every error round within a step, without lag.
TEST(AttitudeLoop, OfASampledLawHasAGreatestRateGain) {
  YAML::Node gains = gainsOf("geometric");
  gains["attitude_gain"][0] = 1e-9;
  gains["rate_gain"][0] = 4.99;
  EXPECT_EQ(judged(*lawWith(gains), 0.0), nullptr);
  gains["rate_gain"][0] = 5.01;
  EXPECT_STREQ(judged(*lawWith(gains), 0.0), "x");
}

TEST(AttitudeLoop, GainsThatMakeItUnstableAreRefusedInFlight) {
  test::GuardedFlight flight;
  YAML::Node gains = gainsOf("asmc");
  for (int i = 0; i < 3; ++i) gains["attitude"]["gain"][i] = 50.0;
  std::unique_ptr<ControlLaw> law = lawWith(gains);
  flight.takeOff();
  EXPECT_NE(flight.pilot().handOver(law).find("attitude loop about x"), std::string::npos);
  flight.fly(1.0);
  EXPECT_EQ(flight.mode(), Mode::kHolding);
  law = lawWith(gainsOf("asmc"));
  EXPECT_EQ(flight.pilot().handOver(law), "");
}

TEST(AttitudeLoop, GainsThatMakeItUnstableAreNotArmed) {
  YAML::Node gains = gainsOf("asmc");
  for (int i = 0; i < 3; ++i) gains["attitude"]["gain"][i] = 50.0;
  PilotLimits limits;
  limits.guard = GuardLimits();
  Pilot pilot(test::pelican(), lawWith(gains), 4'000'000, StepClock::Trigger::kTimer, limits);
  pilot.hear(State(), 0, 0);
  pilot.tick(0);
  const std::string refusal = "with its gains the attitude loop about x would be unstable";
  EXPECT_EQ(pilot.guard()->arm(), refusal);
  std::unique_ptr<ControlLaw> law = lawWith(gainsOf("asmc"));
  EXPECT_EQ(pilot.handOver(law), "") << "on the ground all gains are taken";
  EXPECT_EQ(pilot.guard()->arm(), nullptr);
  EXPECT_EQ(pilot.guard()->disarm(), nullptr);
  EXPECT_EQ(pilot.handOver(law), "");
  EXPECT_EQ(pilot.guard()->arm(), refusal);
  EXPECT_EQ(pilot.handOver(law), "");
  EXPECT_EQ(pilot.guard()->arm(), nullptr);
  EXPECT_EQ(pilot.handOver(law), "") << "its rotors idle";
  EXPECT_EQ(pilot.guard()->takeOff(), refusal);
}

}  // namespace
}  // namespace aqc
