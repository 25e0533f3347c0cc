#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>
#include <utility>

#include "adaptive_quadrotor_control/simulation/closed_loop.h"
#include "adaptive_quadrotor_control/simulation/scenario.h"
#include "support/fixtures.h"

// What docs/composite.md says of the law's flights, each with the one set of gains.
namespace aqc {
namespace {

/// At 250 Hz and at rest in a hover at 2 m.
Scenario hover(double seconds) {
  Scenario scenario;
  scenario.duration = fromSeconds(seconds);
  scenario.world.control_period = 4'000'000;
  scenario.world.plant_step = 1'000'000;
  scenario.world.start.position.z() = 2.0;
  TimedSetPoint place;
  place.set_point.position.z() = 2.0;
  scenario.mission.set_points = {place};
  return scenario;
}

Scenario carrying(double mass, double aside) {
  Scenario scenario = hover(40.0);
  AttachPayload attach;
  attach.payload = test::box(mass);
  attach.payload.offset.x() = aside;
  scenario.mission.events = {{fromSeconds(10.0), attach}, {fromSeconds(25.0), DetachPayload{}}};
  return scenario;
}

Scenario circling(double rate, double mass) {
  Scenario scenario = hover(30.0);
  scenario.mission.set_points.clear();
  for (Nanoseconds time = 0; time < scenario.duration; time += scenario.world.control_period) {
    const double angle = rate * toSeconds(time);
    const Eigen::Vector3d out(std::cos(angle), std::sin(angle), 0.0);
    const Eigen::Vector3d along(-out.y(), out.x(), 0.0);
    SetPoint point;
    point.position = 2.0 * out + Eigen::Vector3d(0.0, 0.0, 2.0);
    point.velocity = 2.0 * rate * along;
    point.acceleration = -2.0 * rate * rate * out;
    point.jerk = -2.0 * rate * rate * rate * along;
    scenario.mission.set_points.push_back({time, point});
  }
  scenario.world.start.position.x() = 2.0;
  if (mass > 0.0) {
    AttachPayload attach;
    attach.payload = test::box(mass);
    scenario.mission.events = {{fromSeconds(5.0), attach}};
  }
  return scenario;
}

Scenario blown() {
  Scenario scenario = hover(30.0);
  SetWind wind;
  wind.velocity.x() = 8.0;
  scenario.mission.events = {{fromSeconds(10.0), wind}};
  return scenario;
}

/// The sensors as they are, but the IMU is silent, or odometry is late.
Scenario sensing(Scenario scenario, bool imu, Nanoseconds delay) {
  SensorFaults faults;
  faults.odometry.period = faults.imu.period = scenario.world.control_period;
  faults.odometry.delay = delay;
  if (!imu) faults.imu.gaps = {TimeWindow()};
  scenario.world.sensors = faults;
  return scenario;
}

struct Errors {
  double z = 0.0;     // largest ones [cm]
  double side = 0.0;  // horizontally
  double square = 0.0;
  int count = 0;
  double rms() const { return std::sqrt(square / count); }
};

/// The true errors of a flight within a window [s].
class Flown {
 public:
  Flown(const Scenario& scenario, const std::string& vehicle) {
    const Vehicle airframe = test::vehicleNamed(vehicle);
    ClosedLoop loop(scenario, airframe, test::lawNamed("composite", airframe));
    while (!loop.done()) {
      const Eigen::Vector3d position = loop.plant().plant().state().position;
      loop.advance();
      errors_.push_back(100.0 * (position - loop.pilot().goal().position));
      heaviest_ = std::max(heaviest_, loop.pilot().law().telemetry().mass_estimate);
    }
    period_ = toSeconds(scenario.world.control_period);
    crashed_ = loop.plant().crashTime().has_value();
  }
  Errors within(double from, double until) const {
    Errors errors;
    for (std::size_t i = static_cast<std::size_t>(from / period_);
         i < std::min(errors_.size(), static_cast<std::size_t>(until / period_)); ++i) {
      errors.z = std::max(errors.z, std::abs(errors_[i].z()));
      errors.side = std::max(errors.side, errors_[i].head<2>().norm());
      errors.square += errors_[i].squaredNorm();
      ++errors.count;
    }
    return errors;
  }
  bool crashed() const { return crashed_; }
  double heaviest() const { return heaviest_; }

 private:
  std::vector<Eigen::Vector3d> errors_;
  double period_ = 0.0;
  double heaviest_ = 0.0;
  bool crashed_ = false;
};

struct Limits {
  double peak, settled, drop, side;  // [cm]
};

void expectCarried(const char* what, const Scenario& scenario, const std::string& vehicle,
                   const Limits& limits) {
  const Flown flown(scenario, vehicle);
  const Errors peak = flown.within(10.0, 20.0);
  const Errors settled = flown.within(20.0, 25.0);
  const Errors drop = flown.within(25.0, 40.0);
  std::printf("%s, %s: peak %.2f settled %.3f drop %.2f, aside %.2f settled %.3f drop %.2f cm\n",
              what, vehicle.c_str(), peak.z, settled.z, drop.z, peak.side, settled.side, drop.side);
  EXPECT_FALSE(flown.crashed()) << what;
  EXPECT_LT(peak.z, limits.peak) << what;
  EXPECT_LT(std::max(settled.z, settled.side), limits.settled) << what;
  EXPECT_LT(drop.z, limits.drop) << what;
  EXPECT_LT(std::max(peak.side, drop.side), limits.side) << what;
}

TEST(CompositeFlight, CarriesWhatItIsHanded) {
  expectCarried("0.4 kg", carrying(0.4, 0.0), "pelican", {0.6, 0.1, 1.1, 0.01});
  expectCarried("0.6 kg", carrying(0.6, 0.0), "pelican", {0.8, 0.1, 1.6, 0.01});
  expectCarried("0.6 kg, 3 cm", carrying(0.6, 0.03), "pelican", {1.0, 0.1, 1.6, 1.2});
}

TEST(CompositeFlight, DoesSoWithoutAnImuAndWithLateOdometry) {
  constexpr Nanoseconds kLate = 20'000'000;
  expectCarried("0.4 kg, no IMU", sensing(carrying(0.4, 0.0), false, 0), "pelican",
                {3.0, 0.1, 2.5, 0.1});
  expectCarried("0.4 kg, 20 ms late", sensing(carrying(0.4, 0.0), true, kLate), "pelican",
                {1.0, 0.1, 1.5, 0.1});
  expectCarried("0.4 kg, 3 cm, 20 ms late", sensing(carrying(0.4, 0.03), true, kLate), "pelican",
                {1.0, 0.1, 1.5, 1.6});
}

TEST(CompositeFlight, CarriesUnderEveryVehicleWithOneSetOfGains) {
  for (const char* vehicle : {"hummingbird", "firefly", "pelican_thesis", "pelican"}) {
    const double mass = test::vehicleNamed(vehicle).mass;
    expectCarried("40 %", carrying(0.4 * mass, 0.0), vehicle, {1.0, 0.1, 1.5, 0.1});
  }
}

TEST(CompositeFlight, FliesCircles) {
  const Flown slow(circling(0.6, 0.0), "pelican");
  const Flown fast(circling(1.0, 0.3), "pelican");
  const Errors slow_error = slow.within(10.0, 30.0);
  const Errors fast_error = fast.within(10.0, 30.0);
  std::printf("circle 0.6: %.2f cm, 1.0 with 0.3 kg: %.2f cm rms\n", slow_error.rms(),
              fast_error.rms());
  EXPECT_LT(slow_error.rms(), 0.3);
  EXPECT_LT(fast_error.rms(), 0.6);
}

TEST(CompositeFlight, HoldsAgainstWind) {
  for (const bool imu : {true, false}) {
    const Flown flown(sensing(blown(), imu, 0), "pelican");
    const Errors peak = flown.within(10.0, 20.0);
    const Errors settled = flown.within(25.0, 30.0);
    std::printf("wind 8 m/s, IMU %d: peak %.2f settled %.3f cm\n", imu, peak.side, settled.side);
    EXPECT_LT(peak.side, imu ? 3.5 : 4.0);
    EXPECT_LT(settled.side, 0.1);
  }
}

// With 838 rad/s the thrust is 1.14 times the weight.
TEST(CompositeFlight, FliesScenario1WithHardlyAnyThrustLeft) {
  Scenario scenario = loadScenario(test::configFile("scenario/aggressive_manoeuvre"));
  Vehicle weak = test::pelican();
  weak.max_rotor_speed = 838.0;
  ClosedLoop loop(scenario, weak, test::lawNamed("composite", weak));
  Eigen::Vector3d square = Eigen::Vector3d::Zero();
  int count = 0;
  double heaviest = 0.0;
  while (!loop.done()) {
    const bool counts = loop.plant().now() >= scenario.metrics_from;
    loop.advance();
    const Telemetry& seen = loop.pilot().law().telemetry();
    heaviest = std::max(heaviest, seen.mass_estimate);
    if (!counts) continue;
    square += seen.position_error.cwiseAbs2();
    ++count;
  }
  const Eigen::Vector3d rms = 100.0 * (square / count).cwiseSqrt();
  std::printf("scenario 1 at 838 rad/s: %.1f %.1f %.1f cm, at most %.2f kg\n", rms.x(), rms.y(),
              rms.z(), heaviest);
  EXPECT_FALSE(loop.plant().crashTime());
  EXPECT_LT(rms.x(), 1.15 * 33.2);
  EXPECT_LT(rms.y(), 1.15 * 45.5);
  EXPECT_LT(rms.z(), 1.15 * 41.5);
  EXPECT_LT(heaviest, 1.1 * 2.5);
}

}  // namespace
}  // namespace aqc
