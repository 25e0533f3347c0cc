#include <Eigen/Core>
#include <cmath>

#include "adaptive_quadrotor_control/math/number_text.h"
#include "campaign/draw.h"

namespace aqc {
namespace {

std::string drawWind(const Draw& draw) {
  Eigen::Vector3d wind = draw.dice.between(0.0, 8.0) * draw.dice.direction();
  wind.z() *= 0.25;
  const Nanoseconds at = fromSeconds(draw.time());
  draw.happens(at, SetWind{wind});
  return text(wind) + formatted(" m/s from %.3f s", toSeconds(at));
}

std::string drawShove(const Draw& draw) {
  const TimeWindow window = draw.spell(0.05, 0.5);
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

std::string drawGust(const Draw& draw) {
  SetGust gust;
  gust.intensity.setConstant(draw.dice.between(0.0, 2.0));
  gust.length = draw.dice.between(5.0, 30.0);
  gust.speed = draw.dice.between(3.0, 10.0);
  gust.seed = draw.flight.seed;
  const Nanoseconds at = fromSeconds(draw.time());
  draw.happens(at, gust);
  return formatted("sigma %.2f m/s, L %.1f m, V %.1f m/s from %.3f s", gust.intensity.x(),
                   gust.length, gust.speed, toSeconds(at));
}

// Of each rotor there is one condition: faults of several kinds may meet on one, and the last
// holds.
SetRotor anyRotor(const Draw& draw) {
  SetRotor rotor;
  rotor.number = draw.dice.count(1, static_cast<int>(draw.vehicle.rotors.size()));
  return rotor;
}

std::string drawRotorWeak(const Draw& draw) {
  SetRotor rotor = anyRotor(draw);
  rotor.condition.effectiveness = draw.dice.between(0.85, 1.0);
  const TimeWindow window = draw.spell();
  draw.happens(window.from, rotor);
  const std::string what =
      formatted("rotor %d gives %.2f ", rotor.number, rotor.condition.effectiveness);
  if (draw.dice.chance(0.7)) return what + formatted("from %.3f s", toSeconds(window.from));
  draw.happens(window.until, SetRotor{rotor.number, {}});
  return what + text(window);
}

std::string drawRotorSlow(const Draw& draw) {
  SetRotor rotor = anyRotor(draw);
  rotor.condition.slower = draw.dice.between(1.0, 3.0);
  const Nanoseconds at = fromSeconds(draw.time());
  draw.happens(at, rotor);
  return formatted("rotor %d slower by %.2f from %.3f s", rotor.number, rotor.condition.slower,
                   toSeconds(at));
}

std::string drawRotorStuck(const Draw& draw) {
  SetRotor rotor = anyRotor(draw);
  rotor.condition.stuck_at = draw.dice.between(0.6, 0.8) * draw.vehicle.max_rotor_speed;
  const TimeWindow window = draw.spell(0.05, 0.3);
  draw.happens(window.from, rotor);
  draw.happens(window.until, SetRotor{rotor.number, {}});
  return formatted("rotor %d at %.0f rad/s ", rotor.number, *rotor.condition.stuck_at) +
         text(window);
}

std::string drawRotorLost(const Draw& draw) {
  SetRotor rotor = anyRotor(draw);
  rotor.condition.effectiveness = 0.0;
  const Nanoseconds at = fromSeconds(draw.time());
  draw.happens(at, rotor);
  return formatted("rotor %d from %.3f s", rotor.number, toSeconds(at));
}

std::string drawBattery(const Draw& draw) {
  const SetBattery battery{draw.dice.between(0.8, 1.0), fromSeconds(draw.dice.between(0.0, 20.0))};
  const Nanoseconds at = fromSeconds(draw.time());
  draw.happens(at, battery);
  return formatted("to %.2f in %.1f s from %.3f s", battery.voltage, toSeconds(battery.over),
                   toSeconds(at));
}

std::string drawCommandsLost(const Draw& draw) {
  const TimeWindow window = draw.spell();
  const double share = draw.dice.between(0.0, 0.6);
  draw.happens(window.from, LoseCommands{share, window.until - window.from, draw.flight.seed});
  return formatted("%.0f %% ", 100.0 * share) + text(window);
}

}  // namespace

std::vector<FaultDraw> plantFaults() {
  return {
      {{FaultKind::kWind, "wind", "to 8 m/s, 2 m/s up and down"}, drawWind},
      {{FaultKind::kShove, "shove", "to 0.8 of the weight and 0.3 N m, 0.05 to 0.5 s"}, drawShove},
      {{FaultKind::kPayload, "payload", "to 0.4 of the lift to spare, 2 cm off centre"},
       drawPayload},
      {{FaultKind::kTetherBelow, "tether, standing", "0.5 to 5 times the spare thrust, 1 to 8 s"},
       drawTetherBelow},
      {{FaultKind::kTetherAbove, "tether, flying", "to 0.85 of the spare thrust, 0.1 to 5 s"},
       drawTetherAbove},
      {{FaultKind::kGust, "gust", "Dryden: to 2 m/s, 5 to 30 m long, passing by at 3 to 10 m/s"},
       drawGust},
      {{FaultKind::kRotorWeak, "rotor weak",
        "gives 0.85 to 1 of its thrust; 3 of 10 get well after 0.1 to 5 s"},
       drawRotorWeak},
      {{FaultKind::kRotorSlow, "rotor slow", "its time constants are 1 to 3 times as long"},
       drawRotorSlow},
      {{FaultKind::kRotorStuck, "rotor stuck",
        "turns at 0.6 to 0.8 of its greatest speed for 0.05 to 0.3 s"},
       drawRotorStuck},
      {{FaultKind::kRotorLost, "rotor lost", "a whole rotor, for ever: physics leaves no choice"},
       drawRotorLost},
      {{FaultKind::kBattery, "battery sags", "to 0.8 to 1 of its voltage, in 0 to 20 s"},
       drawBattery},
      {{FaultKind::kCommandsLost, "commands lost", "to 60 %, for 0.1 to 5 s"}, drawCommandsLost},
  };
}

}  // namespace aqc
