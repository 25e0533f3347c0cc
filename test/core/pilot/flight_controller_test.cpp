#include "adaptive_quadrotor_control/pilot/flight_controller.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "support/fixtures.h"

namespace aqc {
namespace {

class EveryLaw : public ::testing::TestWithParam<std::string> {
 protected:
  FlightController make() const {
    return FlightController(vehicle_, test::lawNamed(GetParam(), vehicle_));
  }
  const Vehicle vehicle_ = test::pelican();
};

TEST_P(EveryLaw, StandsStillWithoutASetPoint) {
  FlightController controller = make();
  EXPECT_EQ(controller.allocation().speeds.size(), 4);
  EXPECT_EQ(controller.allocation().speeds.norm(), 0.0) << "before the first step, too";
  test::Dice dice(1);
  for (int i = 0; i < 20; ++i) {
    const Allocation& allocation = controller.step({dice.airborneState()}, nullptr, 0.01);
    EXPECT_EQ(allocation.speeds.size(), 4);
    EXPECT_EQ(allocation.speeds.norm(), 0.0);
    EXPECT_FALSE(allocation.saturated);
  }
}

TEST_P(EveryLaw, BeginsAnewAfterThereWasNoSetPoint) {
  FlightController used = make();
  FlightController fresh = make();
  test::Dice dice(2);
  const State state = dice.airborneState();
  SetPoint set_point;
  set_point.position = state.position;
  for (int i = 0; i < 100; ++i) used.step({dice.airborneState()}, &set_point, 0.01);
  // A law that follows the rotors remembers them, and rightly, until they stand still.
  for (int i = 0; i < 5000; ++i) used.step({state}, nullptr, 0.01);
  EXPECT_TRUE(test::sameBits(used.law().telemetry().adaptive, fresh.law().telemetry().adaptive));
  const RotorArray speeds = used.step({state}, &set_point, 0.01).speeds;
  EXPECT_TRUE(test::sameBits(speeds, fresh.step({state}, &set_point, 0.01).speeds));
}

TEST_P(EveryLaw, NamesWhatItAdapts) {
  FlightController controller = make();
  EXPECT_EQ(static_cast<Eigen::Index>(controller.law().adaptiveQuantities().size()),
            controller.law().telemetry().adaptive.size());
}

TEST_P(EveryLaw, GivesTheSameBitsForTheSameInput) {
  FlightController one = make();
  FlightController other = make();
  test::Dice dice(3);
  for (int i = 0; i < 300; ++i) {
    const State state = dice.airborneState();
    SetPoint set_point = dice.setPoint();
    set_point.position += state.position;
    const double dt = dice.between(1e-3, 0.02);
    const RotorArray speeds = one.step({state}, &set_point, dt).speeds;
    ASSERT_TRUE(test::sameBits(speeds, other.step({state}, &set_point, dt).speeds));
    ASSERT_TRUE(speeds.allFinite());
  }
  EXPECT_TRUE(test::sameBits(one.law().telemetry().adaptive, other.law().telemetry().adaptive));
}

TEST_P(EveryLaw, LiftsTowardsASetPointAbove) {
  FlightController controller = make();
  State state;
  SetPoint above;
  above.position.z() = 2.0;
  EXPECT_GT(controller.step({state}, &above, 0.01).achieved.thrust, 1.0);
}

INSTANTIATE_TEST_SUITE_P(FlightController, EveryLaw, ::testing::ValuesIn(lawNames()),
                         [](const auto& parameter) { return parameter.param; });

}  // namespace
}  // namespace aqc
