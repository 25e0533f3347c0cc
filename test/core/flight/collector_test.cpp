#include "adaptive_quadrotor_control/flight/collector.h"

#include <gtest/gtest.h>

#include <stdexcept>
#include <string>
#include <vector>

namespace aqc {
namespace {

constexpr Nanoseconds kSecond = 1'000'000'000;
using Quantities = std::vector<AdaptiveQuantity>;

// A step of a law that adapts one gain.
StepReport step(Nanoseconds time, bool flying = true, Nanoseconds plan_stamp = 0) {
  StepReport report;
  report.sample.time = time;
  report.sample.flying = flying;
  report.sample.telemetry.adaptive = Eigen::VectorXd::Constant(1, 0.5);
  report.controller = "asmc";
  report.adaptive_quantities = {{"K", "N"}};
  report.plan_stamp = plan_stamp;
  return report;
}

StepReport stepOf(const std::string& controller, const Quantities& quantities, Nanoseconds time,
                  bool flying = true) {
  StepReport report = step(time, flying);
  report.controller = controller;
  report.adaptive_quantities = quantities;
  const auto count = static_cast<Eigen::Index>(quantities.size());
  report.sample.telemetry.adaptive = Eigen::VectorXd::Constant(count, 0.5);
  return report;
}

StepReport objected(Nanoseconds time, std::uint32_t count) {
  StepReport report = step(time);
  report.objections = {count, 3, "refused", time + 2 * kSecond};
  return report;
}

Truth truth(Nanoseconds time, double payload_mass = 0.0) {
  Truth truth;
  truth.time = time;
  truth.payload_mass = payload_mass;
  return truth;
}

Truth crashed(Nanoseconds time, Nanoseconds crash_time, const std::string& reason) {
  Truth told = truth(time);
  told.crash_time = crash_time;
  told.crash_reason = reason;
  return told;
}

std::vector<Nanoseconds> timesOf(const FlightLog& log) {
  std::vector<Nanoseconds> times;
  for (const FlightSample& sample : log.samples) times.push_back(sample.time);
  return times;
}

std::vector<double> payloadsOf(const FlightLog& log) {
  std::vector<double> masses;
  for (const FlightSample& sample : log.samples) masses.push_back(sample.payload_mass);
  return masses;
}

std::vector<Eigen::Index> adaptiveCounts(const FlightLog& log) {
  std::vector<Eigen::Index> counts;
  for (const FlightSample& sample : log.samples) counts.push_back(sample.telemetry.adaptive.size());
  return counts;
}

using Times = std::vector<Nanoseconds>;
using Masses = std::vector<double>;
using Counts = std::vector<Eigen::Index>;

TEST(Collector, DropsStepsThatDoNotGrowInTime) {
  Collector collector;
  EXPECT_FALSE(collector.lastStep());
  for (const Nanoseconds time : {10, 12, 12, 11, 15}) {
    StepReport report = step(time);
    report.sample.state.position.x() = static_cast<double>(collector.lastStep().value_or(0));
    collector.add(report);
  }
  EXPECT_EQ(collector.lastStep(), 15);
  const FlightLog log = collector.take();
  ASSERT_EQ(timesOf(log), (Times{0, 2, 5}));
  EXPECT_EQ(log.samples[1].state.position.x(), 10.0) << "a repetition must not replace the first";
}

TEST(Collector, JoinsTheTruthOfItsTimeToEachSample) {
  Collector collector(10, 100);
  EXPECT_FALSE(collector.lastTruth());
  for (const Nanoseconds time : {10, 12, 14, 16}) collector.add(step(time));
  // In any order against the steps, and against each other.
  collector.add(truth(12, 0.25));
  collector.add(truth(16, 7.0));
  collector.add(truth(13, 0.5));
  collector.add(truth(16, 0.75));
  collector.add(truth(17, 1.0));
  EXPECT_EQ(collector.lastTruth(), 17);
  EXPECT_EQ(payloadsOf(collector.take()), (Masses{0.0, 0.25, 0.5, 0.75}));
}

TEST(Collector, JoinsAllThatTheTruthTells) {
  Truth told = truth(10, 0.25);
  told.touching = true;
  told.disturbance = {{1.0, 2.0, 3.0}, {4.0, 5.0, 6.0}};
  Collector collector(10, 100);
  collector.add(told);
  collector.add(step(10));
  const FlightLog log = collector.take();
  ASSERT_EQ(log.samples.size(), 1u);
  const FlightSample& sample = log.samples.front();
  EXPECT_EQ(sample.payload_mass, 0.25);
  EXPECT_TRUE(sample.touching);
  EXPECT_EQ(sample.disturbance.force, told.disturbance.force);
  EXPECT_EQ(sample.disturbance.moment, told.disturbance.moment);
}

TEST(Collector, KeepsTheStepsOfAFlightWhoseTimeIsTold) {
  Collector collector(100, 10);
  EXPECT_EQ(collector.begin(), 100);
  for (const Nanoseconds time : {98, 100, 104, 109, 110, 112}) collector.add(step(time, false));
  EXPECT_EQ(collector.lastStep(), 112) << "the end is seen by steps that are not kept";
  EXPECT_EQ(timesOf(collector.take()), (Times{0, 4, 9}));
}

TEST(Collector, FindsTheFirstStepThatFlies) {
  Collector collector;
  collector.add(step(50, false));
  EXPECT_FALSE(collector.begin());
  EXPECT_THROW(collector.take(), std::logic_error);
  collector.add(step(54));
  collector.add(step(58, false));
  collector.add(step(62));
  EXPECT_EQ(collector.begin(), 54);
  EXPECT_EQ(timesOf(collector.take()), (Times{0, 4, 8}));
  EXPECT_FALSE(collector.begin()) << "what was collected is taken";
}

TEST(Collector, FindsTheBeginOfAMission) {
  const auto beginOf = [](Nanoseconds plan_stamp) {
    Collector collector;
    collector.add(step(50, false));
    collector.add(step(54, false));
    collector.add(step(58, true, plan_stamp));
    return collector.begin();
  };
  EXPECT_EQ(beginOf(53), 53);
  EXPECT_EQ(beginOf(50), 50);
  EXPECT_EQ(beginOf(58), 58);
  EXPECT_EQ(beginOf(49), 58) << "sent before anything was recorded";
  EXPECT_EQ(beginOf(59), 58) << "something else flies until then";
  Collector alone;
  alone.add(step(58, true, 53));
  EXPECT_EQ(alone.begin(), 58);
}

TEST(Collector, NamesTheFlightByTheLawOfItsFirstSample) {
  Collector collector;
  collector.add(stepOf("geometric", {}, 8, false));
  for (const Nanoseconds time : {10, 12}) {
    collector.add(stepOf("asmc", {{"K", "N"}, {"M", "kg"}}, time));
  }
  collector.add(stepOf("smc", {{"R", "N"}, {"S", "N"}}, 14));
  collector.add(stepOf("smc", {{"R", "N"}, {"S", "N"}}, 16));
  collector.add(stepOf("twin", {{"K", "N"}, {"M", "kg"}}, 18));
  const FlightLog log = collector.take();
  EXPECT_EQ(log.controller, "asmc");
  EXPECT_EQ(log.adaptive_quantities, (Quantities{{"K", "N"}, {"M", "kg"}}));
  EXPECT_EQ(adaptiveCounts(log), (Counts{2, 2, 0, 0, 2}));
}

TEST(Collector, TellsLawsApartThatAdaptTheSame) {
  Collector collector;
  collector.add(stepOf("geometric", {}, 8, false));
  collector.add(stepOf("smc", {}, 10));
  EXPECT_EQ(collector.take().controller, "smc");
}

TEST(Collector, LeavesValuesInOtherUnitsOut) {
  Collector collector;
  collector.add(stepOf("asmc", {{"K", "N"}}, 10));
  collector.add(stepOf("asmc", {{"K", "kg"}}, 12));
  EXPECT_EQ(adaptiveCounts(collector.take()), (Counts{1, 0}));
}

// A flight from 100 to 110 with some truths.
FlightLog flownWith(const std::vector<Truth>& truths) {
  Collector collector(100, 10);
  for (const Truth& told : truths) collector.add(told);
  for (const Nanoseconds time : {100, 105}) collector.add(step(time));
  return collector.take();
}

TEST(Collector, TellsTheFirstCrashOfTheFlight) {
  const FlightLog unhurt = flownWith({truth(100), truth(105), truth(110)});
  EXPECT_FALSE(unhurt.crash_time);
  EXPECT_EQ(unhurt.crash_reason, "");
  const FlightLog hit =
      flownWith({truth(100), crashed(105, 103, "hard impact"), crashed(110, 107, "upside down")});
  EXPECT_EQ(hit.crash_time, 3);
  EXPECT_EQ(hit.crash_reason, "hard impact");
}

TEST(Collector, TellsACrashUntilTheEndAndNoLaterOne) {
  EXPECT_EQ(flownWith({crashed(110, 110, "hard impact")}).crash_time, 10);
  EXPECT_EQ(flownWith({crashed(115, 109, "hard impact")}).crash_time, 9);
  const FlightLog after = flownWith({crashed(115, 111, "hard impact")});
  EXPECT_FALSE(after.crash_time);
  EXPECT_EQ(after.crash_reason, "");
}

TEST(Collector, LeavesCrashesBeforeTheFlightOutWhenThePlantWasReset) {
  EXPECT_FALSE(flownWith({crashed(99, 90, "hard impact"), truth(100)}).crash_time);
  EXPECT_EQ(flownWith({crashed(99, 90, "fell"), crashed(100, 90, "fell")}).crash_time, -10);
}

TEST(Collector, EndsWithItsLastSampleWhereTheEndIsOpen) {
  const auto crashOf = [](Nanoseconds crash_time) {
    Collector collector;
    for (const Nanoseconds time : {100, 105}) collector.add(step(time));
    collector.add(crashed(110, crash_time, "hard impact"));
    return collector.take().crash_time;
  };
  EXPECT_EQ(crashOf(105), 5);
  EXPECT_FALSE(crashOf(106));
}

TEST(Collector, TellsEachObjectionToASwitchOnce) {
  Collector collector(10 * kSecond, 10 * kSecond);
  collector.add(objected(10 * kSecond, 4));  // from before, as nobody heard of fewer
  collector.add(objected(11 * kSecond, 5));
  collector.add(objected(12 * kSecond, 5));
  collector.add(objected(12 * kSecond, 6));  // told again, with news
  collector.add(objected(14 * kSecond, 0));  // another law
  collector.add(objected(15 * kSecond, 1));
  collector.add(objected(21 * kSecond, 2));  // after the flight
  const FlightLog log = collector.take();
  ASSERT_EQ(log.refusals.size(), 3u);
  EXPECT_EQ(log.refusals[0].time, 1 * kSecond);
  EXPECT_EQ(log.refusals[0].reason,
            "switch to subsystem 3 refused; the next switch is allowed at 3 s");
  EXPECT_EQ(log.refusals[1].time, 2 * kSecond);
  EXPECT_EQ(log.refusals[2].time, 5 * kSecond);
}

TEST(Collector, LeavesObjectionsBeforeTheFlightOut) {
  Collector collector(10 * kSecond, 10 * kSecond);
  collector.add(objected(8 * kSecond, 0));
  collector.add(objected(9 * kSecond, 1));
  collector.add(step(10 * kSecond));
  EXPECT_TRUE(collector.take().refusals.empty());
}

TEST(Collector, TellsOfAFlightWithoutSteps) {
  Collector collector(100, 10);
  collector.add(step(98));
  collector.add(crashed(105, 103, "hard impact"));
  const FlightLog log = collector.take();
  EXPECT_TRUE(log.samples.empty());
  EXPECT_EQ(log.controller, "");
  EXPECT_EQ(log.crash_time, 3);
}

}  // namespace
}  // namespace aqc
