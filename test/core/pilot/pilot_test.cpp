#include "adaptive_quadrotor_control/pilot/pilot.h"

#include <gtest/gtest.h>

#include <string>

#include "support/fixtures.h"
#include "support/heap_counter.h"

namespace aqc {
namespace {

constexpr Nanoseconds kPeriod = 4'000'000;
constexpr Nanoseconds kStart = 1'000'000'000'000;

const Eigen::Vector3d kAtRest(0.0, 0.0, kGravity);

class PilotTest : public ::testing::Test {
 protected:
  Pilot make(const std::string& law, StepClock::Trigger trigger = StepClock::Trigger::kOdometry,
             const PilotLimits& limits = {}) const {
    return {vehicle_, test::lawNamed(law, vehicle_), kPeriod, trigger, limits};
  }
  static State at(double height) {
    State state;
    state.position.z() = height;
    return state;
  }
  static std::vector<TimedSetPoint> climb(Nanoseconds time) {
    SetPoint above;
    above.position.z() = 3.0;
    return {{time, above}};
  }

  const Vehicle vehicle_ = test::pelican();
};

TEST_F(PilotTest, AnswersOdometryThatIsDueWithAStepAndAllOtherWithTheLastCommand) {
  Pilot pilot = make("asmc");
  pilot.plan(climb(kStart), kStart, 7);
  EXPECT_EQ(pilot.hear(at(2.0), kStart, kStart).publish, Publish::kNewCommand);
  EXPECT_TRUE(pilot.flying());
  const RotorArray speeds = pilot.allocation().speeds;
  EXPECT_GT(speeds.minCoeff(), 0.0);
  EXPECT_EQ(pilot.hear(at(2.1), kStart + 1, kStart + 1).publish, Publish::kLastCommand);
  EXPECT_TRUE(test::sameBits(pilot.allocation().speeds, speeds));
  EXPECT_EQ(pilot.hear(at(2.1), kStart + kPeriod, kStart + kPeriod).publish, Publish::kNewCommand);
  EXPECT_EQ(pilot.setPointStamp(), 7);
}

TEST_F(PilotTest, IsTheControllerFedWithWhatItHeard) {
  Pilot pilot = make("asmc", StepClock::Trigger::kTimer);
  FlightController controller(vehicle_, test::lawNamed("asmc", vehicle_));
  pilot.plan(climb(kStart), kStart, kStart);
  const SetPoint above = climb(0).front().set_point;
  test::Dice dice(1);
  for (int i = 0; i < 50; ++i) {
    const Nanoseconds now = kStart + i * kPeriod;
    const State state = dice.airborneState();
    EXPECT_EQ(pilot.hear(state, now - 1000, now).publish, Publish::kNothing);
    EXPECT_EQ(pilot.tick(now), Publish::kNewCommand);
    const RotorArray speeds = controller.step({state}, &above, toSeconds(kPeriod)).speeds;
    ASSERT_TRUE(test::sameBits(pilot.allocation().speeds, speeds));
    ASSERT_TRUE(test::sameBits(pilot.sample().state, state));
    ASSERT_TRUE(test::sameBits(pilot.sample().allocation.speeds, speeds));
    ASSERT_EQ(pilot.sample().time, now - 1000);
    ASSERT_EQ(pilot.sample().set_point.position.z(), 3.0);
  }
}

TEST_F(PilotTest, RefusesAndCountsWhatIsNoPoseOrOfThePast) {
  Pilot pilot = make("smc");
  pilot.plan(climb(kStart), kStart, kStart);
  pilot.hear(at(2.0), kStart, kStart);
  const RotorArray speeds = pilot.allocation().speeds;
  State broken = at(2.0);
  broken.velocity.x() = NAN;
  EXPECT_STREQ(pilot.hear(broken, kStart + kPeriod, kStart + kPeriod).refusal,
               "it is not finite or not a pose");
  const Answer late = pilot.hear(at(2.0), kStart - 1, kStart + kPeriod);
  EXPECT_STREQ(late.refusal, "its stamp goes back");
  EXPECT_EQ(late.publish, Publish::kNothing);
  EXPECT_EQ(pilot.droppedOdometry(), 2u);
  EXPECT_TRUE(test::sameBits(pilot.allocation().speeds, speeds));
  EXPECT_TRUE(test::sameBits(pilot.sample().state, at(2.0)));
  const std::vector<Finding> findings = pilot.judge(kStart, 0.0);
  EXPECT_NE(findings[4].reason.find("refused 2 of odometry"), std::string::npos)
      << findings[4].reason;
}

TEST_F(PilotTest, StandsStillWithoutOdometryOrSetPoint) {
  Pilot pilot = make("asmc", StepClock::Trigger::kTimer);
  pilot.plan(climb(kStart), kStart, kStart);
  pilot.tick(kStart);
  EXPECT_FALSE(pilot.flying()) << "nobody knows where the vehicle is";
  pilot.hear(at(1.0), kStart, kStart);
  pilot.tick(kStart + kPeriod);
  EXPECT_TRUE(pilot.flying());
}

TEST_F(PilotTest, BeginsAnewWithAClockThatDoes) {
  PilotLimits limits;
  limits.clock = {2'000'000'000, 3};
  Pilot pilot = make("asmc", StepClock::Trigger::kOdometry, limits);
  pilot.plan(climb(kStart), kStart, kStart);
  for (int i = 0; i < 10; ++i) pilot.hear(at(1.0), kStart + i * kPeriod, kStart);
  EXPECT_NE(pilot.law().telemetry().mass_estimate,
            test::lawNamed("asmc", vehicle_)->telemetry().mass_estimate);
  const Nanoseconds old = kStart - 5'000'000'000;
  EXPECT_FALSE(pilot.hear(at(1.0), old, old).began_anew);
  EXPECT_FALSE(pilot.hear(at(1.0), old + kPeriod, old).began_anew);
  const Answer third = pilot.hear(at(1.0), old + 2 * kPeriod, old);
  EXPECT_TRUE(third.began_anew);
  EXPECT_EQ(third.publish, Publish::kNewCommand);
  EXPECT_FALSE(pilot.flying());
  EXPECT_EQ(pilot.allocation().speeds.norm(), 0.0);
  EXPECT_EQ(pilot.setPointsPending(), 0u);
  EXPECT_EQ(pilot.law().telemetry().mass_estimate,
            test::lawNamed("asmc", vehicle_)->telemetry().mass_estimate);
}

TEST_F(PilotTest, ForgetsTheLastObjectionWithTheClock) {
  PilotLimits limits;
  limits.clock = {2'000'000'000, 1};
  Pilot pilot = make("switched", StepClock::Trigger::kOdometry, limits);
  pilot.order({kStart, 9});
  pilot.hear(at(1.0), kStart, kStart);
  ASSERT_TRUE(pilot.lastObjection());
  const Nanoseconds old = kStart - 5'000'000'000;
  ASSERT_TRUE(pilot.hear(at(1.0), old, old).began_anew);
  EXPECT_FALSE(pilot.lastObjection());
}

TEST_F(PilotTest, WaitsForTheSampleThatGoesWithTheOdometry) {
  Pilot pilot = make("switched");
  pilot.plan(climb(kStart), kStart, kStart);
  EXPECT_EQ(pilot.hear(kAtRest, kStart).publish, Publish::kNothing);
  EXPECT_EQ(pilot.hear(at(1.0), kStart, kStart).publish, Publish::kNewCommand);
  const Nanoseconds next = kStart + kPeriod;
  EXPECT_EQ(pilot.hear(at(1.0), next, next).publish, Publish::kNothing) << "its sample is to come";
  EXPECT_EQ(pilot.hear(kAtRest, next).publish, Publish::kNewCommand);
  EXPECT_STREQ(pilot.hear({NAN, 0.0, 0.0}, next + 1).refusal,
               "it is not finite or its stamp goes back");
  EXPECT_EQ(pilot.imu().dropped(), 1);
}

TEST_F(PilotTest, DoesWithoutAnAccelerometerThatHasFallenSilent) {
  PilotLimits limits;
  limits.specific_force_age = 2 * kPeriod;
  Pilot pilot = make("switched", StepClock::Trigger::kTimer, limits);
  pilot.hear(kAtRest, kStart);
  for (int i = 0; i <= 3; ++i) {
    const Nanoseconds now = kStart + i * kPeriod;
    pilot.hear(at(1.0), now, now);
    pilot.tick(now);
    EXPECT_EQ(pilot.imu().usable(), i <= 2) << i;
  }
  EXPECT_EQ(pilot.imu().losses(), 1);
}

TEST_F(PilotTest, CarriesOutSwitchesAndTellsOfThoseItCannot) {
  Pilot pilot = make("switched");
  pilot.hear(at(1.0), kStart, kStart);
  EXPECT_TRUE(pilot.order({kStart + kPeriod, 2}));
  EXPECT_TRUE(pilot.order({kStart + kPeriod, 9}));
  EXPECT_EQ(pilot.switchesPending(), 2u);
  pilot.hear(at(1.0), kStart + kPeriod, kStart + kPeriod);
  EXPECT_EQ(pilot.law().subsystems()->active(), 2);
  ASSERT_EQ(pilot.objections().size(), 1u);
  EXPECT_EQ(pilot.objections().front().order.subsystem, 9);
  pilot.hear(at(1.0), kStart + 2 * kPeriod, kStart + 2 * kPeriod);
  EXPECT_TRUE(pilot.objections().empty()) << "of that step alone";
  ASSERT_TRUE(pilot.lastObjection());
  EXPECT_EQ(pilot.lastObjection()->verdict.outcome, SwitchOutcome::kUnknownSubsystem);
}

TEST_F(PilotTest, HandsOverToAnotherLawOrSaysWhyNot) {
  Pilot pilot = make("geometric");
  SetPoint here;
  here.position.z() = 1.0;
  pilot.plan({{kStart, here}}, kStart, kStart);
  pilot.hear(at(1.0), kStart, kStart);
  std::unique_ptr<ControlLaw> law = test::lawNamed("asmc", vehicle_);
  const ControlLaw* next = law.get();
  EXPECT_EQ(pilot.handOver(law), "");
  EXPECT_EQ(&pilot.law(), next) << "the very law that was given flies";
  EXPECT_STREQ(law->name(), "geometric") << "the old one comes back";
  EXPECT_NEAR(pilot.law().telemetry().mass_estimate, vehicle_.mass, 1e-9)
      << "it knows what the old one carried";

  pilot.hear(at(9.0), kStart + kPeriod, kStart + kPeriod);
  const std::string refusal = pilot.handOver(law);
  EXPECT_NE(refusal.find("'geometric' cannot take over from 'asmc' now: "), std::string::npos)
      << refusal;
  EXPECT_EQ(&pilot.law(), next);
  law = test::lawNamed("asmc", vehicle_);
  EXPECT_EQ(pilot.handOver(law), "") << "the same law with other gains may always";
}

TEST_F(PilotTest, ATrajectoryOfLongAgoBeginsNow) {
  PilotLimits limits;
  limits.trajectory_age = 500;
  const Pilot pilot = make("asmc", StepClock::Trigger::kTimer, limits);
  EXPECT_EQ(pilot.beginning(kStart - 499, kStart), kStart - 499);
  EXPECT_EQ(pilot.beginning(kStart - 500, kStart), kStart);
  EXPECT_EQ(pilot.beginning(0, kStart), kStart) << "as one without a stamp";
  EXPECT_EQ(pilot.beginning(kStart + 9, kStart), kStart + 9);
}

TEST_F(PilotTest, TellsTheLawHowOldItsSensesAre) {
  // Through a law that keeps what it is told.
  struct Listener final : public ControlLaw {
    explicit Listener(Sensed& heard) : heard_(heard) {}
    Wrench command(const Sensed& sensed, const SetPoint&, double) noexcept override {
      heard_ = sensed;
      return {};
    }
    void adapt(const Achieved&, double) noexcept override {}
    void reset() noexcept override {}
    std::unique_ptr<ControlLaw> clone() const override { return nullptr; }
    const char* name() const noexcept override { return "listener"; }
    bool usesSpecificForce() const noexcept override { return true; }
    const Telemetry& telemetry() const noexcept override { return telemetry_; }
    Sensed& heard_;
    Telemetry telemetry_;
  };
  Sensed heard;
  Pilot pilot(vehicle_, std::make_unique<Listener>(heard), kPeriod, StepClock::Trigger::kTimer);
  pilot.plan(climb(kStart), kStart, kStart);
  pilot.hear(kAtRest, kStart - 3'000'000);
  pilot.hear(at(1.0), kStart - 2'000'000, kStart - 1'000'000);
  pilot.tick(kStart);
  EXPECT_DOUBLE_EQ(heard.ages.pose, 0.002);
  EXPECT_DOUBLE_EQ(heard.ages.body_rate, 0.002);
  EXPECT_DOUBLE_EQ(heard.ages.specific_force, 0.003);
  ASSERT_TRUE(heard.specific_force);
  EXPECT_EQ(*heard.specific_force, kAtRest);
  const Nanoseconds later = kStart + 1'000'000'000;
  pilot.hear(at(1.0), later, later);
  pilot.tick(later);
  EXPECT_FALSE(heard.specific_force) << "the sample has become too old";
}

TEST_F(PilotTest, HearsAndTicksWithoutTheHeap) {
  if (!test::canCountHeap()) GTEST_SKIP() << "the allocator cannot be watched here";
  for (const std::string& law : lawNames()) {
    Pilot pilot = make(law);
    pilot.plan(climb(kStart), kStart, kStart);
    for (int i = 0; i < 20; ++i) pilot.order({kStart + i * kPeriod, 1 + i % 9});
    const test::HeapCounter counter;
    for (int i = 0; i < 40; ++i) {
      const Nanoseconds now = kStart + i * kPeriod;
      pilot.hear(kAtRest, now);
      pilot.hear(at(1.0), now, now);
      pilot.hear(at(1.0), now - 1, now);
    }
    for (int i = 0; i < 12; ++i) pilot.hear(at(1.0), i * kPeriod, i * kPeriod);
    EXPECT_EQ(counter.count(), 0u) << law;
    EXPECT_FALSE(pilot.flying()) << "after the clock was started anew";
  }
}

}  // namespace
}  // namespace aqc
