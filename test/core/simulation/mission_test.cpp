#include "adaptive_quadrotor_control/simulation/mission.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "support/fixtures.h"
#include "support/refusal.h"

namespace aqc {
namespace {

using test::expectRefusal;

constexpr Nanoseconds kSecond = 1'000'000'000;

Mission read(const std::string& entries) {
  const ParameterReader reader = test::readerOf("mission:\n" + entries, "scenario");
  SetPoint start;
  start.position = {1.0, 2.0, 3.0};
  start.yaw = 0.5;
  Mission mission = readMission(reader, {{"box", test::box(0.5)}}, start, kSecond / 10);
  reader.finish();
  return mission;
}

void expectRefused(const std::string& entries, const std::vector<std::string>& parts) {
  expectRefusal([&] { read(entries); }, parts);
}

TEST(Mission, StepsJump) {
  const Mission mission = read(R"(
  - step: {at: 5.0, position: [4, 5, 6], yaw_deg: 90}
  - step: {at: 7.0, position: [7, 8, 9]}
)");
  ASSERT_EQ(mission.set_points.size(), 2u);
  EXPECT_EQ(mission.set_points[0].time, 5 * kSecond);
  EXPECT_EQ(mission.set_points[0].set_point.position, Eigen::Vector3d(4, 5, 6));
  EXPECT_NEAR(mission.set_points[0].set_point.yaw, M_PI_2, 1e-15);
  EXPECT_EQ(mission.set_points[0].set_point.velocity.norm(), 0.0);
  EXPECT_EQ(mission.set_points[1].time, 7 * kSecond);
  EXPECT_NEAR(mission.set_points[1].set_point.yaw, M_PI_2, 1e-15) << "stays as it was";
  EXPECT_TRUE(mission.events.empty());
}

TEST(Mission, PathsAreMinimumSnapFromWhereTheVehicleShouldBe) {
  const Mission mission =
      read("  - path: {at: 2.0, through: [{at: 4.0, position: [1, 2, 5], yaw_deg: 90}]}\n");
  ASSERT_EQ(mission.set_points.size(), 21u) << "one every tenth of a second and the end";
  EXPECT_EQ(mission.set_points.front().time, 2 * kSecond);
  EXPECT_EQ(mission.set_points.back().time, 4 * kSecond);
  const SetPoint& first = mission.set_points.front().set_point;
  const SetPoint& last = mission.set_points.back().set_point;
  EXPECT_LT((first.position - Eigen::Vector3d(1, 2, 3)).norm(), 1e-9);
  EXPECT_NEAR(first.yaw, 0.5, 1e-9);
  EXPECT_LT((last.position - Eigen::Vector3d(1, 2, 5)).norm(), 1e-9);
  EXPECT_NEAR(last.yaw, M_PI_2, 1e-9);
  EXPECT_LT(last.velocity.norm() + last.acceleration.norm(), 1e-6);
  // From rest to rest: z = 3 + 2 (35 u^4 - 84 u^5 + 70 u^6 - 20 u^7); half way at u = 1/2, with
  // speed 2 * 35/16 / 2 s.
  const SetPoint& middle = mission.set_points[10].set_point;
  EXPECT_NEAR(middle.position.z(), 4.0, 1e-9);
  EXPECT_NEAR(middle.velocity.z(), 35.0 / 16.0, 1e-9);
  EXPECT_NEAR(middle.acceleration.z(), 0.0, 1e-9);
}

TEST(Mission, PathsWithinLimitsAreAsFastAsTheseAllow) {
  const Mission mission = read(R"(
  - path: {at: 2.0, limits: {speed: 2.0, acceleration: 1.5}, through: [{position: [5, 2, 3]},
                                                                      {position: [5, 6, 4]}]}
  - step: {position: [0, 0, 1]}
)");
  double speed = 0.0;
  double acceleration = 0.0;
  for (const TimedSetPoint& timed : mission.set_points) {
    speed = std::max(speed, timed.set_point.velocity.norm());
    acceleration = std::max(acceleration, timed.set_point.acceleration.norm());
  }
  EXPECT_LE(speed, 2.0 * (1.0 + 1e-6));
  EXPECT_LE(acceleration, 1.5 * (1.0 + 1e-6));
  EXPECT_TRUE(speed > 1.9 || acceleration > 1.4) << "one of the limits is used";
  const TimedSetPoint& end = mission.set_points[mission.set_points.size() - 2];
  EXPECT_LT((end.set_point.position - Eigen::Vector3d(5, 6, 4)).norm(), 1e-9);
  EXPECT_EQ(mission.set_points.back().time, end.time) << "the step follows the last leg";
  expectRefused(
      "  - path: {at: 2.0, limits: {speed: 0.0, acceleration: 1.0}, through: [{position: [5, 2, "
      "3]}]}\n",
      {"limits/speed", "'0.0'", "> 0"});
  expectRefused(
      "  - path: {at: 2.0, limits: {speed: 1.0, acceleration: 1.0}, through: [{at: 3.0, position: "
      "[5, 2, 3]}]}\n",
      {"through[0]/at", "unknown"});
}

TEST(Mission, EntriesWithoutATimeBeginWhenTheLastLegEnds) {
  const Mission mission = read(R"(
  - path: {at: 1.0, through: [{at: 3.0, position: [0, 0, 1]}]}
  - hold: {for: 2.5}
  - step: {position: [1, 1, 1]}
  - attach: {payload: box}
  - hold: {for: 1.0}
  - detach: {}
)");
  EXPECT_EQ(mission.set_points.back().time, 5 * kSecond + kSecond / 2);
  ASSERT_EQ(mission.events.size(), 2u);
  EXPECT_EQ(mission.events[0].time, 5 * kSecond + kSecond / 2);
  EXPECT_EQ(mission.events[1].time, 6 * kSecond + kSecond / 2);
}

TEST(Mission, EventsMayHappenDuringALeg) {
  const Mission mission = read(R"(
  - path: {at: 1.0, through: [{at: 3.0, position: [0, 0, 1]}]}
  - attach: {at: 2.0, payload: box}
  - wind: {at: 2.5, velocity: [1, -2, 0]}
  - step: {at: 3.0, position: [0, 0, 2]}
)");
  ASSERT_EQ(mission.events.size(), 2u);
  EXPECT_EQ(mission.events[0].time, 2 * kSecond);
  EXPECT_EQ(std::get<AttachPayload>(mission.events[0].action).payload.mass, 0.5);
  EXPECT_EQ(std::get<SetWind>(mission.events[1].action).velocity, Eigen::Vector3d(1, -2, 0));
}

TEST(Mission, SinesCarryTheirDerivativesAndEndAtRest) {
  const Mission mission = read(R"(
  - sine: {at: 1.0, until: 3.0, position: [0, 0, 2], amplitude: [0, 0, 0.5], angular_frequency: 2}
  - hold: {for: 1.0}
  - step: {position: [1, 1, 1]}
)");
  ASSERT_EQ(mission.set_points.size(), 22u) << "one every tenth of a second, its end and the step";
  const TimedSetPoint& sample = mission.set_points[5];
  EXPECT_EQ(sample.time, kSecond + kSecond / 2);
  EXPECT_NEAR(sample.set_point.position.z(), 2.0 + 0.5 * std::sin(1.0), 1e-15);
  EXPECT_NEAR(sample.set_point.velocity.z(), std::cos(1.0), 1e-15);
  EXPECT_NEAR(sample.set_point.acceleration.z(), -2.0 * std::sin(1.0), 1e-15);
  EXPECT_NEAR(sample.set_point.jerk.z(), -4.0 * std::cos(1.0), 1e-15);
  EXPECT_EQ(sample.set_point.yaw, 0.5) << "stays as it was";
  const SetPoint& end = mission.set_points[20].set_point;
  EXPECT_EQ(mission.set_points[20].time, 3 * kSecond);
  EXPECT_NEAR(end.position.z(), 2.0 + 0.5 * std::sin(4.0), 1e-15);
  EXPECT_EQ(end.velocity.norm() + end.acceleration.norm() + end.jerk.norm(), 0.0);
  EXPECT_EQ(mission.set_points.back().time, 4 * kSecond);
}

TEST(Mission, CirclesBeginWhereTheVehicleShouldBeAndEndAtRest) {
  const Mission mission = read(R"(
  - circle: {at: 1.0, until: 3.0, centre: [1, 0], angular_frequency: 2, ease: 1.0}
  - step: {position: [1, 1, 1]}
)");
  ASSERT_EQ(mission.set_points.size(), 22u);
  EXPECT_EQ((mission.set_points[0].set_point.position - Eigen::Vector3d(1.0, 2.0, 3.0)).norm(),
            0.0);
  EXPECT_EQ(mission.set_points[0].set_point.velocity.norm(), 0.0);
  const TimedSetPoint& sample = mission.set_points[15];
  EXPECT_EQ(sample.time, kSecond + 3 * kSecond / 2);
  // A turn of 2 (1.5 - 0.5) from (0, 2) on.
  const Eigen::Vector3d out(-2.0 * std::sin(2.0), 2.0 * std::cos(2.0), 0.0);
  EXPECT_LT((sample.set_point.position - Eigen::Vector3d(1.0, 0.0, 3.0) - out).norm(), 1e-14);
  EXPECT_LT((sample.set_point.acceleration + 4.0 * out).norm(), 1e-14);
  EXPECT_EQ(sample.set_point.yaw, 0.5) << "stays as it was";
  const SetPoint& end = mission.set_points[20].set_point;
  EXPECT_NEAR(end.position.x(), 1.0 - 2.0 * std::sin(3.0), 1e-14);
  EXPECT_EQ(end.velocity.norm() + end.acceleration.norm() + end.jerk.norm(), 0.0);
}

TEST(Mission, RefusesCirclesAroundThePlaceItself) {
  expectRefused("  - circle: {at: 1, until: 2, centre: [1, 2], angular_frequency: 1}\n",
                {"'scenario/mission[0]/circle/centre'", "away from"});
}

TEST(Mission, SwitchesBodiesAndDisturbances) {
  const Mission mission = read(R"(
  - switch: {at: 1.0, subsystem: 2}
  - body: {at: 1.0, mass: 1.7, inertia: [0.032, 0.030, 2.2e-4]}
  - disturbance: {at: 2.0, until: 4.5, force: [0, 0, -0.05], angular_frequency: 0.5}
  - disturbance: {at: 2.0, until: 3.0, moment: [0, 0, 5e-4]}
)");
  ASSERT_EQ(mission.switches.size(), 1u);
  EXPECT_EQ(mission.switches[0].time, kSecond);
  EXPECT_EQ(mission.switches[0].subsystem, 2);
  ASSERT_EQ(mission.events.size(), 3u);
  const auto& body = std::get<SetBody>(mission.events[0].action);
  EXPECT_EQ(body.mass, 1.7);
  EXPECT_EQ(body.inertia(0, 0), 0.032) << "no rigid body's by 6 %, and is taken all the same";
  const auto& sine = std::get<ApplyDisturbance>(mission.events[1].action);
  EXPECT_EQ(mission.events[1].time, 2 * kSecond);
  EXPECT_EQ(sine.duration, 2 * kSecond + kSecond / 2);
  EXPECT_EQ(sine.amplitude.force.z(), -0.05);
  EXPECT_EQ(sine.angular_frequency, 0.5);
  const auto& pulse = std::get<ApplyDisturbance>(mission.events[2].action);
  EXPECT_EQ(pulse.amplitude.moment.z(), 5e-4);
  EXPECT_EQ(pulse.angular_frequency, 0.0);
}

TEST(Mission, RotorsBreakAndAreSoundAgain) {
  const Mission mission = read(R"(
  - rotor: {at: 1.0, number: 2, effectiveness: 0.4, stuck_at: 300, slower: 2.5}
  - rotor: {at: 2.0, number: 2}
)");
  ASSERT_EQ(mission.events.size(), 2u);
  const auto& broken = std::get<SetRotor>(mission.events[0].action);
  EXPECT_EQ(mission.events[0].time, kSecond);
  EXPECT_EQ(broken.number, 2);
  EXPECT_EQ(broken.condition.effectiveness, 0.4);
  EXPECT_EQ(broken.condition.stuck_at, 300.0);
  EXPECT_EQ(broken.condition.slower, 2.5);
  EXPECT_FALSE(broken.condition.sound());
  EXPECT_TRUE(std::get<SetRotor>(mission.events[1].action).condition.sound());
}

TEST(Mission, BatteriesSagAtOnceOrInTime) {
  const Mission mission = read(R"(
  - battery: {at: 1.0, voltage: 0.85}
  - battery: {at: 2.0, voltage: 0.7, over: 2.5}
)");
  ASSERT_EQ(mission.events.size(), 2u);
  EXPECT_EQ(std::get<SetBattery>(mission.events[0].action).voltage, 0.85);
  EXPECT_EQ(std::get<SetBattery>(mission.events[0].action).over, 0);
  EXPECT_EQ(std::get<SetBattery>(mission.events[1].action).over, 2 * kSecond + kSecond / 2);
  expectRefused("  - battery: {at: 1, voltage: 0}\n",
                {"'scenario/mission[0]/battery/voltage'", "'0'", "> 0 and <= 1"});
  expectRefused("  - battery: {at: 1, voltage: 1.01}\n", {"battery/voltage'", "'1.01'"});
  expectRefused("  - battery: {at: 1, voltage: 1, over: -1}\n", {"battery/over'", "'-1'", ">= 0"});
}

TEST(Mission, GustsBlowAndEnd) {
  const Mission mission = read(R"(
  - gust: {at: 1.0, intensity: [1.0, 0.5, 0.2], length: 30, speed: 7, seed: 4}
  - gust: {at: 2.0, intensity: [0, 0, 0]}
)");
  ASSERT_EQ(mission.events.size(), 2u);
  const auto& gust = std::get<SetGust>(mission.events[0].action);
  EXPECT_EQ(gust.intensity, Eigen::Vector3d(1.0, 0.5, 0.2));
  EXPECT_EQ(gust.length, 30.0);
  EXPECT_EQ(gust.speed, 7.0);
  EXPECT_EQ(gust.seed, 4u);
  EXPECT_TRUE(std::get<SetGust>(mission.events[1].action).intensity.isZero(0.0));
  EXPECT_EQ(std::get<SetGust>(mission.events[1].action).length, 10.0);
  for (const auto& [entry, key] :
       std::vector<std::array<std::string, 2>>{{"intensity: [1, -1, 1]", "intensity[1]'"},
                                               {"intensity: [1, 1, 1], length: 0", "length'"},
                                               {"intensity: [1, 1, 1], speed: 0", "speed'"},
                                               {"intensity: [1, 1, 1], seed: -1", "seed'"},
                                               {"length: 3", "intensity'"}}) {
    expectRefused("  - gust: {at: 1, " + entry + "}\n", {"'scenario/mission[0]/gust/" + key});
  }
}

TEST(Mission, CommandsGetLostForAWhile) {
  const Mission mission = read("  - lose_commands: {at: 1, share: 0.3, for: 2.5, seed: 9}\n");
  const auto& loss = std::get<LoseCommands>(mission.events.at(0).action);
  EXPECT_EQ(loss.share, 0.3);
  EXPECT_EQ(loss.duration, 2 * kSecond + kSecond / 2);
  EXPECT_EQ(loss.seed, 9u);
  for (const auto& [entry, key] : std::vector<std::array<std::string, 2>>{
           {"share: 1.1, for: 1", "share'"}, {"share: 1, for: 0", "for'"}, {"share: 1", "for'"}}) {
    expectRefused("  - lose_commands: {at: 1, " + entry + "}\n",
                  {"'scenario/mission[0]/lose_commands/" + key});
  }
}

TEST(Mission, RefusesSenselessRotors) {
  for (const auto& [entry, key, allowed] : std::vector<std::array<std::string, 3>>{
           {"number: 0", "number'", ">= 1 and <= 16"},
           {"effectiveness: 0.5", "number'", "missing"},
           {"number: 1, effectiveness: 1.1", "effectiveness'", ">= 0 and <= 1"},
           {"number: 1, stuck_at: -1", "stuck_at'", ">= 0"},
           {"number: 1, slower: 0.9", "slower'", ">= 1 and <= 1000"}}) {
    expectRefused("  - rotor: {at: 1, " + entry + "}\n",
                  {"'scenario/mission[0]/rotor/" + key, allowed});
  }
}

TEST(Mission, RefusesSenselessSwitchesBodiesAndDisturbances) {
  expectRefused("  - switch: {at: 1, subsystem: 0}\n",
                {"'scenario/mission[0]/switch/subsystem'", "'0'", ">= 1 and <= 8"});
  expectRefused("  - switch: {at: 1, subsystem: 9}\n",
                {"'scenario/mission[0]/switch/subsystem'", "'9'", ">= 1 and <= 8"});
  expectRefused("  - body: {at: 1, mass: 0, inertia: [1, 1, 1]}\n",
                {"'scenario/mission[0]/body/mass'", "'0'", ">= 0.001"});
  expectRefused("  - body: {at: 1, mass: 1, inertia: [1, -1, 1]}\n",
                {"'scenario/mission[0]/body/inertia", "-1"});
  expectRefused("  - body: {at: 1, mass: 1, inertia: [1, 1, 4]}\n",
                {"'scenario/mission[0]/body/inertia' is [1, 1, 4]", "2 times these"});
  expectRefused("  - wind: {at: 1, velocity: [0, 201, 0]}\n",
                {"'scenario/mission[0]/wind/velocity[1]'", "201", ">= -200 and <= 200"});
  expectRefused("  - disturbance: {at: 1, until: 2, moment: [0, 0, 1e308]}\n",
                {"'scenario/mission[0]/disturbance/moment[2]'", "1e308", "<= 100000"});
  expectRefused("  - disturbance: {at: 1, until: 1, force: [0, 0, 1]}\n",
                {"'scenario/mission[0]/disturbance/until'", "1 s", "after"});
  expectRefused(
      "  - sine: {at: 1, until: 2, position: [0, 0, 1], amplitude: [0, 0, 1], "
      "angular_frequency: -1}\n",
      {"'scenario/mission[0]/sine/angular_frequency'", "'-1'", ">= 0"});
}

TEST(Mission, RefusesTimesThatGoBack) {
  expectRefused("  - step: {at: 5, position: [0, 0, 1]}\n  - step: {at: 4, position: [0, 0, 1]}\n",
                {"'scenario/mission[1]/step/at'", "4 s", "5 s", "backwards"});
  expectRefused("  - attach: {at: 5, payload: box}\n  - detach: {at: 4}\n",
                {"'scenario/mission[1]/detach/at'", "4 s", "5 s"});
  expectRefused(
      "  - path: {at: 1, through: [{at: 3, position: [0, 0, 1]}]}\n"
      "  - step: {at: 2, position: [0, 0, 1]}\n",
      {"'scenario/mission[1]/step/at'", "2 s", "3 s"});
  expectRefused("  - attach: {at: 10, payload: box}\n  - step: {at: 7, position: [0, 0, 1]}\n",
                {"'scenario/mission[1]/step/at'", "7 s", "10 s", "backwards"});
  expectRefused("  - path: {at: 5, through: [{at: 5, position: [0, 0, 1]}]}\n",
                {"'scenario/mission[0]/path/through[0]/at'", "5 s", "after"});
  expectRefused(
      "  - path: {at: 1, through: [{at: 3, position: [0, 0, 1]}, {at: 2, position: [0, 0, 2]}]}\n",
      {"'scenario/mission[0]/path/through[1]/at'", "2 s", "3 s"});
  expectRefused("  - step: {at: -1, position: [0, 0, 1]}\n",
                {"'scenario/mission[0]/step/at'", "'-1'", ">= 0"});
  expectRefused("  - hold: {for: -1}\n", {"'scenario/mission[0]/hold/for'", "'-1'", ">= 0"});
}

TEST(Mission, RefusesPayloadEventsThatDoNotAlternate) {
  expectRefused("  - attach: {at: 1, payload: box}\n  - attach: {at: 2, payload: box}\n",
                {"'scenario/mission[1]/attach/payload' is 'box'", "already attached"});
  expectRefused("  - detach: {at: 1}\n",
                {"'scenario/mission[0]/detach/at'", "no payload is attached"});
  expectRefused("  - attach: {at: 1, payload: crate}\n",
                {"'scenario/mission[0]/attach/payload'", "'crate'", "'payloads'"});
}

TEST(Mission, RefusesEntriesThatItDoesNotKnow) {
  expectRefused("  - jump: {at: 1}\n", {"'scenario/mission[0]/jump'", "step, path, hold"});
  expectRefused("  - {hold: {for: 1}, step: {position: [0, 0, 1]}}\n",
                {"'scenario/mission[0]' has 2 names", "step, path, hold"});
  expectRefused("  - {}\n", {"'scenario/mission[0]' has 0 names", "step, path, hold"});
  expectRefused("  - hold\n", {"'scenario/mission[0]'", "'hold'", "a map"});
  expectRefused("  - step: {at: 1, position: [0, 0, 1], speed: 3}\n",
                {"'scenario/mission[0]/step/speed'", "unknown"});
}

TEST(Mission, RefusesLegsThatMakeTooManySetPoints) {
  expectRefused(
      "  - path: {at: 1, limits: {speed: 1.0e-6, acceleration: 1}, through: [{position: [5, 2, "
      "3]}]}\n",
      {"'scenario/mission[0]/path/through' cannot be flown", "the duration is", "<= 100000 s"});
  expectRefused(
      "  - sine: {at: 1, until: 200000, position: [0, 0, 1], amplitude: [0, 0, 1], "
      "angular_frequency: 1}\n",
      {"'scenario/mission[0]/sine/until' is too late", "199999 s", "<= 100000 s"});
}

TEST(Mission, RefusesValuesOutOfRange) {
  expectRefused("  - step: {at: .nan, position: [0, 0, 1]}\n",
                {"'scenario/mission[0]/step/at'", "'.nan'"});
  expectRefused("  - step: {at: 1, position: [0, .inf, 1]}\n",
                {"'scenario/mission[0]/step/position[1]'", "'.inf'", "finite"});
  expectRefused("  - step: {at: 1}\n", {"'scenario/mission[0]/step/position'", "missing"});
  expectRefused("  - path: {at: 1, through: []}\n",
                {"'scenario/mission[0]/path/through'", "at least one waypoint"});
  expectRefused("  - path: {at: 1, through: [{at: 2, position: [1.0e+308, 0, 1]}]}\n",
                {"'scenario/mission[0]/path/through[0]/position[0]'", "1.0e+308", "<= 100000"});
  expectRefused("  - path: {at: 1, through: [{at: 900000, position: [0, 0, 1]}]}\n",
                {"'scenario/mission[0]/path/through' cannot be flown", "set points"});
  expectRefused("  - path: {at: 1}\n", {"'scenario/mission[0]/path/through'", "missing"});
  expectRefused("  - hold: {}\n", {"'scenario/mission[0]/hold/for'", "missing"});
}

TEST(Mission, RefusesYawAndThrustOutOfRange) {
  expectRefused("  - step: {position: [4, 5, 6], yaw_deg: -3600.5}\n",
                {"yaw_deg'", "'-3600.5'", ">= -3600 and <= 3600"});
  for (const char* ratio : {"1.0", "10.5"}) {
    expectRefused("  - path: {limits: {speed: 1, acceleration: 1, thrust_to_weight: " +
                      std::string(ratio) + "}, through: [{position: [5, 2, 3]}]}\n",
                  {"thrust_to_weight'", ratio, "> 1 and <= 10"});
  }
}

TEST(Mission, BoundsTheSetPointsOfAllLegsTogether) {
  const auto plan = [](const std::string& until) {
    const std::string sine = "position: [0, 0, 1], amplitude: [1, 0, 0], angular_frequency: 1}}";
    const ParameterReader scenario(
        YAML::Load("mission: [{sine: {at: 0, until: 600, " + sine +
                   ", {sine: {at: 600, until: " + until + ", " + sine + "]"),
        "long");
    return readMission(scenario, {}, SetPoint(), 1'000'000).set_points.size();
  };
  EXPECT_EQ(plan("999"), 999'002u);
  try {
    plan("1001");
    FAIL() << "each leg alone has less than a million, both have more";
  } catch (const ParameterError& error) {
    const std::string text = error.what();
    EXPECT_NE(text.find("until"), std::string::npos) << text;
    EXPECT_NE(text.find("600001 stand before it"), std::string::npos) << text;
  }
}

}  // namespace
}  // namespace aqc
