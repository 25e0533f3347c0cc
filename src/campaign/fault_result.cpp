#include "campaign/fault_result.h"

#include <algorithm>
#include <stdexcept>

#include "adaptive_quadrotor_control/math/constants.h"
#include "adaptive_quadrotor_control/simulation/closed_loop.h"
#include "campaign/hover.h"

namespace aqc {
namespace {

constexpr double kAfterwards = 1.0;  // disarmed and on the ground so long: it is over [s]
constexpr double kResting = 2.0;     // at the end, in which it must be at rest [s]
constexpr double kRestSpeed = 0.5;   // [m/s]
constexpr double kFence = 30.0;      // outside the box of start and goals: flown away [m]

// Flies and looks.
class Judge {
 public:
  Judge(const FaultFlight& flight, const Vehicle& vehicle, std::unique_ptr<ControlLaw> law,
        const PilotLimits& limits)
      : flight_(flight),
        vehicle_(vehicle),
        hover_(vehicle),
        loop_(flight.scenario, vehicle, std::move(law), limits) {
    result_.seed = flight.seed;
    for (const DrawnFault& fault : flight.faults) result_.faults.push_back(fault.kind);
  }

  FaultResult fly(const FlightWatcher& watch) {
    while (!loop_.done() && over_ < kAfterwards) {
      order();
      loop_.advance();
      look();
      if (watch) watch(loop_);
    }
    judge();
    return result_;
  }

 private:
  void obey(const Order& order) {
    Pilot& pilot = loop_.pilot();
    const Nanoseconds now = loop_.plant().now();
    switch (order.kind) {
      case Order::Kind::kPlan:
        try {
          pilot.plan(order.set_points, now, now);
        } catch (const std::invalid_argument&) {  // that is what the guard is for
          pilot.countRefusedSetPoints();
        }
        break;
      case Order::Kind::kGoTo:
        pilot.guard()->goTo(order.set_points.front().set_point);
        break;
      case Order::Kind::kRelease:
        pilot.release();
        break;
      case Order::Kind::kLand:
        lands_ = true;
        break;
    }
  }

  void order() {
    while (next_ < flight_.orders.size() && flight_.orders[next_].time <= loop_.plant().now()) {
      obey(flight_.orders[next_++]);
    }
    Guard& guard = *loop_.pilot().guard();
    if (lands_ && guard.mode() != Mode::kLanding) guard.land();
  }

  void look() {
    const State state = loop_.plant().plant().state();
    const bool touching = loop_.plant().plant().touching();
    const double dt = toSeconds(flight_.scenario.world.control_period);
    since_hover_ = touching || hovers() ? since_hover_ + dt : 0.0;
    if (!touching) sinking_ = -state.velocity.z();
    if (touching && !touched_) result_.impact = std::max(result_.impact, sinking_);
    touched_ = touching;
    const bool harmed = loop_.plant().crashTime() || result_.impact > kHardTouchDown;
    if (harmed && !harmed_) forced_ = since_hover_ < kAftermath;
    harmed_ = harmed_ || harmed;
    result_.astray = std::max(result_.astray, flight_.asked.exteriorDistance(state.position));
    quiet_ = state.velocity.norm() < kRestSpeed ? quiet_ + dt : 0.0;
    const Guard& guard = *loop_.pilot().guard();
    was_armed_ = was_armed_ || guard.armed();
    over_ = was_armed_ && !guard.armed() && touching ? over_ + dt : 0.0;
    std::vector<Rule>& rules = result_.rules;
    if (std::find(rules.begin(), rules.end(), guard.rule()) == rules.end()) {
      rules.push_back(guard.rule());
    }
  }

  // Whether the rotors can hold the vehicle up as it is.
  bool hovers() const {
    const TimedPlant& plant = loop_.plant();
    const double mass = vehicle_.mass + plant.plant().payloadMass();
    return hover_.isPossible(plant.rotors(), plant.battery(),
                             mass * kGravity - plant.disturbance().force.z());
  }

  void judge() {
    result_.duration = toSeconds(loop_.plant().now());
    result_.reason = loss();
    if (!harmed_) forced_ = since_hover_ < kAftermath;
    const bool harmed = harmed_ || !result_.reason.empty();
    if (harmed && forced_ && !loop_.pilot().guard()->armed()) {
      result_.verdict = Verdict::kForced;
    } else if (!result_.reason.empty()) {
      result_.verdict = Verdict::kLost;
    } else if (result_.impact > kHardTouchDown) {
      result_.verdict = Verdict::kHard;
    } else {
      result_.verdict = loop_.pilot().guard()->armed() ? Verdict::kHeld : Verdict::kLanded;
    }
  }

  // Empty, or why the vehicle is lost.
  std::string loss() const {
    const Guard& guard = *loop_.pilot().guard();
    const Crash crash = loop_.plant().plant().crash();
    if (crash != Crash::kNone) return toString(crash);
    if (result_.astray > kFence) return "flown away";
    if (!guard.armed()) return touched_ ? "" : "disarmed in the air";
    if (touched_) return "armed on the ground";
    return quiet_ < kResting ? "not at rest" : "";
  }

  const FaultFlight& flight_;
  const Vehicle& vehicle_;
  const Hover hover_;
  ClosedLoop loop_;
  FaultResult result_;
  std::size_t next_ = 0;  // order
  bool lands_ = false;
  bool was_armed_ = false;
  bool touched_ = true;
  double sinking_ = 0.0;             // [m/s]
  double quiet_ = 0.0;               // [s]
  double over_ = 0.0;                // [s]
  double since_hover_ = kAftermath;  // in the air no hover was possible so long ago [s]
  bool harmed_ = false;
  bool forced_ = false;  // when it was harmed
};

}  // namespace

const char* toString(Verdict verdict) noexcept {
  switch (verdict) {
    case Verdict::kLanded:
      return "landed";
    case Verdict::kHeld:
      return "held";
    case Verdict::kHard:
      return "hard";
    case Verdict::kForced:
      return "forced";
    case Verdict::kLost:
      break;
  }
  return "lost";
}

FaultResult flyFaults(const FaultFlight& flight, const Vehicle& vehicle,
                      std::unique_ptr<ControlLaw> law, const PilotLimits& limits,
                      const FlightWatcher& watch) {
  return Judge(flight, vehicle, std::move(law), limits).fly(watch);
}

}  // namespace aqc
