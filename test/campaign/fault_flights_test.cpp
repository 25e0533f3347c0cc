// Random fault flights of the default law, the short version of `fault_flights --flights 10000`.

#include <gtest/gtest.h>
#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "adaptive_quadrotor_control/parameters/parameter_reader.h"
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

// The mission of a seed with one thing that happens to the plant, in the air as a rule, instead of
// faults; `bounded` asmc flies it. Nothing where orders themselves are what is wrong.
std::optional<FaultResult> flownWith(std::uint64_t seed, const PlantAction& action) {
  const Vehicle vehicle = test::pelican();
  const FaultFlight drawn = drawFaultFlight(seed, vehicle);
  for (const DrawnFault& fault : drawn.faults) {
    if (fault.kind >= FaultKind::kPlanEnds) return std::nullopt;
  }
  FaultFlight flight = emptyFlight(seed, vehicle);
  flight.scenario.duration = drawn.scenario.duration;
  flight.orders = drawn.orders;
  flight.asked = drawn.asked;
  const double at = 4.0 + 0.4 * static_cast<double>(seed % 20);
  flight.scenario.mission.events = {{fromSeconds(at), action}};
  YAML::Node gains = loadYamlFile(test::configFile("controller/asmc"));
  gains["attitude"]["most_moment"] = 0.3;
  return flyFaults(flight, vehicle, makeLaw(ParameterReader(gains, "gains"), vehicle), guarded());
}

bool acted(const FaultResult& result, Rule rule) {
  return std::find(result.rules.begin(), result.rules.end(), rule) != result.rules.end();
}

TEST(FaultFlights, WithARotorAtSixTenthsTellOfItAndMostlyLand) {
  int flown = 0, told = 0, landed = 0;
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    const int number = 1 + static_cast<int>(seed % 4);
    const auto result = flownWith(seed, SetRotor{number, {0.6, std::nullopt, 1.0}});
    if (!result) continue;
    ++flown;
    told += acted(*result, Rule::kRotorLoss) ? 1 : 0;
    landed += result->verdict == Verdict::kLanded ? 1 : 0;
  }
  EXPECT_GE(told, flown - 2) << "some are on the ground by then";
  EXPECT_GE(landed, 3 * flown / 4);
}

TEST(FaultFlights, WithAPayloadOffCentreTellOfNoRotor) {
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    const double angle = static_cast<double>(seed);
    Payload payload;
    payload.mass = 0.02 * static_cast<double>(seed);
    payload.size = {0.1, 0.1, 0.05};
    payload.offset = {0.03 * std::cos(angle), 0.03 * std::sin(angle), -0.05};
    payload.inertia = boxInertia(payload.mass, payload.size);
    const auto result = flownWith(seed, AttachPayload{"", payload});
    if (!result) continue;
    EXPECT_FALSE(acted(*result, Rule::kRotorLoss)) << campaignCsv({*result});
  }
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
