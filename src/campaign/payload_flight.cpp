#include "campaign/payload_flight.h"

#include <algorithm>
#include <cmath>

#include "adaptive_quadrotor_control/math/constants.h"
#include "adaptive_quadrotor_control/math/number_text.h"
#include "adaptive_quadrotor_control/reference/circle.h"
#include "adaptive_quadrotor_control/reference/minimum_snap.h"
#include "adaptive_quadrotor_control/reference/sampling.h"
#include "campaign/dice.h"

namespace aqc {
namespace {

constexpr double kDuration = 30.0;  // [s]
constexpr double kStart = 0.5;      // of the take-off [s]
constexpr double kTakenOff = 4.0;   // [s]
constexpr double kHeight = 2.0;     // of hover and circle [m]
constexpr double kCounted = 6.0;    // errors count from here [s]
constexpr double kOnItsWay = 3.0;   // after a step they do not [s]
constexpr double kRadius = 2.0;     // of the circle [m]
constexpr double kSpinUp = 2.0;     // until the circle has its rate [s]
constexpr double kLowest = 1.0;     // of steps [m]: a payload hangs 0.3 m below
constexpr double kHighest = 5.0;
constexpr Nanoseconds kMillisecond = 1'000'000;
const double kRoot3 = std::sqrt(3.0);

void takeOff(PayloadFlight& flight) {
  std::vector<Waypoint> way(2);
  way[0].position = flight.scenario.world.start.position;
  way[1].position = {0.0, 0.0, kHeight};
  const PolynomialTrajectory climb = minimumSnap(way, {kTakenOff - kStart});
  flight.scenario.mission.set_points =
      sample(climb, fromSeconds(kStart), flight.scenario.world.control_period);
}

void drawSteps(Dice& dice, PayloadFlight& flight) {
  Eigen::Vector3d place(0.0, 0.0, kHeight);
  int steps = 0;
  for (double time = dice.between(4.5, 6.0); time < kDuration - kOnItsWay;
       time += dice.between(4.0, 6.0)) {
    Eigen::Vector3d next;
    do {
      // By itself: compilers order the factors of a product as they like.
      const Eigen::Vector3d way = dice.direction();
      next = place + dice.between(0.0, 4.0) * way;
    } while (next.z() < kLowest || next.z() > kHighest);
    place = next;
    TimedSetPoint point;
    point.time = fromSeconds(time);
    point.set_point.position = place;
    flight.scenario.mission.set_points.push_back(point);
    flight.uncounted.push_back({point.time, fromSeconds(time + kOnItsWay)});
    ++steps;
  }
  flight.text = formatted("%d steps", steps);
}

void drawCircle(Dice& dice, PayloadFlight& flight) {
  const double rate = dice.between(0.4, 1.0);
  const Circle circle = {{0.0, 0.0, kHeight}, {-kRadius, 0.0}, rate, kSpinUp};
  const Nanoseconds start = fromSeconds(kTakenOff);
  const Nanoseconds period = flight.scenario.world.control_period;
  for (Nanoseconds time = start + period; time < flight.scenario.duration; time += period) {
    flight.scenario.mission.set_points.push_back({time, onCircle(circle, toSeconds(time - start))});
  }
  flight.text = formatted("circle at %.3f rad/s", rate);
}

void drawMission(Dice& dice, PayloadFlight& flight) {
  takeOff(flight);
  const int kind = dice.count(0, 2);
  if (kind == 0) flight.text = "hover";
  if (kind == 1) drawSteps(dice, flight);
  if (kind == 2) drawCircle(dice, flight);
}

void drawPayload(Dice& dice, const Vehicle& vehicle, PayloadFlight& flight) {
  AttachPayload attach;
  Payload& payload = attach.payload;
  payload.mass = std::max(dice.between(0.0, 0.6), 1e-3) * vehicle.mass;
  payload.size = {0.1, 0.1, kFlatBox};
  payload.inertia = boxInertia(payload.mass, payload.size);
  const double x = dice.between(-0.03, 0.03);
  const double y = dice.between(-0.03, 0.03);
  payload.offset = {x, y, -dice.between(0.08, 0.25)};
  const double on = dice.between(6.0, 10.0);
  const double off = dice.between(18.0, 24.0);
  flight.scenario.mission.events.push_back({fromSeconds(on), attach});
  flight.scenario.mission.events.push_back({fromSeconds(off), DetachPayload{}});
  flight.text += formatted("; %.3f kg at (%.3f %.3f %.3f) m from %.2f to %.2f s", payload.mass, x,
                           y, payload.offset.z(), on, off);
}

void drawWind(Dice& dice, PayloadFlight& flight) {
  const double speed = dice.between(0.0, 8.0);
  const double heading = dice.between(-M_PI, M_PI);
  const double at = dice.between(8.0, 20.0);
  SetWind wind;
  wind.velocity = {speed * std::cos(heading), speed * std::sin(heading), 0.0};
  flight.scenario.mission.events.push_back({fromSeconds(at), wind});
  flight.text +=
      formatted("; wind (%.2f %.2f) m/s at %.2f s", wind.velocity.x(), wind.velocity.y(), at);
}

void drawSensors(Dice& dice, bool imu, PayloadFlight& flight) {
  SensorFaults& sensors = flight.scenario.world.sensors.emplace();
  sensors.seed = flight.seed;
  sensors.odometry.period = sensors.imu.period = flight.scenario.world.control_period;
  const bool visual = dice.chance(0.5);
  if (visual) {
    sensors.odometry.noise = {0.002, 0.03, 0.2 * kDegree, 0.01};
    sensors.odometry.wander = {0.02 / kRoot3, 0.45 * kDegree / kRoot3, 4.0};
  } else {
    sensors.odometry.noise = {0.001, 0.01, 0.05 * kDegree, 0.01};
  }
  const int late = 10 * dice.count(0, 2);
  sensors.odometry.delay = late * kMillisecond;
  sensors.imu.force_noise = 0.1;
  sensors.imu.rate_noise = 0.01;
  if (!imu) sensors.imu.gaps = {TimeWindow()};
  flight.text += visual ? "; visual-inertial" : "; motion capture";
  flight.text += formatted(" %d ms late", late);
}

void makeWrong(Dice& dice, PayloadFlight& flight) {
  Vehicle& airframe = flight.airframe;
  const double force = dice.between(0.9, 1.15);
  const double lag = dice.between(0.6, 1.6);
  const double inertia = dice.between(0.8, 2.0);
  const double mass = dice.between(0.95, 1.1);
  airframe.force_constant *= force;
  airframe.time_constant_up *= lag;
  airframe.time_constant_down *= lag;
  airframe.inertia *= inertia;
  airframe.mass *= mass;
  SensorFaults& sensors = *flight.scenario.world.sensors;
  Eigen::Vector3d& bias = sensors.imu.force_bias;
  for (double& axis : bias) axis = dice.between(-0.2, 0.2);
  const int imu_late = dice.count(0, 5);
  const int late = dice.count(0, 20);
  sensors.imu.delay = imu_late * kMillisecond;
  sensors.odometry.delay = late * kMillisecond;
  flight.text +=
      formatted("; but k_f x %.2f; lag x %.2f; J x %.2f; m x %.2f", force, lag, inertia, mass) +
      formatted("; bias (%.2f %.2f %.2f) m/s^2; IMU %d and odometry %d ms late", bias.x(), bias.y(),
                bias.z(), imu_late, late);
}

}  // namespace

PayloadFlight drawPayloadFlight(std::uint64_t seed, const Vehicle& vehicle,
                                const PayloadConditions& conditions) {
  PayloadFlight flight;
  flight.seed = seed;
  flight.airframe = vehicle;
  Scenario& scenario = flight.scenario;
  scenario.name = "payload flight";
  scenario.vehicle = vehicle.name;
  scenario.duration = fromSeconds(kDuration);
  scenario.world.start.position.z() = vehicle.gear_height;
  scenario.world.plant_step = kMillisecond;
  scenario.world.control_period = 4 * kMillisecond;
  flight.uncounted.push_back({0, fromSeconds(kCounted)});
  Dice dice(seed);
  drawMission(dice, flight);
  drawPayload(dice, vehicle, flight);
  drawWind(dice, flight);
  drawSensors(dice, conditions.imu, flight);
  if (conditions.wrong) {
    Dice more(mixedSeed(seed, 1));  // apart from what is drawn in any case
    makeWrong(more, flight);
  }
  return flight;
}

}  // namespace aqc
