#include "campaign/fault_draw.h"

#include <Eigen/Core>
#include <cmath>
#include <limits>

#include "adaptive_quadrotor_control/math/constants.h"
#include "adaptive_quadrotor_control/math/number_text.h"

namespace aqc {
namespace {

constexpr double kDegree = M_PI / 180.0;
constexpr double kArmed = 0.5;           // [s]: from here on things go wrong
constexpr double kDown = 4.0;            // [s] after the mission's end, in most landings
constexpr double kShortest = 0.1;        // of a spell [s]
constexpr double kLongest = 5.0;         // [s]
constexpr double kFlatBox = 0.05;        // height of a payload, between the feet [m]
constexpr double kNervousPeriod = 0.05;  // [s]

// A flight that faults are being added to.
struct Draw {
  Dice& dice;
  const Vehicle& vehicle;
  double end;  // of the mission [s]
  FaultFlight& flight;

  OdometryFaults& odometry() const { return flight.scenario.world.sensors->odometry; }
  ImuFaults& imu() const { return flight.scenario.world.sensors->imu; }
  double weight() const { return vehicle.mass * kGravity; }
  double spareThrust() const { return vehicle.maxThrust() - weight(); }

  double time() const { return dice.between(kArmed, end + kDown); }
  TimeWindow spell() const {
    TimeWindow window;
    window.from = fromSeconds(time());
    window.until = window.from + fromSeconds(dice.between(kShortest, kLongest));
    return window;
  }
  void happens(Nanoseconds at, PlantAction action) const {
    flight.scenario.mission.events.push_back({at, std::move(action)});
  }
  void pull(const TimeWindow& window, const ForceMoment& load) const {
    happens(window.from, ApplyDisturbance{window.until - window.from, load, 0.0});
  }
  void asks(Nanoseconds at, const SetPoint& point) const {
    flight.orders.push_back({at, Order::Kind::kPlan, {{at, point}}});
  }
};

std::string text(const TimeWindow& window) {
  return formatted("from %.3f to %.3f s", toSeconds(window.from), toSeconds(window.until));
}

std::string text(const Eigen::Vector3d& vector) {
  return formatted("(%.3g, %.3g, %.3g)", vector.x(), vector.y(), vector.z());
}

// Of the odometry all the time.

std::string drawNoise(const Draw& draw) {
  OdometryNoise& noise = draw.odometry().noise;
  noise.position = draw.dice.between(0.0, 0.03);
  noise.velocity = draw.dice.between(0.0, 0.1);
  noise.attitude = draw.dice.between(0.0, 2.0 * kDegree);
  noise.body_rate = draw.dice.between(0.0, 0.1);
  return formatted("%.4f m, %.3f m/s, %.2f deg, %.3f rad/s", noise.position, noise.velocity,
                   noise.attitude / kDegree, noise.body_rate);
}

std::string drawDrift(const Draw& draw) {
  draw.odometry().position_drift = draw.dice.between(0.0, 0.1);
  draw.odometry().yaw_drift = draw.dice.between(0.0, 1.0 * kDegree);
  return formatted("%.3f m, %.2f deg in a second", draw.odometry().position_drift,
                   draw.odometry().yaw_drift / kDegree);
}

std::string drawRate(const Draw& draw) {
  const double rate = draw.dice.between(50.0, 250.0);
  draw.odometry().period = fromSeconds(1.0 / rate);
  return formatted("%.1f Hz", rate);
}

std::string drawTime(const Draw& draw, Nanoseconds& time, double longest) {
  time = fromSeconds(draw.dice.between(0.0, longest));
  return formatted("%.1f ms", toSeconds(time) * 1e3);
}
std::string drawDelay(const Draw& draw) {
  return drawTime(draw, draw.odometry().delay, 0.015);
}
std::string drawJitter(const Draw& draw) {
  return drawTime(draw, draw.odometry().jitter, 0.01);
}

std::string drawShare(const Draw& draw, double& share) {
  share = draw.dice.between(0.0, 0.6);
  return formatted("%.0f %%", 100.0 * share);
}
std::string drawDropped(const Draw& draw) {
  return drawShare(draw, draw.odometry().dropped);
}
std::string drawDuplicated(const Draw& draw) {
  return drawShare(draw, draw.odometry().duplicated);
}
std::string drawReordered(const Draw& draw) {
  return drawShare(draw, draw.odometry().reordered);
}

// Of the odometry for a spell, or from some time on.

std::string drawJump(const Draw& draw) {
  OdometryJump jump;
  jump.window = draw.spell();
  if (draw.dice.chance(0.5)) jump.window.until = TimeWindow().until;
  jump.position = draw.dice.between(0.1, 10.0) * draw.dice.direction();
  if (draw.dice.chance(0.3)) jump.yaw = draw.dice.between(-M_PI, M_PI);
  draw.odometry().jumps.push_back(jump);
  return text(jump.position) + formatted(" m, %.1f deg ", jump.yaw / kDegree) + text(jump.window);
}

std::string drawSpell(const Draw& draw, std::vector<TimeWindow>& spells) {
  spells.push_back(draw.spell());
  return text(spells.back());
}
std::string drawFreeze(const Draw& draw) {
  return drawSpell(draw, draw.odometry().freezes);
}
std::string drawNotANumber(const Draw& draw) {
  return drawSpell(draw, draw.odometry().not_a_number);
}
std::string drawGap(const Draw& draw) {
  return drawSpell(draw, draw.odometry().gaps);
}

std::string drawStamps(const Draw& draw) {
  const StampError error{draw.spell(), fromSeconds(draw.dice.between(-10.0, 10.0))};
  draw.odometry().stamps.push_back(error);
  return formatted("%.3f s ", toSeconds(error.offset)) + text(error.window);
}

std::string drawClockStep(const Draw& draw) {
  StampError error{{fromSeconds(draw.time())}, fromSeconds(draw.dice.between(-100.0, 100.0))};
  if (draw.dice.chance(0.5)) error.offset /= 100;
  draw.odometry().stamps.push_back(error);
  draw.imu().stamps.push_back(error);
  return formatted("%.3f s at %.3f s", toSeconds(error.offset), toSeconds(error.window.from));
}

std::string drawEnd(const Draw& draw, std::vector<TimeWindow>& gaps) {
  gaps.push_back({fromSeconds(draw.time())});
  return formatted("from %.3f s", toSeconds(gaps.back().from));
}
std::string drawNoOdometry(const Draw& draw) {
  return drawEnd(draw, draw.odometry().gaps);
}
std::string drawNoImu(const Draw& draw) {
  return drawEnd(draw, draw.imu().gaps);
}

// Of the IMU all the time.

std::string drawImuNoise(const Draw& draw) {
  draw.imu().force_noise = draw.dice.between(0.0, 0.5);
  draw.imu().rate_noise = draw.dice.between(0.0, 0.03);
  return formatted("%.3f m/s^2, %.4f rad/s", draw.imu().force_noise, draw.imu().rate_noise);
}

std::string drawImuBias(const Draw& draw) {
  draw.imu().force_bias = draw.dice.between(0.0, 0.15) * draw.dice.direction();
  draw.imu().rate_bias = draw.dice.between(0.0, 0.015) * draw.dice.direction();
  return text(draw.imu().force_bias) + " m/s^2, " + text(draw.imu().rate_bias) + " rad/s";
}

// Of the plant.

std::string drawWind(const Draw& draw) {
  Eigen::Vector3d wind = draw.dice.between(0.0, 8.0) * draw.dice.direction();
  wind.z() *= 0.25;
  const Nanoseconds at = fromSeconds(draw.time());
  draw.happens(at, SetWind{wind});
  return text(wind) + formatted(" m/s from %.3f s", toSeconds(at));
}

std::string drawShove(const Draw& draw) {
  TimeWindow window;
  window.from = fromSeconds(draw.time());
  window.until = window.from + fromSeconds(draw.dice.between(0.05, 0.5));
  const double force = draw.dice.between(0.0, 0.8) * draw.weight();
  const double moment = draw.dice.between(0.0, 0.3);
  const ForceMoment load{force * draw.dice.direction(), moment * draw.dice.direction()};
  draw.pull(window, load);
  return text(load.force) + " N, " + text(load.moment) + " N m " + text(window);
}

std::string drawPayload(const Draw& draw) {
  Payload payload;
  payload.mass = draw.dice.between(0.05, 0.4) * draw.spareThrust() / kGravity;
  payload.size = {0.1, 0.1, kFlatBox};
  const double aside = draw.dice.between(0.0, 0.02);
  const double angle = draw.dice.between(-M_PI, M_PI);
  payload.offset = {aside * std::cos(angle), aside * std::sin(angle), -kFlatBox};
  payload.inertia = boxInertia(payload.mass, payload.size);
  const TimeWindow window = draw.spell();
  draw.happens(window.from, AttachPayload{"", payload});
  std::string what =
      formatted("%.3f kg %.3f m off centre at %.3f s", payload.mass, aside, toSeconds(window.from));
  if (draw.dice.chance(0.5)) return what;
  draw.happens(window.until, DetachPayload{});
  return what + formatted(", off at %.3f s", toSeconds(window.until));
}

std::string drawTether(const Draw& draw, double force, const TimeWindow& window) {
  draw.pull(window, {{0.0, 0.0, -force}, Eigen::Vector3d::Zero()});
  return formatted("%.1f N ", force) + text(window);
}
std::string drawTetherBelow(const Draw& draw) {
  return drawTether(draw, draw.dice.between(0.5, 5.0) * draw.spareThrust(),
                    {0, fromSeconds(draw.dice.between(1.0, 8.0))});
}
std::string drawTetherAbove(const Draw& draw) {
  return drawTether(draw, draw.dice.between(0.1, 0.85) * draw.spareThrust(), draw.spell());
}

// Of who plans.

std::string drawPlanEnds(const Draw& draw) {
  const Nanoseconds at = fromSeconds(draw.dice.between(kArmed, draw.end));
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
  const Nanoseconds at = fromSeconds(draw.dice.between(kArmed, draw.end));
  draw.asks(at, point);
  const char* const names[] = {"z", "velocity z", "acceleration z", "yaw"};
  return formatted("%s %g at %.3f s", names[field], number, toSeconds(at));
}

std::string drawPlanFar(const Draw& draw) {
  SetPoint point;
  point.position = draw.dice.between(10.0, 500.0) * draw.dice.direction();
  const Nanoseconds at = fromSeconds(draw.dice.between(kArmed, draw.end));
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

std::string draw(FaultKind kind, const Draw& draw) {
  using Function = std::string (*)(const Draw&);
  static constexpr Function kFunctions[] = {
      drawNoise,      drawDrift,     drawRate,       drawDelay,       drawJitter,      drawDropped,
      drawDuplicated, drawReordered, drawJump,       drawFreeze,      drawNotANumber,  drawStamps,
      drawClockStep,  drawGap,       drawNoOdometry, drawImuNoise,    drawImuBias,     drawNoImu,
      drawWind,       drawShove,     drawPayload,    drawTetherBelow, drawTetherAbove, drawPlanEnds,
      drawPlanAbsurd, drawPlanFar,   drawPlanNervous};
  static_assert(std::size(kFunctions) == std::tuple_size_v<std::decay_t<decltype(faultKinds())>>);
  return kFunctions[static_cast<std::size_t>(kind)](draw);
}

// Without odometry nothing but the IMU tells which way is up: never both.
bool blindfolds(const std::vector<DrawnFault>& faults) {
  constexpr FaultKind kSilences[] = {
      FaultKind::kJump,      FaultKind::kFreeze, FaultKind::kNotANumber, FaultKind::kStamps,
      FaultKind::kClockStep, FaultKind::kGap,    FaultKind::kNoOdometry};
  const auto has = [&](FaultKind kind) {
    return std::any_of(faults.begin(), faults.end(),
                       [kind](const DrawnFault& fault) { return fault.kind == kind; });
  };
  return has(FaultKind::kNoImu) && std::any_of(std::begin(kSilences), std::end(kSilences), has);
}

}  // namespace

const std::array<FaultKindText, 27>& faultKinds() noexcept {
  static constexpr std::array<FaultKindText, 27> kKinds = {{
      {FaultKind::kNoise, "noise", "odometry: 0.03 m, 0.1 m/s, 2 deg, 0.1 rad/s at the most"},
      {FaultKind::kDrift, "drift", "to 0.1 m and 1 deg in a second, as the root of time"},
      {FaultKind::kRate, "rate", "50 to 250 Hz"},
      {FaultKind::kDelay, "delay", "to 15 ms"},
      {FaultKind::kJitter, "jitter", "to 10 ms"},
      {FaultKind::kDropped, "dropped", "to 60 % of the messages"},
      {FaultKind::kDuplicated, "duplicated", "to 60 %"},
      {FaultKind::kReordered, "reordered", "to 60 %"},
      {FaultKind::kJump, "jump", "0.1 to 10 m, 3 of 10 turn, too; half of them for ever"},
      {FaultKind::kFreeze, "freeze", "0.1 to 5 s"},
      {FaultKind::kNotANumber, "not a number", "0.1 to 5 s"},
      {FaultKind::kStamps, "stamps", "to 10 s off, 0.1 to 5 s long"},
      {FaultKind::kClockStep, "clock step", "to 100 s, half of them to 1 s; IMU, too"},
      {FaultKind::kGap, "gap", "0.1 to 5 s"},
      {FaultKind::kNoOdometry, "no odometry", "for ever"},
      {FaultKind::kImuNoise, "IMU noise", "to 0.5 m/s^2, 0.03 rad/s"},
      {FaultKind::kImuBias, "IMU bias", "to 0.15 m/s^2, 0.015 rad/s"},
      {FaultKind::kNoImu, "no IMU", "for ever, never with a fault that silences odometry"},
      {FaultKind::kWind, "wind", "to 8 m/s, 2 m/s up and down"},
      {FaultKind::kShove, "shove", "to 0.8 of the weight and 0.3 N m, 0.05 to 0.5 s"},
      {FaultKind::kPayload, "payload", "to 0.4 of the lift to spare, 2 cm off centre"},
      {FaultKind::kTetherBelow, "tether, standing", "0.5 to 5 times the spare thrust, 1 to 8 s"},
      {FaultKind::kTetherAbove, "tether, flying", "to 0.85 of the spare thrust, 0.1 to 5 s"},
      {FaultKind::kPlanEnds, "plan ends", "silent, or released"},
      {FaultKind::kPlanAbsurd, "absurd set point", "not finite, too large, or below the ground"},
      {FaultKind::kPlanFar, "far set point", "10 to 500 m away"},
      {FaultKind::kPlanNervous, "nervous plan", "20 a second within 4 m, 0.1 to 5 s"},
  }};
  return kKinds;
}

void drawFaults(Dice& dice, const Vehicle& vehicle, double end, FaultFlight& flight) {
  const Draw drawing{dice, vehicle, end, flight};
  const int kinds = static_cast<int>(faultKinds().size());
  const int faults = dice.count(1, 3);
  while (static_cast<int>(flight.faults.size()) < faults) {
    const auto kind = static_cast<FaultKind>(dice.count(0, kinds - 1));
    const auto same = [kind](const DrawnFault& fault) { return fault.kind == kind; };
    if (std::any_of(flight.faults.begin(), flight.faults.end(), same)) continue;
    flight.faults.push_back({kind, ""});
    if (blindfolds(flight.faults)) flight.faults.pop_back();
  }
  for (DrawnFault& fault : flight.faults) fault.text = draw(fault.kind, drawing);
}

}  // namespace aqc
