#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "adaptive_quadrotor_control/math/number_text.h"
#include "adaptive_quadrotor_control/simulation/rigid_plant.h"
#include "adaptive_quadrotor_control/simulation/timed_plant.h"
#include "support/fixtures.h"
#include "support/refusal.h"

namespace aqc {
namespace {

constexpr Nanoseconds kMillisecond = 1'000'000;

RotorArray off() {
  return RotorArray::Zero(4);
}

std::unique_ptr<Plant> rigid(const Vehicle& vehicle, const State& start, bool ground = true) {
  return std::make_unique<RigidPlant>(vehicle, start, std::vector<Box>(), ground);
}

TimedPlant plantAt(double altitude, Nanoseconds start = 0) {
  State state;
  state.position.z() = altitude;
  return TimedPlant(rigid(test::pelican(), state), {}, kMillisecond, start);
}

/// A plant of another kind: it flies nowhere and writes down what it is asked for.
class Scribe final : public Plant {
 public:
  using Notes = std::vector<std::string>;
  explicit Scribe(Notes& notes) : notes_(notes), speeds_(off()) {}

  void step(const RotorArray& command, double dt) noexcept override {
    speeds_ = command;
    note("step", dt);
  }
  double longestStep() const noexcept override { return 0.01; }
  State state() const noexcept override { return {}; }
  const RotorArray& rotorSpeeds() const noexcept override { return speeds_; }
  Eigen::Vector3d specificForce() const noexcept override { return Eigen::Vector3d::Zero(); }
  bool hasGround() const noexcept override { return false; }
  bool touching() const noexcept override { return false; }
  Crash crash() const noexcept override {
    return speeds_[0] > 0.0 ? Crash::kWallStrike : Crash::kNone;
  }
  void attach(const Payload& payload, const Eigen::Vector3d& velocity) override {
    payload_ = payload;
    note("attach", velocity.x());
  }
  FreeMotion detach() override {
    payload_.reset();
    note("detach", 0.0);
    return {{1.0, 2.0, 3.0}, {4.0, 5.0, 6.0}};
  }
  const std::optional<Payload>& payload() const noexcept override { return payload_; }
  FreeMotion payloadMotion() const noexcept override { return {}; }
  void setBody(double mass, const Eigen::Matrix3d&) override { note("body", mass); }
  double payloadMass() const noexcept override { return 0.0; }
  void setWind(const Eigen::Vector3d& velocity) noexcept override { note("wind", velocity.x()); }
  void setDisturbance(const ForceMoment& disturbance) noexcept override {
    note("disturbance", disturbance.force.x());
  }
  void setRotor(std::size_t index, const RotorCondition& condition) noexcept override {
    note(index == 2 ? "third rotor" : "rotor", condition.effectiveness);
  }
  void setSpeedLimit(double share) noexcept override { note("limit", share); }

 private:
  void note(const char* what, double value) { notes_.push_back(formatted("%s %g", what, value)); }

  Notes& notes_;
  std::optional<Payload> payload_;
  RotorArray speeds_;
};

TEST(TimedPlant, DrivesAnyPlant) {
  Scribe::Notes notes;
  const std::vector<Cargo> cargo = {
      {"box", test::box(0.5), Eigen::Vector3d(0.0, 0.0, -0.15), Eigen::Vector3d(0.25, 0.0, 0.0)}};
  TimedPlant plant(std::make_unique<Scribe>(notes), cargo, kMillisecond);
  plant.schedule({0, SetWind{{3.0, 0.0, 0.0}}});
  plant.schedule({0, SetBody{2.5, Eigen::Matrix3d::Identity()}});
  plant.schedule({0, SetRotor{3, {0.5, std::nullopt, 1.0}}});
  plant.schedule({0, AttachPayload{"box", {}}});
  plant.schedule(
      {kMillisecond, ApplyDisturbance{kMillisecond, {{7.0, 0.0, 0.0}, {0.0, 0.0, 0.0}}}});
  plant.schedule({3 * kMillisecond, DetachPayload{}});
  plant.advance(off(), kMillisecond);
  EXPECT_EQ(plant.attachedName(), "box");
  EXPECT_EQ(plant.wind().x(), 3.0);
  EXPECT_EQ(plant.rotors()[2].effectiveness, 0.5);
  EXPECT_TRUE(plant.rotors()[3].sound());
  plant.advance(off(), 4 * kMillisecond);
  EXPECT_EQ(notes, (Scribe::Notes{"wind 3", "body 2.5", "third rotor 0.5", "attach 0.25",
                                  "step 0.001", "disturbance 7", "step 0.001", "disturbance 0",
                                  "step 0.001", "detach 0", "step 0.001"}));
  EXPECT_FALSE(plant.crashTime());
  plant.advance(RotorArray::Constant(4, 1.0), 6 * kMillisecond);
  EXPECT_EQ(plant.crashTime(), 5 * kMillisecond);
  EXPECT_THROW(TimedPlant(std::make_unique<Scribe>(notes), {}, 11 * kMillisecond),
               std::invalid_argument)
      << "longer than its longest step";
}

TEST(TimedPlant, ALetGoPayloadMovesOnAsThePlantSays) {
  Scribe::Notes notes;
  TimedPlant plant(std::make_unique<Scribe>(notes), {}, kMillisecond);
  plant.schedule({0, AttachPayload{"box", test::box(0.5)}});
  plant.schedule({0, DetachPayload{}});
  plant.advance(off(), kMillisecond);
  ASSERT_EQ(plant.cargo().size(), 1u);
  EXPECT_EQ(plant.cargo()[0].name, "box");
  EXPECT_NEAR(plant.cargo()[0].position.x(), 1.004, 1e-12) << "after a step of free fall";
  EXPECT_EQ(plant.cargo()[0].velocity.x(), 4.0);
}

TEST(TimedPlant, CountsWholeSteps) {
  TimedPlant plant = plantAt(100.0, 5 * kMillisecond);
  EXPECT_EQ(plant.now(), 5 * kMillisecond);
  plant.advance(off(), 25 * kMillisecond);
  EXPECT_EQ(plant.now(), 25 * kMillisecond);
  EXPECT_NEAR(plant.plant().state().velocity.z(), -kGravity * 0.02, 1e-12);
  plant.advance(off(), 25 * kMillisecond);
  EXPECT_EQ(plant.now(), 25 * kMillisecond) << "nothing to do";
}

TEST(TimedPlant, DisturbancesAddUpForTheirTime) {
  TimedPlant plant = plantAt(100.0);
  const ForceMoment push{{2.0, 0.0, 0.0}, Eigen::Vector3d::Zero()};
  plant.schedule({10 * kMillisecond, ApplyDisturbance{20 * kMillisecond, push}});
  plant.schedule({20 * kMillisecond, ApplyDisturbance{5 * kMillisecond, push, 100.0}});
  plant.advance(off(), 10 * kMillisecond);
  EXPECT_EQ(plant.plant().state().velocity.x(), 0.0);
  plant.advance(off(), 15 * kMillisecond);
  EXPECT_NEAR(plant.plant().state().velocity.x(), 0.005, 1e-12) << "1 m/s^2 for 5 ms";
  plant.advance(off(), 23 * kMillisecond);
  EXPECT_NEAR(plant.disturbance().force.x(), 2.0 + 2.0 * std::sin(0.3), 1e-12);
  plant.advance(off(), 25 * kMillisecond);
  EXPECT_EQ(plant.disturbance().force.x(), 2.0);
  plant.advance(off(), 40 * kMillisecond);
  EXPECT_EQ(plant.disturbance().force.x(), 0.0);
  const double velocity = plant.plant().state().velocity.x();
  plant.advance(off(), 60 * kMillisecond);
  EXPECT_EQ(plant.plant().state().velocity.x(), velocity) << "nothing lingers";
}

TEST(TimedPlant, ABodyChangesWithoutAJerk) {
  TimedPlant plant = plantAt(100.0);
  const Eigen::Vector3d inertia(0.032, 0.030, 2.2e-4);  // as printed; of no rigid body
  plant.schedule({10 * kMillisecond, SetBody{2.5, inertia.asDiagonal()}});
  plant.schedule(
      {10 * kMillisecond, ApplyDisturbance{kMillisecond, {{0.0, 5.0, 0.0}, {0.0, 0.0, 2.2e-3}}}});
  plant.advance(off(), 11 * kMillisecond);
  EXPECT_NEAR(plant.plant().state().velocity.z(), -kGravity * 0.011, 1e-12);
  EXPECT_NEAR(plant.plant().state().velocity.y(), 2.0 * 0.001, 1e-12);
  EXPECT_NEAR(plant.plant().state().body_rate.z(), 10.0 * 0.001, 1e-12);
  EXPECT_EQ(plant.plant().payloadMass(), 0.5) << "of 2.5 kg";
}

TEST(TimedPlant, WithoutGroundNothingHoldsTheVehicle) {
  TimedPlant plant(rigid(test::pelican(), State(), false), {}, kMillisecond);
  plant.advance(off(), 1000 * kMillisecond);
  EXPECT_NEAR(plant.plant().state().position.z(), -0.5 * kGravity, 1e-9);
  EXPECT_FALSE(plant.crashTime());
}

TEST(TimedPlant, NeedsAPlantAndAPositiveStep) {
  for (const Nanoseconds step : {0, -1}) {
    EXPECT_THROW(TimedPlant(rigid(test::pelican(), State()), {}, step), std::invalid_argument);
  }
  EXPECT_THROW(TimedPlant(nullptr, {}, kMillisecond), std::invalid_argument);
}

TEST(TimedPlant, NeedsAStepThatKeepsTheVehicleOnItsFeet) {
  const Vehicle lifter = test::vehicleNamed("lifter");  // 1.7e-5 kg m^2
  const std::string reason = test::refusal<std::invalid_argument>(
      [&] { TimedPlant(rigid(lifter, State()), {}, kMillisecond); });
  EXPECT_EQ(reason.find("the plant's step is 0.001 s; it must be <= "), 0U) << reason;
  EXPECT_NO_THROW(TimedPlant(rigid(lifter, State(), false), {}, kMillisecond));
}

TEST(TimedPlant, EventsActExactlyAtTheirTime) {
  TimedPlant plant = plantAt(100.0);
  plant.schedule({20 * kMillisecond, AttachPayload{"box", test::box(0.5)}});
  plant.schedule({30 * kMillisecond, DetachPayload{}});
  plant.advance(off(), 20 * kMillisecond);
  EXPECT_FALSE(plant.plant().payload().has_value()) << "its step begins at 20 ms";
  // 2 kg that fell for 20 ms share their momentum with half a kilogram at rest.
  plant.advance(off(), 21 * kMillisecond);
  EXPECT_TRUE(plant.plant().payload().has_value());
  EXPECT_NEAR(plant.plant().state().velocity.z(), -kGravity * (0.8 * 0.02 + 0.001), 1e-12);
  plant.advance(off(), 30 * kMillisecond);
  EXPECT_TRUE(plant.plant().payload().has_value());
  plant.advance(off(), 31 * kMillisecond);
  EXPECT_FALSE(plant.plant().payload().has_value());
}

TEST(TimedPlant, EventsBetweenStepsActAtTheNextStep) {
  TimedPlant plant = plantAt(100.0);
  plant.schedule({20 * kMillisecond + 1, AttachPayload{"box", test::box(0.5)}});
  plant.advance(off(), 21 * kMillisecond);
  EXPECT_FALSE(plant.plant().payload().has_value());
  plant.advance(off(), 22 * kMillisecond);
  EXPECT_TRUE(plant.plant().payload().has_value());
}

TEST(TimedPlant, EventsActTheSameHoweverTheTimeIsCut) {
  TimedPlant once = plantAt(100.0);
  TimedPlant often = plantAt(100.0);
  for (TimedPlant* plant : {&once, &often}) {
    plant->schedule({7 * kMillisecond, SetWind{{3.0, 0.0, 0.0}}});
    plant->schedule({13 * kMillisecond, AttachPayload{"box", test::box(0.5)}});
  }
  const RotorArray command = RotorArray::Constant(4, 700.0);
  once.advance(command, 40 * kMillisecond);
  for (int i = 1; i <= 40; ++i) often.advance(command, i * kMillisecond);
  EXPECT_TRUE(test::sameBits(once.plant().state(), often.plant().state()));
}

TEST(TimedPlant, OverdueEventsActAtOnce) {
  TimedPlant plant = plantAt(100.0, 50 * kMillisecond);
  plant.schedule({10 * kMillisecond, AttachPayload{"box", test::box(0.5)}});
  plant.advance(off(), 51 * kMillisecond);
  EXPECT_TRUE(plant.plant().payload().has_value());
}

TEST(TimedPlant, EventsOfOneTimeKeepTheirOrder) {
  TimedPlant plant = plantAt(100.0);
  plant.schedule({10 * kMillisecond, AttachPayload{"box", test::box(0.5)}});
  plant.schedule({20 * kMillisecond, DetachPayload{}});
  plant.schedule({20 * kMillisecond, AttachPayload{"crate", test::box(0.9)}});
  plant.advance(off(), 21 * kMillisecond);
  ASSERT_TRUE(plant.plant().payload().has_value());
  EXPECT_EQ(plant.plant().payload()->mass, 0.9);
}

TEST(TimedPlant, PayloadEventsMustAlternate) {
  TimedPlant plant = plantAt(100.0);
  EXPECT_THROW(plant.schedule({0, DetachPayload{}}), std::logic_error);
  plant.schedule({20 * kMillisecond, AttachPayload{"box", test::box(0.5)}});
  EXPECT_THROW(plant.schedule({30 * kMillisecond, AttachPayload{"box", test::box(0.5)}}),
               std::logic_error);
  EXPECT_THROW(plant.schedule({10 * kMillisecond, DetachPayload{}}), std::logic_error);
  // A refused event leaves no trace.
  plant.schedule({30 * kMillisecond, DetachPayload{}});
  plant.schedule({40 * kMillisecond, AttachPayload{"crate", test::box(0.7)}});
  plant.advance(off(), 50 * kMillisecond);
  ASSERT_TRUE(plant.plant().payload().has_value());
  EXPECT_EQ(plant.plant().payload()->mass, 0.7);
  EXPECT_THROW(plant.schedule({0, AttachPayload{"box", test::box(0.5)}}), std::logic_error);
}

TEST(TimedPlant, TheBatterySagsLinearlyInItsTime) {
  Scribe::Notes notes;
  TimedPlant plant(std::make_unique<Scribe>(notes), {}, kMillisecond);
  plant.schedule({kMillisecond, SetBattery{0.8, 4 * kMillisecond}});
  plant.schedule({3 * kMillisecond, SetBattery{0.5, 0}});
  plant.schedule({4 * kMillisecond, SetBattery{1.0, 2 * kMillisecond}});
  plant.advance(off(), 8 * kMillisecond);
  const std::string step = "step 0.001";
  EXPECT_EQ(notes, (Scribe::Notes{step, "limit 1", step, "limit 0.95", step, "limit 0.5", step,
                                  "limit 0.5", step, "limit 0.75", step, "limit 1", step, step}));
  EXPECT_EQ(plant.battery(), 1.0);
}

TEST(TimedPlant, SwitchesTheRotorsOffAfterItsTimeOut) {
  State state;
  state.position.z() = 100.0;
  TimedPlant plant(rigid(test::pelican(), state), {}, kMillisecond, 0, 250 * kMillisecond);
  plant.command(RotorArray::Constant(4, 600.0));
  plant.advance(249 * kMillisecond);
  EXPECT_NEAR(plant.plant().rotorSpeeds()[0], 600.0, 1e-3);
  EXPECT_FALSE(plant.silent());
  plant.advance(250 * kMillisecond);
  EXPECT_NEAR(plant.plant().rotorSpeeds()[0], 600.0, 1e-3) << "held over the step before";
  EXPECT_TRUE(plant.silent());
  plant.advance(275 * kMillisecond);
  const double decay = std::exp(-0.025 / test::pelican().time_constant_down);
  EXPECT_NEAR(plant.plant().rotorSpeeds()[0], 600.0 * decay, 1e-3);
  plant.command(RotorArray::Constant(4, 600.0));
  EXPECT_FALSE(plant.silent());
  plant.advance(500 * kMillisecond);
  EXPECT_NEAR(plant.plant().rotorSpeeds()[0], 600.0, 1e-3);
}

TEST(TimedPlant, LosesCommandsFromTheVeryTimeOfTheEvent) {
  Scribe::Notes notes;
  TimedPlant plant(std::make_unique<Scribe>(notes), {}, kMillisecond);
  plant.schedule({2 * kMillisecond, LoseCommands{1.0, 3 * kMillisecond, 0}});
  for (int i = 0; i < 8; ++i) {
    plant.advance(RotorArray::Constant(4, i), (i + 1) * kMillisecond);
    EXPECT_EQ(plant.plant().rotorSpeeds()[0], i >= 2 && i < 5 ? 1.0 : i) << i;
  }
}

TEST(TimedPlant, RefusesRotorsThatTheVehicleDoesNotHave) {
  TimedPlant plant = plantAt(100.0);
  for (const int number : {0, 5}) {
    EXPECT_EQ(test::refusal([&] {
                plant.schedule({0, SetRotor{number, {}}});
              }),
              "rotor " + std::to_string(number) + " is none of the vehicle's; it must be 1 to 4");
  }
  EXPECT_NO_THROW(plant.schedule({0, SetRotor{4, {}}}));
}

TEST(TimedPlant, ADetachedPayloadFallsAndCanBePickedUpAgain) {
  TimedPlant plant = plantAt(100.0);
  plant.schedule({0, AttachPayload{"box", test::box(0.5)}});
  plant.schedule({10 * kMillisecond, DetachPayload{}});
  plant.advance(off(), 5 * kMillisecond);
  EXPECT_EQ(plant.attachedName(), "box");
  EXPECT_TRUE(plant.cargo().empty());
  plant.advance(RotorArray::Constant(4, 800.0), 200 * kMillisecond);
  ASSERT_EQ(plant.cargo().size(), 1u);
  EXPECT_EQ(plant.attachedName(), "");
  const Cargo& box = plant.cargo().front();
  EXPECT_NEAR(box.velocity.z(), -kGravity * 0.2, 0.05);
  EXPECT_LT(box.position.z(), plant.plant().state().position.z() - 0.15);
  // It moves with the vehicle's momentum when it is taken up in flight.
  const Eigen::Vector3d expected =
      (2.0 * plant.plant().state().velocity + 0.5 * box.velocity) / 2.5;
  ASSERT_EQ(plant.obstacle({"box", test::box(0.5)}), "");
  plant.schedule({0, AttachPayload{"box", test::box(0.5)}});
  plant.advance(off(), 201 * kMillisecond);
  EXPECT_EQ(plant.attachedName(), "box");
  EXPECT_TRUE(plant.cargo().empty());
  EXPECT_NEAR(plant.plant().state().velocity.z(), expected.z(), 0.05);
}

TEST(TimedPlant, WithoutGroundADetachedPayloadFallsOn) {
  TimedPlant plant(rigid(test::pelican(), State(), false), {}, kMillisecond);
  plant.schedule({0, AttachPayload{"box", test::box(0.5)}});
  plant.schedule({kMillisecond, DetachPayload{}});
  plant.advance(off(), 1001 * kMillisecond);
  ASSERT_EQ(plant.cargo().size(), 1u);
  EXPECT_NEAR(plant.cargo().front().velocity.z(), -kGravity * 1.001, 1e-9);
  EXPECT_LT(plant.cargo().front().position.z(), -4.9);
}

TEST(TimedPlant, RefusesToPickUpWhatIsOutOfReachAndSaysWhy) {
  State state;
  state.position.z() = 10.0;
  const std::vector<Cargo> cargo = {{"crate", test::box(0.5), {3.0, 0.0, 0.05}, {0.0, 0.0, 0.0}}};
  TimedPlant plant(rigid(test::pelican(), state), cargo, kMillisecond);
  plant.schedule({5 * kMillisecond, AttachPayload{"crate", test::box(0.5)}});
  plant.advance(off(), 20 * kMillisecond);
  EXPECT_FALSE(plant.plant().payload().has_value());
  ASSERT_EQ(plant.refusals().size(), 1u);
  EXPECT_EQ(plant.refusals()[0].time, 5 * kMillisecond);
  EXPECT_NE(plant.refusals()[0].reason.find("crate is"), std::string::npos);
  EXPECT_NE(plant.refusals()[0].reason.find("within 0.50 m"), std::string::npos);
  EXPECT_EQ(plant.cargo().size(), 1u);
}

TEST(TimedPlant, ReportsACrashWithItsTime) {
  TimedPlant plant = plantAt(1.0);
  plant.advance(off(), 428 * kMillisecond);
  EXPECT_FALSE(plant.crashTime().has_value());
  plant.advance(off(), 2000 * kMillisecond);
  // The feet reach 0.101 m below the origin: sqrt(2 * 0.899 / 9.81) = 0.4281 s.
  ASSERT_TRUE(plant.crashTime().has_value());
  EXPECT_EQ(*plant.crashTime(), 429 * kMillisecond);
  EXPECT_EQ(plant.plant().crash(), Crash::kHardImpact);
}

}  // namespace
}  // namespace aqc
