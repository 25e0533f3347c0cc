#include "campaign/fault_flight.h"

#include <algorithm>
#include <cmath>

#include "campaign/fault_draw.h"

namespace aqc {
namespace {

constexpr double kFirstGoal = 4.0;    // [s]: the take-off has ended
constexpr double kReach = 4.0;        // of goals, horizontally [m]
constexpr double kWayDown = 150.0;    // at the most, from wherever a far set point led [s]
constexpr double kStay = 25.0;        // of a flight that does not land [s]
constexpr double kPause = 10.0;       // then it is to hold where it is [s]
constexpr double kStream = 0.05;      // between set points of a stream [s]
constexpr double kStreamSpeed = 1.0;  // [m/s]

SetPoint drawGoal(Dice& dice) {
  SetPoint goal;
  const double x = dice.between(-kReach, kReach);
  const double y = dice.between(-kReach, kReach);
  goal.position = {x, y, dice.between(0.6, 4.0)};
  goal.yaw = dice.between(-M_PI, M_PI);
  return goal;
}

// Set points one by one on the way, as a node streams them.
void stream(std::vector<Order>& orders, double from, double until, const Eigen::Vector3d& start,
            const SetPoint& goal) {
  const Eigen::Vector3d way = goal.position - start;
  const double length = std::max(way.norm(), 1e-6);
  for (double time = from; time < until; time += kStream) {
    const double gone = std::min(kStreamSpeed * (time - from), length);
    SetPoint point = goal;
    point.position = start + way * (gone / length);
    if (gone < length) point.velocity = way * (kStreamSpeed / length);
    orders.push_back({fromSeconds(time), Order::Kind::kPlan, {{fromSeconds(time), point}}});
  }
}

// The mission; returns when its last leg ends [s].
double drawMission(Dice& dice, FaultFlight& flight) {
  double time = kFirstGoal;
  Eigen::Vector3d place(0.0, 0.0, 1.1);
  const int goals = dice.count(1, 4);
  for (int i = 0; i < goals; ++i) {
    const SetPoint goal = drawGoal(dice);
    const double next = time + dice.between(2.0, 6.0);
    const double manner = dice.between(0.0, 1.0);
    const Nanoseconds at = fromSeconds(time);
    if (manner < 0.4) {
      flight.orders.push_back({at, Order::Kind::kPlan, {{at, goal}}});
    } else if (manner < 0.6) {
      flight.orders.push_back({at, Order::Kind::kGoTo, {{at, goal}}});
    } else {
      stream(flight.orders, time, next, place, goal);
    }
    flight.asked.extend(goal.position);
    place = goal.position;
    time = next;
  }
  return time;
}

}  // namespace

FaultFlight emptyFlight(std::uint64_t seed, const Vehicle& vehicle) {
  FaultFlight flight;
  flight.seed = seed;
  Scenario& scenario = flight.scenario;
  scenario.name = "fault flight";
  scenario.vehicle = vehicle.name;
  scenario.world.start.position.z() = vehicle.gear_height;
  scenario.world.plant_step = 1'000'000;
  scenario.world.control_period = 4'000'000;
  SensorFaults& sensors = scenario.world.sensors.emplace();
  sensors.seed = seed;
  sensors.odometry.period = sensors.imu.period = scenario.world.control_period;
  flight.asked.extend(scenario.world.start.position);
  return flight;
}

FaultFlight drawFaultFlight(std::uint64_t seed, const Vehicle& vehicle) {
  FaultFlight flight = emptyFlight(seed, vehicle);
  Dice dice(seed);
  const double end = drawMission(dice, flight);
  const bool lands = dice.between(0.0, 7.0) < 6.0;
  flight.scenario.duration = fromSeconds(end + (lands ? kWayDown : kStay));
  drawFaults(dice, vehicle, end, flight);
  flight.orders.push_back(lands ? Order{fromSeconds(end), Order::Kind::kLand, {}}
                                : Order{fromSeconds(end + kPause), Order::Kind::kRelease, {}});
  std::stable_sort(flight.orders.begin(), flight.orders.end(),
                   [](const Order& a, const Order& b) { return a.time < b.time; });
  return flight;
}

}  // namespace aqc
