#include <gtest/gtest.h>

#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "ros/border/conversions.h"

namespace aqc {
namespace {

// Every number of a sample, through do(name, value). Each struct is taken apart by a structured
// binding of all its members, so that a new one does not compile until it is named here, too.
template <class Wrench, class Do>
void walkWrench(const std::string& name, Wrench& wrench, Do&& visit) {
  auto& [thrust, moment] = wrench;
  visit(name + ".thrust", thrust);
  visit(name + ".moment", moment);
}

template <class State, class Do>
void walkState(State& state, Do&& visit) {
  auto& [position, velocity, attitude, body_rate] = state;
  visit("position", position);
  visit("velocity", velocity);
  visit("attitude", attitude);
  visit("body_rate", body_rate);
}

template <class SetPoint, class Do>
void walkSetPoint(SetPoint& set_point, Do&& visit) {
  auto& [position, velocity, acceleration, jerk, yaw, yaw_rate, yaw_acceleration] = set_point;
  visit("desired_position", position);
  visit("desired_velocity", velocity);
  visit("desired_acceleration", acceleration);
  visit("desired_jerk", jerk);
  visit("desired_yaw", yaw);
  visit("desired_yaw_rate", yaw_rate);
  visit("desired_yaw_acceleration", yaw_acceleration);
}

template <class Telemetry, class Do>
void walkTelemetry(Telemetry& telemetry, Do&& visit) {
  auto& [position_error, velocity_error, attitude_error, rate_error, sliding_position,
         sliding_attitude, force, desired_attitude, mass_estimate, weighed_mass, adaptive] =
      telemetry;
  visit("position_error", position_error);
  visit("velocity_error", velocity_error);
  visit("attitude_error", attitude_error);
  visit("rate_error", rate_error);
  visit("sliding_position", sliding_position);
  visit("sliding_attitude", sliding_attitude);
  visit("force", force);
  visit("desired_attitude", desired_attitude);
  visit("mass_estimate", mass_estimate);
  visit("weighed_mass", weighed_mass);
  visit("adaptive_values", adaptive);
}

template <class Sample, class Do>
void walk(Sample& sample, Do&& visit) {
  auto& [time, state, flying, set_point, telemetry, allocation, payload_mass, touching,
         disturbance] = sample;
  visit("time", time);
  walkState(state, visit);
  visit("flying", flying);
  walkSetPoint(set_point, visit);
  walkTelemetry(telemetry, visit);
  auto& [speeds, requested, achieved, saturated] = allocation;
  visit("rotor_speeds", speeds);
  walkWrench("requested", requested, visit);
  walkWrench("achieved", achieved, visit);
  visit("saturated", saturated);
  visit("payload_mass", payload_mass);
  visit("touching", touching);
  auto& [disturbance_force, disturbance_moment] = disturbance;
  visit("disturbance.force", disturbance_force);
  visit("disturbance.moment", disturbance_moment);
}

// What the message has no place for: derivatives that only laws ask for, and truth.
const std::set<std::string> kLeftOut = {"desired_jerk",      "desired_yaw_acceleration",
                                        "payload_mass",      "touching",
                                        "disturbance.force", "disturbance.moment"};

// Puts numbers in that are all different; of the flags the one of that name is set.
class Numbering {
 public:
  explicit Numbering(std::string flag) : flag_(std::move(flag)) {}
  void operator()(const std::string&, double& value) { value = next(); }
  void operator()(const std::string&, Nanoseconds& value) {
    value = 1'000'000'000 + static_cast<Nanoseconds>(next());
  }
  void operator()(const std::string& name, bool& value) { value = name == flag_; }
  void operator()(const std::string&, Eigen::Quaterniond& value) {
    for (double& coefficient : value.coeffs()) coefficient = next();
  }
  template <class Vector>
  void operator()(const std::string&, Vector& vector) {
    if (Vector::SizeAtCompileTime == Eigen::Dynamic) vector.resize(5);
    for (double& entry : vector) entry = next();
  }

 private:
  double next() { return ++last_ + 0.5; }

  std::string flag_;
  double last_ = 0.0;
};

// Each value as numbers, by its name.
class Reading {
 public:
  void operator()(const std::string& name, double value) { put(name, {value}); }
  void operator()(const std::string& name, Nanoseconds value) {
    put(name, {static_cast<double>(value)});
  }
  void operator()(const std::string& name, bool value) { put(name, {value ? 1.0 : 0.0}); }
  void operator()(const std::string& name, const Eigen::Quaterniond& value) {
    (*this)(name, value.coeffs());
  }
  template <class Vector>
  void operator()(const std::string& name, const Vector& vector) {
    put(name, {vector.begin(), vector.end()});
  }

  std::map<std::string, std::vector<double>> values;

 private:
  void put(const std::string& name, std::vector<double> numbers) {
    EXPECT_TRUE(values.emplace(name, std::move(numbers)).second) << name << " is there twice";
  }
};

std::map<std::string, std::vector<double>> valuesOf(const FlightSample& sample) {
  Reading reading;
  walk(sample, reading);
  return reading.values;
}

FlightSample numbered(const std::string& flag) {
  FlightSample sample;
  walk(sample, Numbering(flag));
  return sample;
}

TEST(FlightSampleMessage, BringsEveryFieldBack) {
  msgs::ControllerState message;  // used again: nothing of the last sample may stay
  for (const std::string flag : {"flying", "saturated", "touching"}) {
    const FlightSample sample = numbered(flag);
    fill(sample, message);
    const auto sent = valuesOf(sample), received = valuesOf(toSample(message));
    const auto empty = valuesOf(FlightSample());
    for (const auto& [name, values] : sent) {
      const bool left_out = kLeftOut.count(name) > 0;
      EXPECT_EQ(received.at(name), left_out ? empty.at(name) : values) << name;
    }
  }
}

TEST(FlightSampleMessage, IsNumberedThroughout) {
  std::set<double> seen;
  for (const auto& [name, values] : valuesOf(numbered("flying"))) {
    if (name == "flying" || name == "saturated" || name == "touching") continue;
    EXPECT_FALSE(values.empty()) << name;
    for (const double value : values) EXPECT_TRUE(seen.insert(value).second) << name;
  }
}

// What comes back may have been put into the wrong place on both ways.
TEST(FlightSampleMessage, HasEveryFieldWhereItsNameSays) {
  const FlightSample sample = numbered("flying");
  msgs::ControllerState message;
  fill(sample, message);
  Reading told;
  // All fields of the message. Those without a name at the end are not the sample's.
  const auto& [header, controller, mode, mode_reason, odometry_silence, flying, position, attitude,
               velocity, body_rate, desired_position, desired_velocity, desired_acceleration,
               desired_yaw, desired_yaw_rate, desired_attitude, goal_position, goal_yaw,
               position_error, velocity_error, attitude_error, rate_error, sliding_position,
               sliding_attitude, force, mass_estimate, weighed_mass, adaptive_names, adaptive_units,
               adaptive_values, thrust, moment, thrust_achieved, moment_achieved, saturated,
               rotor_speeds, trajectory_stamp, set_points_pending, dropped_odometry,
               dropped_set_points, imu_lost, imu_losses, dropped_imu, active_subsystem, switches,
               switches_pending, switch_refusals, refused_subsystem, switch_refusal,
               next_switch_allowed] = message;
  told("time", toNanoseconds(header.stamp));
  told("flying", flying != 0);
  told("position", toEigen(position));
  told("attitude", toEigen(attitude));
  told("velocity", toEigen(velocity));
  told("body_rate", toEigen(body_rate));
  told("desired_position", toEigen(desired_position));
  told("desired_velocity", toEigen(desired_velocity));
  told("desired_acceleration", toEigen(desired_acceleration));
  told("desired_yaw", desired_yaw);
  told("desired_yaw_rate", desired_yaw_rate);
  told("desired_attitude", toEigen(desired_attitude));
  told("position_error", toEigen(position_error));
  told("velocity_error", toEigen(velocity_error));
  told("attitude_error", toEigen(attitude_error));
  told("rate_error", toEigen(rate_error));
  told("sliding_position", toEigen(sliding_position));
  told("sliding_attitude", toEigen(sliding_attitude));
  told("force", toEigen(force));
  told("mass_estimate", mass_estimate);
  told("weighed_mass", weighed_mass);
  told("adaptive_values", adaptive_values);
  told("requested.thrust", thrust);
  told("requested.moment", toEigen(moment));
  told("achieved.thrust", thrust_achieved);
  told("achieved.moment", toEigen(moment_achieved));
  told("saturated", saturated != 0);
  told("rotor_speeds", rotor_speeds);
  EXPECT_EQ(header.frame_id, "world");
  for (const auto& [name, values] : valuesOf(sample)) {
    if (kLeftOut.count(name) > 0) continue;
    EXPECT_EQ(told.values[name], values) << name;
  }
}

TEST(StepReportMessage, TellsWhatTheLogNeedsBesideTheSample) {
  msgs::ControllerState message;
  fill(numbered("flying"), message);
  message.controller = "asmc";
  message.adaptive_names = {"K"};
  message.adaptive_units = {"N"};
  message.trajectory_stamp = ros::Time(3, 1);
  message.switch_refusals = 4;
  message.refused_subsystem = 2;
  message.switch_refusal = "refused";
  message.next_switch_allowed = ros::Time(5, 6);
  const auto [sample, controller, quantities, plan_stamp, objections] = toReport(message);
  EXPECT_EQ(valuesOf(sample), valuesOf(toSample(message)));
  EXPECT_EQ(controller, "asmc");
  EXPECT_EQ(quantities, (std::vector<AdaptiveQuantity>{{"K", "N"}}));
  EXPECT_EQ(plan_stamp, 3'000'000'001);
  const auto& [count, subsystem, outcome, allowed] = objections;
  EXPECT_EQ(count, 4u);
  EXPECT_EQ(subsystem, 2);
  EXPECT_EQ(outcome, "refused");
  EXPECT_EQ(allowed, 5'000'000'006);
}

TEST(TruthMessage, TellsWhatOnlyThePlantKnows) {
  msgs::PlantStatus message;
  message.header.stamp = ros::Time(3, 1);
  message.payload_mass = 0.5;
  message.touching = true;
  message.disturbance_force = toVector3({1.0, 2.0, 3.0});
  message.disturbance_moment = toVector3({4.0, 5.0, 6.0});
  EXPECT_FALSE(toTruth(message).crash_time);
  message.crashed = true;
  message.crash_time = ros::Time(2, 5);
  message.crash_reason = "hard impact";
  const auto [time, payload_mass, touching, disturbance, crash_time, reason] = toTruth(message);
  EXPECT_EQ(time, 3'000'000'001);
  EXPECT_EQ(payload_mass, 0.5);
  EXPECT_TRUE(touching);
  EXPECT_EQ(disturbance.force, Eigen::Vector3d(1.0, 2.0, 3.0));
  EXPECT_EQ(disturbance.moment, Eigen::Vector3d(4.0, 5.0, 6.0));
  EXPECT_EQ(crash_time, 2'000'000'005);
  EXPECT_EQ(reason, "hard impact");
}

}  // namespace
}  // namespace aqc
