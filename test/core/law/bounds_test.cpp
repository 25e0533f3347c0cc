#include <gtest/gtest.h>
#include <yaml-cpp/yaml.h>

#include <cmath>
#include <limits>
#include <memory>
#include <string>

#include "adaptive_quadrotor_control/law/law_factory.h"
#include "adaptive_quadrotor_control/law/switched/subsystem_switch.h"
#include "adaptive_quadrotor_control/parameters/parameter_reader.h"
#include "support/fixtures.h"

// What keeps a law that learns within what can be: bounds of its estimates, rest of its adaptation,
// and a look whether all of it is finite.
namespace aqc {
namespace {

YAML::Node gainsOf(const std::string& law) {
  return loadYamlFile(test::configFile("controller/" + law));
}

std::unique_ptr<ControlLaw> made(const YAML::Node& gains) {
  const ParameterReader reader(gains, "gains");
  std::unique_ptr<ControlLaw> law = makeLaw(reader, test::pelican());
  reader.finish();
  return law;
}

/// `seconds` of a set point that is `height` metres above the vehicle, which does not follow.
void hold(ControlLaw& law, double height, double seconds) {
  SetPoint set_point;
  set_point.position = {0.3, 0.0, height};
  for (double time = 0.0; time < seconds; time += 0.01) test::step(law, {}, set_point, 0.01);
}

double mass(const ControlLaw& law) {
  return law.telemetry().mass_estimate;
}

TEST(EstimateBounds, HoldTheMassOfAVehicleThatIsHeld) {
  const auto free = test::lawNamed("asmc", test::pelican());
  const auto bounded = test::lawNamed("asmc", test::pelican());
  bounded->bound({4.0});
  hold(*free, 1.5, 10.0);
  hold(*bounded, 1.5, 10.0);
  EXPECT_GT(mass(*free), 50.0);
  EXPECT_EQ(mass(*bounded), 4.0);
  hold(*free, -1.5, 60.0);
  hold(*bounded, -1.5, 60.0);
  EXPECT_LT(mass(*free), -50.0);
  EXPECT_EQ(mass(*bounded), 0.0);
  hold(*bounded, 1.5, 1.0);
  EXPECT_GT(mass(*bounded), 3.9) << "it leaves the bound at once";
}

TEST(EstimateBounds, ActAtOnceAndOnWhatIsTakenOver) {
  const auto old = test::lawNamed("asmc", test::pelican());
  hold(*old, 1.5, 10.0);
  const auto heir = test::lawNamed("asmc", test::pelican());
  heir->bound({4.0});
  heir->adopt(*old);
  EXPECT_EQ(mass(*heir), 4.0);
  EXPECT_EQ(mass(*heir->clone()), 4.0);
  const auto copy = heir->clone();
  hold(*copy, 1.5, 1.0);
  EXPECT_EQ(mass(*copy), 4.0) << "a clone is as bounded";
  old->bound({5.0});
  EXPECT_EQ(mass(*old), 5.0);
  old->bound({0.005});
  old->reset();
  EXPECT_EQ(mass(*old), 0.005) << "less than the initial one";
}

TEST(EstimateBounds, OfTheParametersAndOfTheGuardTheSmallerOneCounts) {
  YAML::Node gains = gainsOf("asmc");
  gains["mass_estimate"]["most"] = 3.0;
  const auto law = made(gains);
  hold(*law, 1.5, 10.0);
  EXPECT_EQ(mass(*law), 3.0);
  law->bound({4.0});
  hold(*law, 1.5, 1.0);
  EXPECT_EQ(mass(*law), 3.0);
  law->bound({2.0});
  EXPECT_EQ(mass(*law), 2.0);
}

TEST(AsmcBounds, HoldEveryGain) {
  YAML::Node gains = gainsOf("asmc");
  gains["position"]["most_gains"] = YAML::Load("[0.2, 0.3]");
  gains["attitude"]["most_gains"] = YAML::Load("[0.001, 0.002, 0.003]");
  const auto law = made(gains);
  State turned;
  turned.attitude = Eigen::AngleAxisd(1.5, Eigen::Vector3d::UnitX());
  turned.body_rate = {3.0, 0.0, 0.0};
  SetPoint far;
  far.position = {3.0, 0.0, 3.0};
  for (int i = 0; i < 100; ++i) test::step(*law, {turned}, far, 0.01);
  Eigen::Matrix<double, 5, 1> most;
  most << 0.2, 0.3, 0.001, 0.002, 0.003;
  EXPECT_EQ((law->telemetry().adaptive - most).norm(), 0.0) << law->telemetry().adaptive;
}

TEST(AsmcBounds, HoldTheRobustPartOfTheMoment) {
  YAML::Node gains = gainsOf("asmc");
  gains["attitude"]["most_moment"] = 0.3;
  const auto law = made(gains);
  State wild;
  wild.body_rate = {4.0, 0.0, 0.0};
  test::step(*law, {wild}, {}, 10.0);
  const Wrench bounded = test::step(*law, {wild}, {}, 0.01);
  // At its place and level, so that s_q = de_q = (4, 0, 0), outside the boundary layer.
  EXPECT_NEAR(bounded.moment.x(), -0.22 * 4.0 - 0.3, 1e-12);
  EXPECT_GT(law->telemetry().adaptive[2], 0.07) << "the gains themselves go on";
}

TEST(AsmcBounds, HoldTheRobustPartOfTheForce) {
  YAML::Node gains = gainsOf("asmc");
  gains["position"]["most_force"] = 1.5;
  const auto law = made(gains);
  State fast;
  fast.velocity = {4.0, 0.0, 0.0};
  test::step(*law, {fast}, {}, 10.0);
  test::step(*law, {fast}, {}, 0.01);
  EXPECT_NEAR(law->telemetry().force.x(), -2.4 * 4.0 - 1.5, 1e-12);
}

void expectRefused(const YAML::Node& gains, const std::string& says) {
  try {
    made(gains);
    ADD_FAILURE() << "not refused: " << says;
  } catch (const ParameterError& error) {
    EXPECT_NE(std::string(error.what()).find(says), std::string::npos) << error.what();
  }
}

TEST(AsmcBounds, BelowTheInitialValuesAreRefused) {
  YAML::Node gains = gainsOf("asmc");
  gains["position"]["most_gains"] = YAML::Load("[1.0, 0.001]");
  expectRefused(gains, "gains/position/most_gains' is [1.0, 0.001]; it must be >= 'initial_gains'");
  gains = gainsOf("asmc");
  gains["mass_estimate"]["most"] = 0.001;
  expectRefused(gains, "gains/mass_estimate/most' is '0.001'; it must be >= 'initial' = 0.01");
  gains = gainsOf("switched");
  gains["subsystems"][1]["most_theta"] = YAML::Load("[9.0, 9.0, 9.0, 1.0]");
  expectRefused(gains, "gains/subsystems[1]/most_theta' is [9.0, 9.0, 9.0, 1.0]; it must be >=");
}

TEST(SwitchedBounds, HoldEveryThetaOfTheirSubsystem) {
  YAML::Node gains = gainsOf("switched");
  gains["subsystems"][0]["most_theta"] = YAML::Load("[1.3, 1.4, 1.5, 1.6]");
  const auto law = made(gains);
  const auto free = made(gainsOf("switched"));
  State wild;
  wild.velocity = {0.0, 0.0, 50.0};
  wild.body_rate = {30.0, 0.0, 0.0};
  Sensed sensed = {wild};
  sensed.specific_force = Eigen::Vector3d(0.0, 0.0, 50.0);
  SetPoint far;
  far.position.z() = 50.0;
  for (int i = 0; i < 100; ++i) {
    test::step(*law, sensed, far, 0.1);
    test::step(*free, sensed, far, 0.1);
  }
  // theta_0, which is not driven by a norm of the motion, forgets faster than it learns.
  const AdaptiveValues& seen = law->telemetry().adaptive;
  EXPECT_EQ((seen.segment<3>(1) - Eigen::Vector3d(1.4, 1.5, 1.6)).norm(), 0.0) << seen;
  const auto heir = made(gains);
  heir->adopt(*free);
  EXPECT_EQ(heir->telemetry().adaptive[3], 1.6) << "what is taken over is held, too";
}

class EveryLaw : public ::testing::TestWithParam<std::string> {};

TEST_P(EveryLaw, CommandsWithoutAdaptingAndLearnsNothing) {
  const auto law = test::lawNamed(GetParam(), test::pelican());
  SetPoint set_point;
  set_point.position = {1.0, 0.5, 2.0};
  test::step(*law, {}, set_point, 0.01);
  const auto fresh = law->clone();
  const double learned = mass(*law);
  test::Dice dice(8);
  for (int i = 0; i < 1000; ++i) {
    const State state = dice.airborneState();
    const Wrench wrench = law->command({state}, set_point, 0.01);
    ASSERT_TRUE(std::isfinite(wrench.thrust) && wrench.moment.allFinite());
    const Telemetry& seen = law->telemetry();
    ASSERT_EQ((seen.position_error - (state.position - set_point.position)).norm(), 0.0);
  }
  EXPECT_TRUE(law->finite());
  EXPECT_TRUE(std::isnan(learned) ? std::isnan(mass(*law)) : mass(*law) == learned);
  // With the derivatives of the switched law settled, the same as one that was never at rest.
  Wrench rested;
  Wrench expected;
  for (int i = 0; i < 100; ++i) {
    rested = law->command({}, set_point, 0.1);
    expected = fresh->command({}, set_point, 0.1);
  }
  EXPECT_NEAR(rested.thrust, expected.thrust, 1e-9);
  EXPECT_LT((rested.moment - expected.moment).norm(), 1e-9);
}

TEST_P(EveryLaw, SaysWhetherWhatItLearnedIsFinite) {
  const auto law = test::lawNamed(GetParam(), test::pelican());
  EXPECT_TRUE(law->finite());
  State absurd;
  absurd.position = {0.0, 0.0, 1e200};
  ASSERT_TRUE(absurd.valid());
  test::step(*law, {absurd}, {}, 0.01);
  // What the others learn, if anything, is bounded, whatever is sensed.
  EXPECT_EQ(law->finite(), GetParam() != "asmc" && GetParam() != "switched");
  law->reset();
  EXPECT_TRUE(law->finite());
  const Wrench wrench = test::step(*law, {}, {}, 0.01);
  EXPECT_TRUE(std::isfinite(wrench.thrust) && wrench.moment.allFinite());
  EXPECT_TRUE(law->finite());
}

INSTANTIATE_TEST_SUITE_P(Laws, EveryLaw, ::testing::ValuesIn(lawNames()),
                         [](const auto& parameter) { return parameter.param; });

TEST(AsmcBounds, OfGainsMassAndPushesOutliveAnAbsurdSample) {
  YAML::Node gains = gainsOf("asmc");
  gains["position"]["most_gains"] = YAML::Load("[50.0, 50.0]");
  gains["attitude"]["most_gains"] = YAML::Load("[5.0, 5.0, 5.0]");
  const auto law = made(gains);
  law->bound({4.0});
  State absurd;
  absurd.position = {0.0, 0.0, 1e200};
  absurd.body_rate = {1e200, 0.0, 0.0};
  test::step(*law, {absurd}, {}, 0.01);
  EXPECT_TRUE(law->finite());
  const Wrench wrench = test::step(*law, {}, {}, 0.01);
  EXPECT_TRUE(std::isfinite(wrench.thrust) && wrench.moment.allFinite());
}

// A subsystem that changes while adaptation rests is told, and so is what the command was made of.
TEST(SwitchedLawAtRest, TellsOfItsCommand) {
  const auto law = test::lawNamed("switched", test::pelican());
  SetPoint set_point;
  set_point.position.z() = 1.0;
  law->subsystems()->request(2, fromSeconds(1.0));
  law->command({}, set_point, 0.01);
  const AdaptiveValues& seen = law->telemetry().adaptive;
  EXPECT_EQ(seen[seen.size() - 2], 2.0) << "active subsystem";
  EXPECT_GT(seen[seen.size() - 1], 5.0) << "rho";
  EXPECT_LT(law->telemetry().sliding_position.z(), 0.0) << "r";
}

}  // namespace
}  // namespace aqc
