// Random payload flights, the short version of `payload_flights -n 1..2000`.

#include <gtest/gtest.h>

#include "adaptive_quadrotor_control/simulation/random.h"
#include "campaign/payload_campaign.h"
#include "support/fixtures.h"

namespace aqc {
namespace {

Vehicle stock() {
  return test::vehicleNamed("pelican");
}

std::vector<PayloadResult> flown(const PayloadConditions& conditions, int first, int last,
                                 int threads, const std::string& law = "composite") {
  const Vehicle vehicle = stock();
  return flyCampaign({3, first, last, conditions, threads}, vehicle, *test::lawNamed(law, vehicle),
                     {});
}

void expectFlown(const PayloadConditions& conditions, double most) {
  const auto results = flown(conditions, 1, 20, 2);
  const PayloadSummary sum = summary(results);
  EXPECT_EQ(sum.flights, 20);
  EXPECT_EQ(sum.crashed + sum.lost, 0) << payloadCsv("composite", results);
  EXPECT_LT(sum.worst, most) << payloadCsv("composite", results);
  EXPECT_GT(sum.median, 1e-4) << "no flight is that good";
}

TEST(PayloadFlights, OfTheCompositeAreAllFlown) {
  expectFlown({true, false}, 0.045);
}
TEST(PayloadFlights, OfTheCompositeAreAllFlownWithoutAnImu) {
  expectFlown({false, false}, 0.045);
}
TEST(PayloadFlights, OfTheCompositeAreAllFlownWithEverythingWrong) {
  expectFlown({true, true}, 0.06);
}

TEST(PayloadFlights, AreTheSameForAnyNumberOfThreadsAndByNumber) {
  const auto one = flown({}, 1, 6, 1);
  EXPECT_EQ(payloadCsv("", one), payloadCsv("", flown({}, 1, 6, 2)));
  EXPECT_EQ(payloadCsv("", {one[4]}), payloadCsv("", flown({}, 5, 5, 1)));
  EXPECT_NE(one[0].rms, one[1].rms);
}

TEST(PayloadFlights, AreDrawnWithinTheirRanges) {
  int kinds[3] = {};
  double heaviest = 0.0;
  for (int i = 0; i < 200; ++i) {
    const PayloadFlight flight = drawPayloadFlight(mixedSeed(5, i), stock(), {});
    const auto& events = flight.scenario.mission.events;
    const auto& payload = std::get<AttachPayload>(events[0].action).payload;
    heaviest = std::max(heaviest, payload.mass);
    EXPECT_LE(payload.offset.head<2>().cwiseAbs().maxCoeff(), 0.03);
    EXPECT_GE(payload.offset.z(), -0.25);
    EXPECT_LE(payload.offset.z(), -0.08);
    EXPECT_GE(toSeconds(events[0].time), 6.0);
    EXPECT_LE(toSeconds(events[1].time), 24.0);
    EXPECT_LE(std::get<SetWind>(events[2].action).velocity.norm(), 8.0);
    ++kinds[flight.text.find("hover") == 0 ? 0 : flight.text.find("circle") == 0 ? 1 : 2];
  }
  EXPECT_LE(heaviest, 0.6);
  EXPECT_GT(heaviest, 0.55);
  for (const int kind : kinds) EXPECT_GT(kind, 40);
}

TEST(PayloadFlights, ConditionsChangeNothingElse) {
  const PayloadFlight right = drawPayloadFlight(7, stock(), {true, false});
  const PayloadFlight wrong = drawPayloadFlight(7, stock(), {true, true});
  const PayloadFlight blind = drawPayloadFlight(7, stock(), {false, false});
  EXPECT_EQ(wrong.text.find(right.text), 0u);
  EXPECT_EQ(blind.text, right.text);
  EXPECT_EQ(right.airframe.mass, stock().mass);
  EXPECT_NE(wrong.airframe.mass, stock().mass);
  EXPECT_NE(wrong.airframe.force_constant, stock().force_constant);
  EXPECT_TRUE(right.scenario.world.sensors->imu.gaps.empty());
  EXPECT_FALSE(blind.scenario.world.sensors->imu.gaps.empty());
}

// A summary that sees no loss would praise every law.
TEST(PayloadFlights, SummariesTellCrashedLostAndRanks) {
  std::vector<PayloadResult> results(20);
  for (int i = 0; i < 20; ++i) results[static_cast<std::size_t>(i)].rms = 0.01 * (20 - i);
  PayloadSummary sum = summary(results);
  EXPECT_EQ(sum.median, 0.10);
  EXPECT_EQ(sum.most, 0.19);
  EXPECT_EQ(sum.worst, 0.20);
  results[0].crashed = true;
  results[1].rms = 3.0;
  sum = summary(results);
  EXPECT_EQ(sum.crashed, 1);
  EXPECT_EQ(sum.lost, 1);
  EXPECT_EQ(sum.worst, 3.0);
  EXPECT_EQ(sum.median, 0.10);
}

TEST(PayloadFlights, OfALawThatCannotCarryAreLostOrOff) {
  EXPECT_GT(summary(flown({}, 1, 6, 1, "geometric")).worst, 0.3);
}

}  // namespace
}  // namespace aqc
