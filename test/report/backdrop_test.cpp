#include "report/backdrop.h"

#include <gtest/gtest.h>

#include "support/fixtures.h"

namespace aqc {
namespace {

AttachPayload payload(double mass) {
  return {"box", test::box(mass)};
}

TEST(Backdrop, OfAScenarioHasItsPayloadsWallsAndMission) {
  Scenario scenario;
  scenario.title = "Over the wall";
  scenario.duration = fromSeconds(9.0);
  scenario.world.start.position = {1.0, -2.0, 0.0};
  scenario.mission.set_points.resize(2);
  scenario.mission.set_points[0].set_point.position = {4.0, 0.0, 3.0};
  scenario.mission.set_points[1].set_point.position = {-5.0, 0.0, 1.0};
  scenario.world.walls = {{{0.0, 0.0, 0.0}, {1.0, 1.0, 1.0}}};
  scenario.mission.events = {{fromSeconds(2.0), payload(0.5)},
                             {fromSeconds(3.0), SetWind{Eigen::Vector3d::Zero()}},
                             {fromSeconds(4.0), DetachPayload{}},
                             {fromSeconds(6.0), payload(0.25)}};
  const Backdrop backdrop = backdropOf(scenario);
  EXPECT_EQ(backdrop.title, "Over the wall");
  EXPECT_EQ(backdrop.duration, fromSeconds(9.0));
  EXPECT_EQ(backdrop.mission.min, Eigen::Vector3d(-5.0, -2.0, 0.0));
  EXPECT_EQ(backdrop.mission.max, Eigen::Vector3d(4.0, 0.0, 3.0));
  ASSERT_EQ(backdrop.walls.size(), 1u);
  EXPECT_EQ(backdrop.walls[0].max, Eigen::Vector3d::Ones());
  ASSERT_EQ(backdrop.payloads.size(), 2u);
  EXPECT_EQ(backdrop.payloads[0].from, fromSeconds(2.0));
  EXPECT_EQ(backdrop.payloads[0].to, fromSeconds(4.0));
  EXPECT_EQ(backdrop.payloads[0].mass, 0.5);
  EXPECT_EQ(backdrop.payloads[1].from, fromSeconds(6.0));
  EXPECT_FALSE(backdrop.payloads[1].to);
}

TEST(Backdrop, OfALogHasWhatTheSamplesTell) {
  FlightLog log;
  for (const double mass : {0.0, 0.5, 0.5, 0.0, 0.25, 0.75}) {
    FlightSample sample;
    sample.time = static_cast<Nanoseconds>(log.samples.size()) * fromSeconds(0.1);
    sample.payload_mass = mass;
    log.samples.push_back(sample);
  }
  const Backdrop backdrop = backdropOf(log, "a bag");
  EXPECT_EQ(backdrop.title, "a bag");
  EXPECT_EQ(backdrop.duration, fromSeconds(0.6)) << "the last step lasts, too";
  ASSERT_EQ(backdrop.payloads.size(), 3u);
  EXPECT_EQ(backdrop.payloads[0].from, fromSeconds(0.1));
  EXPECT_EQ(backdrop.payloads[0].to, fromSeconds(0.3));
  EXPECT_EQ(backdrop.payloads[1].to, fromSeconds(0.5));
  EXPECT_EQ(backdrop.payloads[2].mass, 0.75);
  EXPECT_FALSE(backdrop.payloads[2].to);
}

}  // namespace
}  // namespace aqc
