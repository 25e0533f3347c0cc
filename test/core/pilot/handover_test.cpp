#include "adaptive_quadrotor_control/pilot/handover.h"
#include "adaptive_quadrotor_control/parameters/parameter_reader.h"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <utility>

#include "adaptive_quadrotor_control/pilot/flight_controller.h"
#include "adaptive_quadrotor_control/simulation/rigid_plant.h"
#include "support/fixtures.h"

namespace aqc {
namespace {

constexpr double kStep = 0.004;  // [s]
constexpr double kPlantStep = 0.001;

// A vehicle that hovers under one law.
class Flight {
 public:
  explicit Flight(const std::string& law, double payload = 0.0,
                  const std::string& vehicle = "pelican_thesis", int plant_steps = 4)
      : vehicle_(test::vehicleNamed(vehicle)),
        plant_steps_(plant_steps),
        controller_(vehicle_, test::lawNamed(law, vehicle_)),
        plant_(vehicle_, start()) {
    set_point_.position.z() = 2.0;
    if (payload > 0.0) plant_.attach(test::box(payload));
    fly(40.0);
  }
  void fly(double seconds) {
    const double step = plant_steps_ * kPlantStep;
    for (int i = 0; i < std::lround(seconds / step); ++i) {
      controller_.step({plant_.state()}, &set_point_, step);
      for (int k = 0; k < plant_steps_; ++k)
        plant_.step(controller_.allocation().speeds, kPlantStep);
      lowest_ = std::min(lowest_, plant_.state().position.z());
    }
  }
  std::string change(const std::string& law) {
    const std::string obstacle =
        handoverObstacle(controller_.law().telemetry(), controller_.allocation().saturated);
    if (obstacle.empty()) controller_.replaceLaw(test::lawNamed(law, vehicle_));
    lowest_ = height();
    return obstacle;
  }

  double height() const { return plant_.state().position.z(); }
  double lowest() const { return lowest_; }
  const Vehicle& vehicle() const { return vehicle_; }
  FlightController& controller() { return controller_; }
  State state() const { return plant_.state(); }
  Crash crash() const { return plant_.crash(); }
  const SetPoint& setPoint() const { return set_point_; }

 private:
  static State start() {
    State state;
    state.position.z() = 1.5;
    return state;
  }
  const Vehicle vehicle_;
  const int plant_steps_;  // of a control step
  FlightController controller_;
  RigidPlant plant_;
  SetPoint set_point_;
  double lowest_ = 10.0;
};

TEST(Handover, SameLawWithTheSameGainsChangesNoBit) {
  for (const std::string law : {"asmc", "smc", "geometric", "switched", "integral", "l1"}) {
    // The lag of rotors at this rate topples what the switched law flies
    // (docs/switched_control.md).
    const bool ideal = law == "switched";
    const std::string vehicle = ideal ? "lifter" : "pelican_thesis";
    Flight one(law, 0.0, vehicle, ideal ? 1 : 4);
    Flight other(law, 0.0, vehicle, ideal ? 1 : 4);
    other.controller().replaceLaw(test::lawNamed(law, other.vehicle()));
    one.fly(2.0);
    other.fly(2.0);
    ASSERT_EQ(one.crash(), Crash::kNone) << law;
    ASSERT_EQ(other.crash(), Crash::kNone) << law;
    EXPECT_TRUE(test::sameBits(one.state(), other.state())) << law;
    EXPECT_TRUE(test::sameBits(one.controller().law().telemetry().adaptive,
                               other.controller().law().telemetry().adaptive))
        << law;
  }
}

TEST(Handover, TheNewLawFliesAndTheOldOneComesBack) {
  const Vehicle vehicle = test::pelican();
  FlightController controller(vehicle, test::lawNamed("asmc", vehicle));
  const ControlLaw* old = &controller.law();
  std::unique_ptr<ControlLaw> law = test::lawNamed("geometric", vehicle);
  const ControlLaw* next = law.get();
  law = controller.replaceLaw(std::move(law));
  EXPECT_EQ(law.get(), old);
  EXPECT_EQ(&controller.law(), next);
  FlightController fresh(vehicle, test::lawNamed("geometric", vehicle));
  SetPoint above;
  above.position.z() = 2.0;
  EXPECT_TRUE(test::sameBits(controller.step({}, &above, kStep).speeds,
                             fresh.step({}, &above, kStep).speeds));
}

TEST(Handover, NewGainsDoNotMakeTheAdaptiveStateJump) {
  Flight flight("asmc", 0.5);
  const Telemetry before = flight.controller().law().telemetry();
  YAML::Node gains = loadYamlFile(test::configFile("controller/asmc"));
  gains["position"]["slope"][0] = 2.0;
  gains["mass_estimate"]["leak"] = 0.05;
  flight.controller().replaceLaw(makeLaw(ParameterReader(gains, "gains"), flight.vehicle()));
  const Telemetry& after = flight.controller().law().telemetry();
  EXPECT_EQ(after.mass_estimate, before.mass_estimate);
  EXPECT_TRUE(test::sameBits(after.adaptive, before.adaptive));
}

struct Change {
  const char* from;
  const char* to;
  double payload;  // [kg]
  double drop;     // allowed, on top of the other law's own steady error [m]
};

class LawChange : public ::testing::TestWithParam<Change> {};

// The wrench right after may differ only by what the new law answers to the errors there are; the
// weight it holds up is the one the old law held up.
TEST_P(LawChange, DoesNotDropTheVehicle) {
  const Change& change = GetParam();
  Flight flight(change.from, change.payload);
  const double before = flight.controller().allocation().requested.thrust;
  const double height = flight.height();
  ASSERT_EQ(flight.change(change.to), "");
  flight.controller().step({flight.state()}, &flight.setPoint(), kStep);
  const double after = flight.controller().allocation().requested.thrust;
  EXPECT_NEAR(after, before, 0.25 * before) << "at once";
  flight.fly(10.0);
  EXPECT_GT(flight.lowest(), height - change.drop);
}

INSTANTIATE_TEST_SUITE_P(
    Handover, LawChange,
    ::testing::Values(Change{"geometric", "asmc", 0.0, 0.05}, Change{"smc", "asmc", 0.4, 0.1},
                      Change{"geometric", "asmc", 0.15, 0.05},
                      Change{"asmc", "geometric", 0.0, 0.05}, Change{"asmc", "smc", 0.3, 0.1},
                      Change{"geometric", "smc", 0.0, 0.05}, Change{"asmc", "integral", 0.3, 0.1},
                      Change{"asmc", "l1", 0.3, 0.1}, Change{"integral", "asmc", 0.3, 0.1},
                      Change{"l1", "asmc", 0.3, 0.1}));

TEST(Handover, IsRefusedWhereNoLawIsSure) {
  Telemetry calm;
  EXPECT_EQ(handoverObstacle(calm, false), "");
  EXPECT_NE(handoverObstacle(calm, true).find("saturated"), std::string::npos);
  Telemetry far;
  far.position_error.x() = 0.7;
  EXPECT_EQ(handoverObstacle(far, false),
            "the position error is 0.70 m; at most 0.50 m is allowed");
  Telemetry fast;
  fast.velocity_error.y() = -1.0;
  EXPECT_NE(handoverObstacle(fast, false).find("velocity"), std::string::npos);
  Telemetry tilted;
  tilted.attitude_error.x() = 0.4;
  EXPECT_NE(handoverObstacle(tilted, false).find("attitude"), std::string::npos);
}

TEST(Handover, OnTheGroundTheNewLawBeginsAnew) {
  const Vehicle vehicle = test::pelican();
  FlightController controller(vehicle, test::lawNamed("asmc", vehicle));
  SetPoint above;
  above.position.z() = 2.0;
  for (int i = 0; i < 100; ++i) controller.step({}, &above, kStep);
  controller.step({}, nullptr, kStep);
  controller.replaceLaw(test::lawNamed("asmc", vehicle));
  EXPECT_TRUE(test::sameBits(controller.law().telemetry().adaptive,
                             test::lawNamed("asmc", vehicle)->telemetry().adaptive));
}

}  // namespace
}  // namespace aqc
