#include <gtest/gtest.h>

#include <Eigen/Core>
#include <cmath>
#include <cstdlib>
#include <memory>
#include <vector>

#include "adaptive_quadrotor_control/pilot/flight_controller.h"
#include "adaptive_quadrotor_control/reference/governor.h"
#include "adaptive_quadrotor_control/simulation/rigid_plant.h"
#include "support/fixtures.h"
#include "support/heap_counter.h"

namespace aqc {
namespace {

class AllocationFree : public ::testing::Test {
 protected:
  void SetUp() override {
    if (!test::canCountHeap()) GTEST_SKIP() << "the allocator cannot be watched here";
  }
  const Vehicle vehicle_ = test::pelican();
};

TEST_F(AllocationFree, CounterSeesEveryKindOfAllocation) {
  const test::HeapCounter counter;
  const auto number = std::make_unique<int>(1);
  EXPECT_EQ(counter.count(), 1u);
  const Eigen::VectorXd vector = Eigen::VectorXd::Zero(100 + *number);
  EXPECT_EQ(counter.count(), 2u);
  void* volatile block = std::malloc(10);
  std::free(block);
  EXPECT_EQ(counter.count(), 3u);
  void* volatile zeros = std::calloc(3, 10);
  std::free(zeros);
  EXPECT_EQ(counter.count(), 4u);
}

TEST_F(AllocationFree, PlantStepsInTheAirAndOnTheGround) {
  test::Dice dice(1);
  std::vector<RotorArray> commands;
  for (int i = 0; i < 100; ++i) commands.push_back(dice.speeds(vehicle_));
  for (const double altitude : {0.1, 50.0}) {
    for (const bool loaded : {false, true}) {
      State start;
      start.position.z() = altitude;
      RigidPlant plant(vehicle_, start);
      if (loaded) plant.attach(test::box(0.5));
      const test::HeapCounter counter;
      for (const RotorArray& command : commands) plant.step(command, 1e-3);
      EXPECT_EQ(counter.count(), 0u) << "at " << altitude << " m, loaded: " << loaded;
    }
  }
}

TEST_F(AllocationFree, ControlStepOfEveryLaw) {
  test::Dice dice(2);
  std::vector<State> states;
  std::vector<SetPoint> set_points;
  for (int i = 0; i < 200; ++i) {
    states.push_back(dice.airborneState());
    set_points.push_back(dice.setPoint());
    if (i % 2 == 0) set_points.back().position = states.back().position;
  }
  for (const std::string& name : lawNames()) {
    FlightController controller(vehicle_, test::lawNamed(name, vehicle_));
    const test::HeapCounter counter;
    controller.step({states[0]}, nullptr, 0.01);
    for (std::size_t i = 0; i < states.size(); ++i) {
      Sensed sensed = {states[i]};
      if (i % 3 > 0) sensed.specific_force = Eigen::Vector3d(0.1, 0.0, 9.0);
      if (i % 5 > 2) sensed.ages = {0.02, 0.01, 0.001};
      controller.step(sensed, &set_points[i], 0.01);
    }
    controller.step({states[0]}, nullptr, 0.01);
    EXPECT_EQ(counter.count(), 0u) << name;
  }
}

TEST_F(AllocationFree, GovernorOnEveryWay) {
  test::Dice dice(3);
  ReferenceGovernor governor{GovernorLimits()};
  const test::HeapCounter counter;
  for (int i = 0; i < 400; ++i) {
    SetPoint wanted = dice.setPoint();
    if (i % 7 == 0) wanted.position.x() = std::nan("");
    governor.follow(wanted, dice.vector(5.0), dice.between(0.5, 3.0), -1.0, 0.003 * (i % 20));
    if (i % 50 == 0) governor.shift(dice.vector(1.0), 0.3);
    if (i % 90 == 0) governor.restart(wanted.valid() ? wanted : SetPoint());
  }
  EXPECT_EQ(counter.count(), 0u);
}

}  // namespace
}  // namespace aqc
