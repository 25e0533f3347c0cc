#include <benchmark/benchmark.h>

#include <cmath>
#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include "adaptive_quadrotor_control/pilot/pilot.h"
#include "adaptive_quadrotor_control/simulation/rigid_plant.h"
#include "support/fixtures.h"

namespace aqc {
namespace {

constexpr Nanoseconds kPeriod = 4'000'000;

struct Moment {
  State state;
  Eigen::Vector3d specific_force;
};

/// A pilot by timer and the messages of a flight that ends where it began, to be heard for ever.
class Replay {
 public:
  /// `moving`: half of the time on the way to a place 2 m away or back; else at rest in a hover.
  Replay(const std::string& law, bool guarded, bool moving) : guarded_(guarded), moving_(moving) {
    PilotLimits limits;
    if (guarded) limits.guard = GuardLimits();
    pilot_ = std::make_unique<Pilot>(vehicle_, test::lawNamed(law, vehicle_), kPeriod,
                                     StepClock::Trigger::kTimer, limits);
    State start;
    start.position.z() = 0.1;
    RigidPlant plant(vehicle_, start);
    fly(plant, 25);
    if (guarded) {
      pilot_->guard()->arm();
      pilot_->guard()->takeOff();
    }
    if (!guarded) go(0.0);
    fly(plant, 2500);  // the take-off
    go(0.0);
    fly(plant, 2500);
    for (const double x : {2.0, 0.0}) {
      if (moving_) go(x);
      for (int i = 0; i < kLeg; ++i) {
        moments_.push_back({plant.state(), plant.specificForce()});
        fly(plant, 1);
      }
    }
    if (guarded && pilot_->guard()->mode() != Mode::kFlying) std::abort();
  }

  void step() {
    if (moving_ && next_ % kLeg == 0) go(next_ == 0 ? 2.0 : 0.0);
    const Moment& moment = moments_[next_];
    hear(moment);
    if (++next_ == moments_.size()) next_ = 0;
  }
  const Pilot& pilot() const { return *pilot_; }

 private:
  static constexpr int kLeg = 1500;  // steps

  void hear(const Moment& moment) {
    if (guarded_) pilot_->hear(moment.specific_force, moment.state.body_rate, now_);
    pilot_->hear(moment.state, now_, now_);
    pilot_->tick(now_);
    now_ += kPeriod;
  }
  void fly(RigidPlant& plant, int steps) {
    for (int i = 0; i < steps; ++i) {
      hear({plant.state(), plant.specificForce()});
      for (int j = 0; j < 4; ++j) plant.step(pilot_->allocation().speeds, 1e-3);
    }
  }
  void go(double x) {
    SetPoint place;
    place.position = {x, 0.0, 1.5};
    pilot_->plan({{now_, place}}, now_, now_);
  }

  Vehicle vehicle_ = test::pelican();
  bool guarded_, moving_;
  std::unique_ptr<Pilot> pilot_;
  std::vector<Moment> moments_;
  std::size_t next_ = 0;
  Nanoseconds now_ = 1'000'000'000'000;
};

/// All that is done between two commands: what is heard, and the step.
void pilotStep(benchmark::State& state, const std::string& law, bool guarded, bool moving) {
  Replay replay(law, guarded, moving);
  for (auto _ : state) {
    replay.step();
    benchmark::DoNotOptimize(replay.pilot().allocation().speeds.data());
    benchmark::ClobberMemory();
  }
  if (guarded && replay.pilot().droppedOdometry() > 0) state.SkipWithError("odometry was dropped");
}
BENCHMARK_CAPTURE(pilotStep, asmc_hovers, "asmc", false, false);
BENCHMARK_CAPTURE(pilotStep, asmc_hovers_guarded, "asmc", true, false);
BENCHMARK_CAPTURE(pilotStep, asmc_moves, "asmc", false, true);
BENCHMARK_CAPTURE(pilotStep, asmc_moves_guarded, "asmc", true, true);
BENCHMARK_CAPTURE(pilotStep, geometric_hovers, "geometric", false, false);
BENCHMARK_CAPTURE(pilotStep, geometric_hovers_guarded, "geometric", true, false);
BENCHMARK_CAPTURE(pilotStep, geometric_moves, "geometric", false, true);
BENCHMARK_CAPTURE(pilotStep, geometric_moves_guarded, "geometric", true, true);

enum class Wanted { kRest, kFarAway, kJumps, kCircle };

SetPoint wantedAt(Wanted wanted, long step) {
  const double time = 0.01 * static_cast<double>(step);
  SetPoint point;
  point.position.z() = 1.5;
  if (wanted == Wanted::kFarAway) point.position.x() = 1e5;
  if (wanted == Wanted::kJumps && step / 400 % 2 == 1) point.position = {3.0, -2.0, 2.5};
  if (wanted == Wanted::kCircle) {
    const double c = 2.0 * std::cos(time), s = 2.0 * std::sin(time);
    point.position.head<2>() << c, s;
    point.velocity.head<2>() << -s, c;
    point.acceleration.head<2>() << -c, -s;
    point.jerk.head<2>() << s, -c;
  }
  return point;
}

/// The governor alone, with a vehicle that is where the reference is.
void governorStep(benchmark::State& state, Wanted wanted) {
  ReferenceGovernor governor{GovernorLimits()};
  governor.restart(wantedAt(Wanted::kRest, 0));
  std::vector<SetPoint> points;
  const bool circle = wanted == Wanted::kCircle;
  const long count = circle ? 628 : 800;  // once round, but for 3 ms
  for (long i = 0; i < count; ++i) points.push_back(wantedAt(wanted, i));
  std::size_t next = 0;
  for (auto _ : state) {
    const Eigen::Vector3d here = governor.setPoint().position;
    benchmark::DoNotOptimize(governor.follow(points[next], here, 2.0, 0.2, 0.01).yaw);
    benchmark::ClobberMemory();
    if (++next == points.size()) next = 0;
  }
}
BENCHMARK_CAPTURE(governorStep, rests, Wanted::kRest);
BENCHMARK_CAPTURE(governorStep, far_away, Wanted::kFarAway);
BENCHMARK_CAPTURE(governorStep, jumps, Wanted::kJumps);
BENCHMARK_CAPTURE(governorStep, circle, Wanted::kCircle);

}  // namespace
}  // namespace aqc
