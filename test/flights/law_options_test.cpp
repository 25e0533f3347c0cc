#include <gtest/gtest.h>
#include <yaml-cpp/yaml.h>

#include <cmath>
#include <deque>
#include <iostream>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "adaptive_quadrotor_control/math/rotations.h"
#include "adaptive_quadrotor_control/parameters/parameter_reader.h"
#include "adaptive_quadrotor_control/pilot/pilot.h"
#include "adaptive_quadrotor_control/simulation/scenario.h"
#include "adaptive_quadrotor_control/simulation/timed_plant.h"
#include "support/fixtures.h"

// What the options of config/controller/asmc.yaml that the thesis does not have are good for.
namespace aqc {
namespace {

std::unique_ptr<ControlLaw> made(const YAML::Node& gains) {
  return makeLaw(ParameterReader(gains, "gains"), test::pelican());
}

YAML::Node asmcGains() {
  return loadYamlFile(test::configFile("controller/asmc"));
}

/// The law flies a scenario; what it commands reaches the rotors `delay` later.
class DelayedFlight {
 public:
  DelayedFlight(const Scenario& scenario, std::unique_ptr<ControlLaw> law, Nanoseconds delay)
      : scenario_(scenario),
        delay_(delay),
        plant_(makePlant(test::pelican(), scenario.world), scenario.world.cargo,
               scenario.world.plant_step),
        pilot_(test::pelican(), std::move(law), scenario.world.control_period,
               StepClock::Trigger::kOdometry),
        speeds_(RotorArray::Zero(static_cast<Eigen::Index>(test::pelican().rotors.size()))) {
    for (const PlantEvent& event : scenario.mission.events) plant_.schedule(event);
  }

  Pilot& pilot() { return pilot_; }
  State state() const { return plant_.plant().state(); }

  /// Time of a crash.
  std::optional<Nanoseconds> flyUntil(Nanoseconds end) {
    while (plant_.now() < end && !plant_.crashTime()) step();
    return plant_.crashTime();
  }

 private:
  void step() {
    const Nanoseconds now = plant_.now();
    if (now % scenario_.world.control_period == 0) {
      pilot_.hear(state(), now, now);
      commands_.emplace_back(now + delay_, pilot_.allocation().speeds);
    }
    if (!commands_.empty() && commands_.front().first <= now) {
      speeds_ = commands_.front().second;
      commands_.pop_front();
    }
    plant_.advance(speeds_, now + scenario_.world.plant_step);
  }

  Scenario scenario_;
  Nanoseconds delay_;
  TimedPlant plant_;
  Pilot pilot_;
  std::deque<std::pair<Nanoseconds, RotorArray>> commands_;
  RotorArray speeds_;  // told to the rotors
};

/// When scenario 1 of the thesis crashes at 100 Hz.
std::optional<Nanoseconds> crashOfManoeuvre(const YAML::Node& gains, int delay_ms) {
  const Scenario scenario = loadScenario(test::configFile("scenario/aggressive_manoeuvre"));
  DelayedFlight flight(scenario, made(gains), fromSeconds(1e-3 * delay_ms));
  flight.pilot().plan(scenario.mission.set_points, 0, 0);
  return flight.flyUntil(scenario.duration);
}

YAML::Node limited(double most_moment) {
  YAML::Node gains = asmcGains();
  gains["attitude"]["most_moment"] = most_moment;
  return gains;
}

TEST(MostMoment, LetsScenario1BearADelay) {
  EXPECT_FALSE(crashOfManoeuvre(asmcGains(), 0).has_value());
  EXPECT_TRUE(crashOfManoeuvre(asmcGains(), 10).has_value()) << "as printed";
  EXPECT_FALSE(crashOfManoeuvre(limited(0.3), 0).has_value());
  EXPECT_FALSE(crashOfManoeuvre(limited(0.3), 20).has_value());
}

// The table of docs/tuning.md: --gtest_also_run_disabled_tests --gtest_filter='*DelayTable*'.
TEST(MostMoment, DISABLED_DelayTable) {
  for (const double most : {0.0, 1.0, 0.5, 0.3, 0.2, 0.1}) {
    std::cout << (most > 0.0 ? "most_moment " + std::to_string(most) : "as printed") << ':';
    for (const int delay : {0, 2, 4, 5, 6, 8, 10, 15, 20, 25, 30, 35, 40, 50}) {
      const auto crash = crashOfManoeuvre(most > 0.0 ? limited(most) : asmcGains(), delay);
      std::cout << ' ' << delay << " ms ";
      if (crash) {
        std::cout << "crashes at " << toSeconds(*crash) << " s,";
      } else {
        std::cout << "flies,";
      }
    }
    std::cout << '\n';
  }
}

/// What is left of a heading that is wrong by 180 deg after some seconds at hover [rad].
double headingLeft(const std::string& law, const std::string& kind) {
  YAML::Node gains = loadYamlFile(test::configFile("controller/" + law));
  gains["attitude_error"] = kind;
  const Scenario scenario = loadScenario(test::configFile("scenario/hover_payload"));
  DelayedFlight flight(scenario, made(gains), 0);
  TimedSetPoint hover;
  hover.set_point.position = {0.0, 0.0, 1.5};
  TimedSetPoint turned = hover;
  turned.time = fromSeconds(4.0);
  turned.set_point.yaw = M_PI;
  flight.pilot().plan({hover, turned}, 0, 0);
  EXPECT_FALSE(flight.flyUntil(fromSeconds(12.0)).has_value()) << law;
  EXPECT_LT((flight.state().position - hover.set_point.position).norm(), 1.0) << law;
  return M_PI - std::abs(rollPitchYaw(flight.state().attitude).z());
}

TEST(AttitudeErrorOption, TurnsBackFromExactlyAHalfTurn) {
  for (const char* law : {"asmc", "smc", "geometric"}) {
    EXPECT_GT(headingLeft(law, "thesis"), 3.0) << law << " stays where the error vanishes";
    EXPECT_LT(headingLeft(law, "quaternion"), 0.1) << law;
  }
}

}  // namespace
}  // namespace aqc
