#include "support/float_traps.h"

#include <gtest/gtest.h>

#include <string>
#include <tuple>
#include <utility>

#include "adaptive_quadrotor_control/simulation/closed_loop.h"
#include "adaptive_quadrotor_control/simulation/scenario.h"
#include "support/fixtures.h"

// Nothing that flies divides by zero, overflows or computes with what is not a number.
namespace aqc {
namespace {

using Flown = std::tuple<std::string, std::string>;  // scenario, law

class FloatTraps : public ::testing::TestWithParam<Flown> {
 protected:
  void SetUp() override {
    if (!test::FloatTraps::kTrap) GTEST_SKIP() << "no traps here";
  }
};

TEST_P(FloatTraps, AreNotSprungInFlight) {
  const auto& [name, law] = GetParam();
  Scenario scenario = loadScenario(test::configFile("scenario/" + name));
  const Vehicle vehicle = test::vehicleNamed(scenario.vehicle);
  const test::FloatTraps traps;
  ClosedLoop loop(scenario, vehicle, test::lawNamed(law, vehicle));
  while (!loop.done() && loop.plant().now() < fromSeconds(20.0)) {
    loop.advance();
    loop.sample();
  }
  EXPECT_GE(loop.plant().now(), fromSeconds(20.0));
}

INSTANTIATE_TEST_SUITE_P(
    Flights, FloatTraps,
    ::testing::Combine(::testing::Values("aggressive_manoeuvre", "hover_payload",
                                         "payload_transport", "vertical_lift"),
                       ::testing::ValuesIn(lawNames())),
    [](const auto& flight) { return std::get<0>(flight.param) + "_" + std::get<1>(flight.param); });

TEST(FloatTrapsDeathTest, EndTheProgram) {
  if (!test::FloatTraps::kTrap) GTEST_SKIP() << "no traps here";
  volatile double zero = 0.0;
  volatile double result = 1.0;
  const auto divide = [&] {
    const test::FloatTraps traps;
    result = result / zero;
  };
  EXPECT_DEATH(divide(), "");
  result = result / zero;  // and leave nothing behind
  EXPECT_GT(result, 1.0);
}

}  // namespace
}  // namespace aqc
