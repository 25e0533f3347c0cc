#include "report/flight_csv.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "adaptive_quadrotor_control/simulation/flight_simulation.h"
#include "report/flight_columns.h"
#include "support/fixtures.h"

namespace aqc {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

template <class Vector>
void expectSame(const Vector& a, const Vector& b, const char* what, std::size_t i) {
  EXPECT_TRUE(test::sameBits(a, b)) << what << " of sample " << i;
}

void expectSame(double a, double b, const char* what, std::size_t i) {
  expectSame(Eigen::Matrix<double, 1, 1>(a), Eigen::Matrix<double, 1, 1>(b), what, i);
}

void expectSame(const Telemetry& a, const Telemetry& b, std::size_t i) {
  expectSame(a.position_error, b.position_error, "position error", i);
  expectSame(a.velocity_error, b.velocity_error, "velocity error", i);
  expectSame(a.attitude_error, b.attitude_error, "attitude error", i);
  expectSame(a.rate_error, b.rate_error, "rate error", i);
  expectSame(a.sliding_position, b.sliding_position, "s_p", i);
  expectSame(a.sliding_attitude, b.sliding_attitude, "s_q", i);
  expectSame(a.force, b.force, "force", i);
  expectSame(a.desired_attitude.coeffs(), b.desired_attitude.coeffs(), "desired attitude", i);
  expectSame(a.adaptive, b.adaptive, "adaptive quantities", i);
  if (!std::isnan(a.mass_estimate) || !std::isnan(b.mass_estimate)) {
    expectSame(a.mass_estimate, b.mass_estimate, "mass estimate", i);
  }
}

void expectSame(const FlightSample& a, const FlightSample& b, std::size_t i) {
  EXPECT_EQ(a.time, b.time) << i;
  EXPECT_TRUE(test::sameBits(a.state, b.state)) << "state of sample " << i;
  EXPECT_EQ(a.flying, b.flying) << i;
  expectSame(a.set_point.position, b.set_point.position, "set point", i);
  expectSame(a.set_point.velocity, b.set_point.velocity, "its velocity", i);
  expectSame(a.set_point.acceleration, b.set_point.acceleration, "its acceleration", i);
  expectSame(a.set_point.yaw, b.set_point.yaw, "its yaw", i);
  expectSame(a.set_point.yaw_rate, b.set_point.yaw_rate, "its yaw rate", i);
  expectSame(a.telemetry, b.telemetry, i);
  expectSame(a.allocation.speeds, b.allocation.speeds, "rotor speeds", i);
  expectSame(a.allocation.requested.thrust, b.allocation.requested.thrust, "thrust", i);
  expectSame(a.allocation.requested.moment, b.allocation.requested.moment, "moment", i);
  expectSame(a.allocation.achieved.thrust, b.allocation.achieved.thrust, "achieved thrust", i);
  expectSame(a.allocation.achieved.moment, b.allocation.achieved.moment, "achieved moment", i);
  EXPECT_EQ(a.allocation.saturated, b.allocation.saturated) << i;
  expectSame(a.payload_mass, b.payload_mass, "payload", i);
  EXPECT_EQ(a.touching, b.touching) << i;
  expectSame(a.disturbance.force, b.disturbance.force, "disturbing force", i);
  expectSame(a.disturbance.moment, b.disturbance.moment, "disturbing moment", i);
}

void expectComesBack(const FlightLog& log) {
  const FlightLog back = parseFlightCsv(flightCsv(log), "it.csv");
  EXPECT_EQ(back.adaptive_quantities, log.adaptive_quantities);
  EXPECT_EQ(back.crash_time, log.crash_time);
  EXPECT_EQ(back.crash_reason, log.crash_reason);
  ASSERT_EQ(back.samples.size(), log.samples.size());
  for (std::size_t i = 0; i < log.samples.size(); ++i) {
    expectSame(log.samples[i], back.samples[i], i);
    if (::testing::Test::HasFailure()) return;  // one sample tells enough
  }
}

// Numbers of every size, so that all digits matter.
double wild(test::Dice& dice) {
  return std::ldexp(dice.between(-1.0, 1.0), dice.index(80) - 40);
}

Eigen::Vector3d wildVector(test::Dice& dice) {
  return {wild(dice), wild(dice), wild(dice)};
}

FlightSample wildSample(test::Dice& dice, Eigen::Index adaptive, Eigen::Index rotors) {
  FlightSample s;
  s.state = {wildVector(dice), wildVector(dice), dice.attitude(), wildVector(dice)};
  s.flying = dice.index(3) > 0;
  if (s.flying) {
    s.set_point.position = wildVector(dice);
    s.set_point.velocity = wildVector(dice);
    s.set_point.acceleration = wildVector(dice);
    s.set_point.yaw = wild(dice);
    s.set_point.yaw_rate = wild(dice);
    Telemetry& t = s.telemetry;
    for (Eigen::Vector3d* vector :
         {&t.position_error, &t.velocity_error, &t.attitude_error, &t.rate_error,
          &t.sliding_position, &t.sliding_attitude, &t.force}) {
      *vector = wildVector(dice);
    }
    t.desired_attitude = dice.attitude();
  }
  s.telemetry.mass_estimate = dice.index(2) == 0 ? kNan : wild(dice);
  s.telemetry.adaptive = AdaptiveValues::NullaryExpr(adaptive, [&] { return wild(dice); });
  s.allocation.speeds = RotorArray::NullaryExpr(rotors, [&] { return wild(dice); });
  s.allocation.requested = {wild(dice), wildVector(dice)};
  s.allocation.achieved = {wild(dice), wildVector(dice)};
  s.allocation.saturated = dice.index(2) == 0;
  s.payload_mass = wild(dice);
  s.touching = dice.index(2) == 0;
  s.disturbance = {wildVector(dice), wildVector(dice)};
  return s;
}

FlightLog wildLog(unsigned seed) {
  test::Dice dice(seed);
  FlightLog log;
  const int adaptive = seed == 0 ? kMaxAdaptive : dice.index(8);
  const int rotors = seed == 0 ? kMaxRotors : 4 + dice.index(5);
  for (int i = 0; i < adaptive; ++i)
    log.adaptive_quantities.push_back({"K[" + std::to_string(i) + "]", ""});
  Nanoseconds time = dice.index(1'000'000'000);
  for (int i = 0; i < 1 + dice.index(20); ++i) {
    log.samples.push_back(wildSample(dice, adaptive, rotors));
    log.samples.back().time = time;
    time += 1 + dice.index(2'000'000'000);
  }
  if (dice.index(2) == 0) log.crash_time = time + dice.index(1000);
  if (log.crash_time) log.crash_reason = "wall strike";
  return log;
}

TEST(FlightCsv, AnyFlightComesBackBitForBit) {
  for (unsigned seed = 0; seed < 200; ++seed) {
    expectComesBack(wildLog(seed));
    ASSERT_FALSE(HasFailure()) << "seed " << seed;
  }
}

TEST(FlightCsv, FlownFlightsComeBackBitForBit) {
  struct Flight {
    const char* scenario;
    const char* law;
    bool crashes;
  };
  for (const Flight& flight :
       {Flight{"hover_payload", "asmc", false}, Flight{"payload_transport", "geometric", true},
        Flight{"vertical_lift", "switched", false}}) {
    SCOPED_TRACE(flight.scenario);
    const Scenario scenario =
        loadScenario(test::configFile(std::string("scenario/") + flight.scenario));
    const Vehicle vehicle = test::vehicleNamed(scenario.vehicle);
    FlightLog log = fly(scenario, vehicle, flight.law, test::lawNamed(flight.law, vehicle), {});
    for (AdaptiveQuantity& quantity : log.adaptive_quantities)
      quantity.unit = "";  // not in the CSV
    EXPECT_EQ(log.crash_time.has_value(), flight.crashes);
    expectComesBack(log);
  }
}

TEST(FlightCsv, NothingAndInfinityComeBack) {
  FlightLog log = wildLog(1);
  log.samples[0].flying = true;
  log.samples[0].telemetry.adaptive.setConstant(1.0);
  log.samples[0].state.position.x() = kNan;
  log.samples[0].telemetry.position_error = {kNan, INFINITY, -INFINITY};
  log.samples[0].telemetry.adaptive[0] = kNan;
  const FlightSample back = parseFlightCsv(flightCsv(log), "it.csv").samples[0];
  EXPECT_TRUE(std::isnan(back.state.position.x()));
  EXPECT_TRUE(std::isnan(back.telemetry.position_error.x()));
  EXPECT_EQ(back.telemetry.position_error.y(), INFINITY);
  EXPECT_EQ(back.telemetry.position_error.z(), -INFINITY);
  EXPECT_TRUE(std::isnan(back.telemetry.adaptive[0]));
  EXPECT_EQ(back.telemetry.adaptive.tail(back.telemetry.adaptive.size() - 1).minCoeff(), 1.0);
}

TEST(FlightCsv, LineEndsOfWindowsAreRead) {
  const FlightLog log = wildLog(2);
  std::string text;
  for (const char c : flightCsv(log)) text += c == '\n' ? std::string("\r\n") : std::string(1, c);
  EXPECT_EQ(flightCsv(parseFlightCsv(text, "it.csv")), flightCsv(log));
}

// What is said about a text.
std::string refusal(const std::string& text) {
  try {
    parseFlightCsv(text, "it.csv");
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  return "";
}

std::string replaced(std::string text, const std::string& old, const std::string& with) {
  const std::size_t at = text.find(old);
  EXPECT_NE(at, std::string::npos) << old;
  return at == std::string::npos ? text : text.replace(at, old.size(), with);
}

// Two samples; the second line begins with "0,0,", the third with "0.5,0,".
std::string plain() {
  FlightLog log;
  log.samples.resize(2);
  log.samples[1].time = 500'000'000;
  return flightCsv(log);
}

TEST(FlightCsv, WhatIsBrokenIsRefusedByLine) {
  EXPECT_EQ(refusal(plain()), "");
  EXPECT_EQ(refusal(""), "'it.csv', line 1: is empty; it must hold a flight as fly writes it");
  const std::string header = plain().substr(0, plain().find('\n') + 1);
  EXPECT_EQ(refusal(header), "'it.csv', line 1: ends; there must be a line a sample");
  EXPECT_EQ(refusal(replaced(plain(), ",y [m],", ",")),
            "'it.csv', line 1: column 'y [m]' is missing; 'z [m]' stands there");
  EXPECT_EQ(refusal(replaced(plain(), ",flying\n", "\n")),
            "'it.csv', line 1: column 'flying' is missing");
  EXPECT_EQ(refusal(replaced(plain(), ",flying\n", ",flying,colour\n")),
            "'it.csv', line 1: column 'colour' is unknown");
  EXPECT_EQ(refusal("x\n" + plain()),
            "'it.csv', line 1: column 't [s]' is missing; 'x' stands there");
  EXPECT_EQ(refusal(replaced(plain(), "\n0.5,0,", "\n0.5,1.2.3,")),
            "'it.csv', line 3: 'x [m]' is '1.2.3'; it must be a number or empty");
  EXPECT_EQ(refusal(replaced(plain(), "\n0,0,", "\n,0,")),
            "'it.csv', line 2: 't [s]' is ''; it must be a time of at most 1e6 s");
  EXPECT_EQ(refusal(replaced(plain(), "\n0.5,", "\n-0.5,")),
            "'it.csv', line 3: 't [s]' is '-0.5'; it must be later than in the line before, '0'");
  EXPECT_NE(refusal(replaced(plain(), "\n0.5,0,", "\n0.5,0,0,")).find("line 3: has "),
            std::string::npos);
  EXPECT_NE(refusal(plain().substr(0, plain().size() - 5)).find("fields; it must have "),
            std::string::npos);
  std::string flag = plain();
  flag[flag.size() - 2] = '2';
  EXPECT_EQ(refusal(flag), "'it.csv', line 3: 'flying' is '2'; it must be 0 or 1");
}

TEST(FlightCsv, TooManyColumnsAreRefused) {
  std::string names;
  for (int i = 0; i <= kMaxAdaptive; ++i) names += "K_" + std::to_string(i) + ",";
  EXPECT_EQ(refusal(replaced(plain(), "thrust [N]", names + "thrust [N]")),
            "'it.csv', line 1: there are 65 adaptive quantities; at most 64 are allowed");
}

}  // namespace
}  // namespace aqc
