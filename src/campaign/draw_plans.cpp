#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <limits>

#include "adaptive_quadrotor_control/math/number_text.h"
#include "campaign/draw.h"

namespace aqc {
namespace {

constexpr double kNervousPeriod = 0.05;  // [s]

std::string drawPlanEnds(const Draw& draw) {
  const Nanoseconds at = draw.timeOfMission();
  std::vector<Order>& orders = draw.flight.orders;
  orders.erase(std::remove_if(orders.begin(), orders.end(),
                              [at](const Order& order) { return order.time > at; }),
               orders.end());
  const bool released = draw.dice.chance(0.5);
  if (released) orders.push_back({at, Order::Kind::kRelease, {}});
  return formatted("%s at %.3f s", released ? "released" : "silent", toSeconds(at));
}

std::string drawPlanAbsurd(const Draw& draw) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double infinity = std::numeric_limits<double>::infinity();
  const double numbers[] = {nan, infinity, 1e300, 1e6, -1e3, -5.0};
  SetPoint point;
  point.position.z() = 1.0;
  const double number = numbers[draw.dice.count(0, 5)];
  const int field = draw.dice.count(0, 3);
  double* const fields[] = {&point.position.z(), &point.velocity.z(), &point.acceleration.z(),
                            &point.yaw};
  *fields[field] = number;
  const Nanoseconds at = draw.timeOfMission();
  draw.asks(at, point);
  const char* const names[] = {"z", "velocity z", "acceleration z", "yaw"};
  return formatted("%s %g at %.3f s", names[field], number, toSeconds(at));
}

std::string drawPlanFar(const Draw& draw) {
  SetPoint point;
  point.position = draw.dice.between(10.0, 500.0) * draw.dice.direction();
  const Nanoseconds at = draw.timeOfMission();
  draw.asks(at, point);
  draw.flight.asked.extend(point.position);
  return text(point.position) + formatted(" m at %.3f s", toSeconds(at));
}

std::string drawPlanNervous(const Draw& draw) {
  const TimeWindow window = draw.spell();
  for (Nanoseconds at = window.from; at < window.until; at += fromSeconds(kNervousPeriod)) {
    SetPoint point;
    point.position = draw.dice.between(0.0, 4.0) * draw.dice.direction();
    point.position.z() += 2.0;
    point.velocity = draw.dice.between(0.0, 4.0) * draw.dice.direction();
    point.yaw = draw.dice.between(-M_PI, M_PI);
    draw.asks(at, point);
    draw.flight.asked.extend(point.position);
  }
  return text(window);
}

}  // namespace

std::vector<FaultDraw> planFaults() {
  return {
      {{FaultKind::kPlanEnds, "plan ends", "silent, or released"}, drawPlanEnds},
      {{FaultKind::kPlanAbsurd, "absurd set point", "not finite, too large, or below the ground"},
       drawPlanAbsurd},
      {{FaultKind::kPlanFar, "far set point", "10 to 500 m away"}, drawPlanFar},
      {{FaultKind::kPlanNervous, "nervous plan", "20 a second within 4 m, 0.1 to 5 s"},
       drawPlanNervous},
  };
}

}  // namespace aqc
