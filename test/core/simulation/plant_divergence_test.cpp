#include <gtest/gtest.h>

#include <limits>
#include <string>

#include "adaptive_quadrotor_control/simulation/rigid_plant.h"
#include "support/fixtures.h"

// Numbers that no flight survives end in a crash that says so, and never in a state that is not
// finite.
namespace aqc {
namespace {

constexpr double kStep = 1e-3;
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

State flying() {
  State state;
  state.position = {3.0, -4.0, 100.0};
  state.velocity = {1.0, 2.0, 0.5};
  return state;
}

RigidPlant hovering() {
  return RigidPlant(test::pelican(), flying());
}

RotorArray hover() {
  return test::hoverSpeeds(test::pelican(), test::pelican().mass);
}

void fly(Plant& plant, int steps) {
  for (int i = 0; i < steps; ++i) plant.step(hover(), kStep);
}

void expectStandsStill(const Plant& plant) {
  const State state = plant.state();
  EXPECT_TRUE(state.valid());
  EXPECT_EQ(state.velocity.norm() + state.body_rate.norm(), 0.0);
  EXPECT_NEAR(plant.specificForce().norm(), kGravity, 1e-9) << "as one that stands";
  EXPECT_TRUE(plant.rotorSpeeds().allFinite());
}

class Absurd : public ::testing::TestWithParam<ForceMoment> {};

TEST_P(Absurd, DisturbanceMakesThePlantDivergeAndStandStill) {
  RigidPlant plant = hovering();
  fly(plant, 100);
  State last = plant.state();
  plant.setDisturbance(GetParam());
  for (int i = 0; i < 1000 && plant.crash() == Crash::kNone; ++i) {
    last = plant.state();
    fly(plant, 1);
  }
  EXPECT_EQ(plant.crash(), Crash::kDiverged);
  expectStandsStill(plant);
  EXPECT_EQ((plant.state().position - last.position).norm(), 0.0) << "where it was last";
  EXPECT_LT(test::angleBetween(plant.state().attitude, last.attitude), 1e-7);

  plant.setDisturbance({});
  fly(plant, 1000);
  expectStandsStill(plant);
  EXPECT_EQ((plant.state().position - last.position).norm(), 0.0) << "for ever";
  EXPECT_LT(plant.rotorSpeeds().maxCoeff(), 1e-3) << "the rotors run down";
  EXPECT_EQ(plant.crash(), Crash::kDiverged);
}

INSTANTIATE_TEST_SUITE_P(
    Plant, Absurd,
    ::testing::Values(ForceMoment{{1e308, 0.0, 0.0}, {}}, ForceMoment{{0.0, 0.0, -1e9}, {}},
                      ForceMoment{{0.0, 1e6, 0.0}, {}}, ForceMoment{{}, {0.0, 0.0, 1e308}},
                      ForceMoment{{}, {1e4, 0.0, 0.0}}, ForceMoment{{}, {0.0, 100.0, 0.0}},
                      ForceMoment{{kNan, 0.0, 0.0}, {}}, ForceMoment{{}, {kNan, 0.0, 0.0}}));

TEST(Plant, DivergesInAbsurdAirAndBodies) {
  RigidPlant plant = hovering();
  plant.setWind({1e200, 0.0, 0.0});
  fly(plant, 200);
  EXPECT_EQ(plant.crash(), Crash::kDiverged);
  expectStandsStill(plant);

  plant = hovering();
  plant.setBody(1e-300, 1e-300 * Eigen::Matrix3d::Identity());
  fly(plant, 200);
  EXPECT_EQ(plant.crash(), Crash::kDiverged);
  expectStandsStill(plant);
}

TEST(Plant, DivergesWithWhatIsAttached) {
  RigidPlant plant = hovering();
  fly(plant, 10);
  const Eigen::Vector3d place = plant.state().position;
  plant.attach(test::box(0.5), {1e300, 0.0, 0.0});
  EXPECT_EQ(plant.crash(), Crash::kDiverged);
  fly(plant, 10);
  expectStandsStill(plant);
  const FreeMotion let_go = plant.detach();
  EXPECT_EQ(let_go.velocity.norm(), 0.0);
  fly(plant, 10);
  expectStandsStill(plant);
  EXPECT_LT((plant.state().position - place).norm(), 0.2) << "the box's share of the centre";
}

TEST(Plant, DivergesFromAnAbsurdStart) {
  for (const double height : {1e7, 1e308, kNan}) {
    State start;
    start.position.z() = height;
    RigidPlant plant(test::pelican(), start);
    EXPECT_EQ(plant.crash(), Crash::kDiverged);
    fly(plant, 10);
    expectStandsStill(plant);
  }
}

TEST(Plant, SaysWhyItCrashedFirst) {
  State falling;
  falling.position.z() = 0.11;
  falling.velocity.z() = -5.0;
  RigidPlant plant(test::pelican(), falling);
  fly(plant, 20);
  ASSERT_EQ(plant.crash(), Crash::kHardImpact);
  plant.setDisturbance({{1e308, 0.0, 0.0}, {}});
  fly(plant, 10);
  EXPECT_EQ(plant.crash(), Crash::kHardImpact);
  expectStandsStill(plant);
}

TEST(Plant, BearsWhatIsFastAndFarAway) {
  State start;
  start.position = {9e5, 0.0, 1e5};
  start.velocity = {1000.0, -1000.0, 0.0};
  start.body_rate = {0.0, 0.0, 1000.0};  // half a radian in half a step
  RigidPlant plant(test::pelican(), start);
  for (int i = 0; i < 100; ++i) plant.step(RotorArray::Zero(4), kStep);
  EXPECT_EQ(plant.crash(), Crash::kNone);
  EXPECT_TRUE(plant.state().valid());
}

TEST(Plant, SaysThatItDivergedInOneField) {
  const std::string reason = toString(Crash::kDiverged);
  EXPECT_EQ(reason.find("diverged: "), 0u) << reason;
  EXPECT_EQ(reason.find(','), std::string::npos) << "it stands in CSV files";
}

}  // namespace
}  // namespace aqc
