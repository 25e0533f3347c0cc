#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <string>

#include "adaptive_quadrotor_control/pilot/pilot.h"
#include "adaptive_quadrotor_control/simulation/rigid_plant.h"
#include "support/fixtures.h"

namespace aqc {
namespace test {

/// A plant and a guarded pilot by timer, whose messages can be spoiled on their way: 1 ms plant,
/// 250 Hz control, odometry and IMU.
class GuardedFlight {
 public:
  static constexpr Nanoseconds kPeriod = 4'000'000;
  static constexpr Nanoseconds kStart = 1'000'000'000'000;

  explicit GuardedFlight(const std::string& law = "asmc", GuardLimits limits = GuardLimits(),
                         double height = 0.1)
      : vehicle_(pelican()),
        plant_(vehicle_, at(height)),
        pilot_(vehicle_, lawNamed(law, vehicle_), kPeriod, StepClock::Trigger::kTimer,
               with(limits)) {}

  // What the pilot hears: true when it is to be heard. `state`, `stamp` and `now` may be changed.
  std::function<bool(State& state, Nanoseconds& stamp, Nanoseconds& now)> odometry;
  bool imu = true;
  Nanoseconds imu_offset = 0;                            // of the IMU's stamps
  Eigen::Vector3d force_bias = Eigen::Vector3d::Zero();  // of the IMU, in B [m/s^2]
  Eigen::Vector3d rate_bias = Eigen::Vector3d::Zero();   // [rad/s]

  void fly(double seconds) {
    const Nanoseconds until = now_ + fromSeconds(seconds);
    while (now_ < until) {
      State state = plant_.state();
      Nanoseconds stamp = now_;
      Nanoseconds now = now_;
      const Eigen::Vector3d felt = plant_.specificForce() + force_bias;
      if (imu) pilot_.hear(felt, Eigen::Vector3d(state.body_rate + rate_bias), now_ + imu_offset);
      if (!odometry || odometry(state, stamp, now)) pilot_.hear(state, stamp, now);
      pilot_.tick(now);
      for (int i = 0; i < 4; ++i) plant_.step(pilot_.allocation().speeds, 1e-3);
      now_ += kPeriod;
      const State& after = plant_.state();
      highest_ = std::max(highest_, after.position.z());
      const RotorArray& speeds = pilot_.allocation().speeds;
      in_range_ = in_range_ && speeds.allFinite() && speeds.minCoeff() >= 0.0 &&
                  speeds.maxCoeff() <= vehicle_.max_rotor_speed;
      if (!plant_.touching()) sinking_ = -after.velocity.z();
      if (plant_.touching() && !touched_) impact_ = std::max(impact_, sinking_);
      touched_ = plant_.touching();
    }
  }
  /// Armed, taken off, at rest in a hover at its take-off height, counting from there.
  void takeOff() {
    fly(0.1);
    EXPECT_EQ(pilot_.guard()->arm(), nullptr);
    EXPECT_EQ(pilot_.guard()->takeOff(), nullptr);
    fly(8.0);
    EXPECT_EQ(mode(), Mode::kHolding);
    EXPECT_NEAR(height(), 1.1, 0.15);
    highest_ = height();
    impact_ = 0.0;
  }
  void go(double x, double y, double z) {
    SetPoint point;
    point.position = {x, y, z};
    pilot_.plan({{now_, point}}, now_, now_);
  }

  Mode mode() const { return pilot_.guard()->mode(); }
  Rule rule() const { return pilot_.guard()->rule(); }
  double height() const { return plant_.state().position.z(); }
  double speed() const { return plant_.state().velocity.norm(); }
  double highest() const { return highest_; }
  double impact() const { return impact_; }  ///< fastest touch-down [m/s]
  bool inRange() const { return in_range_; }
  bool crashed() const { return plant_.crash() != Crash::kNone; }
  bool still() const { return pilot_.allocation().speeds.norm() == 0.0; }
  Nanoseconds now() const { return now_; }
  Pilot& pilot() { return pilot_; }
  RigidPlant& plant() { return plant_; }

 private:
  static State at(double height) {
    State state;
    state.position.z() = height;
    return state;
  }
  static PilotLimits with(const GuardLimits& guard) {
    PilotLimits limits;
    limits.guard = guard;
    return limits;
  }

  Vehicle vehicle_;
  RigidPlant plant_;
  Pilot pilot_;
  Nanoseconds now_ = kStart;
  double highest_ = 0.0;
  double sinking_ = 0.0;
  double impact_ = 0.0;
  bool touched_ = true;
  bool in_range_ = true;
};

/// On the ground, whole, gently, the rotors still and never told what they cannot do.
inline void expectLanded(GuardedFlight& flight) {
  EXPECT_EQ(flight.mode(), Mode::kDisarmed);
  EXPECT_TRUE(flight.still());
  EXPECT_TRUE(flight.plant().touching());
  EXPECT_FALSE(flight.crashed()) << toString(flight.plant().crash());
  EXPECT_LT(flight.impact(), 1.5);
  EXPECT_TRUE(flight.inRange());
}

}  // namespace test
}  // namespace aqc
