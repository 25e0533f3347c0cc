// Random fault flights of the default law, the short version of `fault_flights --flights 10000`.

#include <gtest/gtest.h>

#include "campaign/campaign.h"
#include "campaign/hover.h"
#include "campaign/margins.h"
#include "support/fixtures.h"

namespace aqc {
namespace {

PilotLimits guarded() {
  PilotLimits limits;
  limits.guard = GuardLimits();
  return limits;
}

std::vector<FaultResult> flown(std::uint64_t seed, int flights, int threads) {
  const Vehicle vehicle = test::pelican();
  return flyCampaign({seed, flights, threads}, vehicle, *test::lawNamed("asmc", vehicle), guarded(),
                     {});
}

TEST(FaultFlights, EndLandedOrHeld) {
  for (const FaultResult& result : flown(1, 200, 2)) {
    if (result.verdict == Verdict::kForced) continue;
    EXPECT_TRUE(result.verdict == Verdict::kLanded || result.verdict == Verdict::kHeld)
        << campaignCsv({result});
    EXPECT_LE(result.impact, kHardTouchDown) << campaignCsv({result});
  }
}

TEST(FaultFlights, AreTheSameForAnyNumberOfThreads) {
  const std::string one = campaignCsv(flown(1001, 30, 1));
  EXPECT_EQ(one, campaignCsv(flown(1001, 30, 2)));
  EXPECT_NE(one, campaignCsv(flown(1002, 30, 1)));
}

TEST(FaultFlights, DrawEveryKindOfFault) {
  std::vector<int> drawn(faultKinds().size());
  for (std::uint64_t seed = 1; seed <= 300; ++seed) {
    const FaultFlight flight = drawFaultFlight(seed, test::pelican());
    EXPECT_GE(flight.faults.size(), 1u);
    EXPECT_LE(flight.faults.size(), 3u);
    for (const DrawnFault& fault : flight.faults) {
      EXPECT_FALSE(fault.text.empty());
      ++drawn[static_cast<std::size_t>(fault.kind)];
    }
  }
  for (const FaultKindText& kind : faultKinds()) {
    EXPECT_GT(drawn[static_cast<std::size_t>(kind.kind)], 0) << kind.name;
  }
}

// A judge that sees no loss would pass them all.
TEST(FaultFlights, ThatCrashAreLost) {
  FaultFlight flight = emptyFlight(1, test::pelican());
  flight.scenario.duration = fromSeconds(10.0);
  const ForceMoment blow{Eigen::Vector3d::Zero(), {5.0, 0.0, 0.0}};
  flight.scenario.mission.events = {
      {fromSeconds(3.0), ApplyDisturbance{fromSeconds(1.0), blow, 0.0}}};
  const Vehicle vehicle = test::pelican();
  const FaultResult result = flyFaults(flight, vehicle, test::lawNamed("asmc", vehicle), guarded());
  EXPECT_EQ(result.verdict, Verdict::kLost);
  EXPECT_FALSE(result.reason.empty());
  EXPECT_GT(result.impact, 2.0);
}

TEST(FaultFlights, ThatLoseARotorAreForcedDownAndStopTheOthers) {
  const Vehicle vehicle = test::pelican();
  FaultFlight flight = emptyFlight(1, vehicle);
  flight.scenario.duration = fromSeconds(10.0);
  flight.scenario.mission.events = {{fromSeconds(4.0), SetRotor{2, {0.0, std::nullopt, 1.0}}}};
  const FaultResult result = flyFaults(flight, vehicle, test::lawNamed("asmc", vehicle), guarded());
  EXPECT_EQ(result.verdict, Verdict::kForced);
  EXPECT_FALSE(result.reason.empty());
  EXPECT_LT(result.duration, 9.0) << "disarmed";
}

TEST(FaultFlights, ThatLoseARotorBeforeLiftOffStopBeforeTheyTipOver) {
  const Vehicle vehicle = test::pelican();
  FaultFlight flight = emptyFlight(1, vehicle);
  flight.scenario.duration = fromSeconds(10.0);
  const ForceMoment tether{{0.0, 0.0, -23.0}, Eigen::Vector3d::Zero()};
  flight.scenario.mission.events = {{0, ApplyDisturbance{fromSeconds(6.0), tether, 0.0}},
                                    {fromSeconds(0.6), SetRotor{1, {0.0, std::nullopt, 1.0}}}};
  const FaultResult result = flyFaults(flight, vehicle, test::lawNamed("asmc", vehicle), guarded());
  EXPECT_EQ(result.verdict, Verdict::kLanded) << result.reason;
  EXPECT_EQ(result.rules.back(), Rule::kTipped);
}

TEST(FaultFlights, ThatCarryMoreThanTheRotorsLiftAreForcedDown) {
  const Vehicle vehicle = test::pelican();
  FaultFlight flight = emptyFlight(1, vehicle);
  flight.scenario.duration = fromSeconds(20.0);
  const ForceMoment tether{{0.0, 0.0, -1.2 * vehicle.maxThrust()}, Eigen::Vector3d::Zero()};
  flight.scenario.mission.events = {
      {fromSeconds(4.0), ApplyDisturbance{fromSeconds(8.0), tether, 0.0}}};
  flight.orders = {{fromSeconds(5.0), Order::Kind::kLand, {}}};
  const FaultResult result = flyFaults(flight, vehicle, test::lawNamed("asmc", vehicle), guarded());
  EXPECT_EQ(result.verdict, Verdict::kForced);
  EXPECT_GT(result.impact, kHardTouchDown);
}

TEST(Hover, IsPossibleWhileEachRotorCanGiveItsShare) {
  const Vehicle vehicle = test::pelican();
  const double most = vehicle.maxThrust();
  const Hover hover(vehicle);
  std::vector<RotorCondition> rotors(vehicle.rotors.size());
  EXPECT_TRUE(hover.isPossible(rotors, 1.0, 0.999 * most));
  EXPECT_FALSE(hover.isPossible(rotors, 1.0, 1.001 * most));
  EXPECT_TRUE(hover.isPossible(rotors, 0.8, 0.639 * most));
  EXPECT_FALSE(hover.isPossible(rotors, 0.8, 0.641 * most));
  rotors[1].effectiveness = 0.5;
  EXPECT_TRUE(hover.isPossible(rotors, 1.0, 0.499 * most));
  EXPECT_FALSE(hover.isPossible(rotors, 1.0, 0.501 * most));
  rotors[1] = {1.0, 700.0, 1.0};
  EXPECT_FALSE(hover.isPossible(rotors, 1.0, 0.1 * most));
}

TEST(FaultFlights, MarginsAreBetweenWhatIsBorneAndWhatIsNot) {
  const Vehicle vehicle = test::pelican();
  const Margins margins = measureMargins(vehicle, *test::lawNamed("geometric", vehicle), guarded());
  EXPECT_GT(margins.delay, 0.002);
  EXPECT_LT(margins.delay, 0.3);
  EXPECT_LT(margins.rate, 200.0);
  EXPECT_GT(margins.gap, 0.1);
  EXPECT_GT(margins.noise, 0.005);
  EXPECT_LT(margins.noise, 1.0);
}

}  // namespace
}  // namespace aqc
