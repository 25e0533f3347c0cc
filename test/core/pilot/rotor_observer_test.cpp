#include "adaptive_quadrotor_control/pilot/rotor_observer.h"

#include <gtest/gtest.h>

#include <cmath>

#include "support/guarded_flight.h"

namespace aqc {
namespace {

using test::GuardedFlight;

constexpr double kStep = 0.004;

class RotorObserverTest : public ::testing::Test {
 protected:
  // The body turns under `given` and `more`; the observer knows of the former.
  void turn(const Eigen::Vector3d& given, const Eigen::Vector3d& more, double seconds) {
    for (int i = 0; i < std::lround(seconds / kStep); ++i) {
      const Eigen::Vector3d spin = vehicle_.inertia * rate_;
      rate_ += kStep * (vehicle_.inertia.inverse() * (given + more - rate_.cross(spin)));
      observer_.observe(rate_, given, kStep);
    }
  }

  const Vehicle vehicle_ = test::pelican();
  const double hover_moment_ = 0.25 * vehicle_.mass * kGravity * vehicle_.rotors[0].arm_length;
  RotorObserver observer_{vehicle_};
  Eigen::Vector3d rate_ = Eigen::Vector3d::Zero();
};

TEST_F(RotorObserverTest, ExplainsWhatTheRotorsGiveWhateverTheBodyDoes) {
  turn({0.1, -0.2, 0.4}, Eigen::Vector3d::Zero(), 0.5);
  turn({0.1, -0.2, 0.0}, Eigen::Vector3d::Zero(), 0.5);
  EXPECT_GT(rate_.norm(), 10.0);
  EXPECT_LT(observer_.missing(), 0.1);
}

TEST_F(RotorObserverTest, TellsAMissingMomentAsAFilterOfATenthOfASecond) {
  turn(Eigen::Vector3d::Zero(), {0.0, 0.5 * hover_moment_, 0.0}, 0.1);
  EXPECT_NEAR(observer_.missing(), 0.5 * (1.0 - std::exp(-1.0)), 0.02);
  observer_.restart(rate_);
  EXPECT_EQ(observer_.missing(), 0.0);
  turn(Eigen::Vector3d::Zero(), {0.0, 0.0, 0.2}, 0.2);
  EXPECT_LT(observer_.missing(), 0.1) << "about z nobody asks";
}

// A rotor of a vehicle that holds gives `share` of its thrust.
GuardedFlight& weaken(GuardedFlight& flight, double share) {
  flight.takeOff();
  flight.go(0.0, 0.0, 4.0);
  flight.fly(5.0);
  flight.plant().setRotor(1, {share, std::nullopt, 1.0});
  return flight;
}

TEST(RotorLoss, OfAThirdOrMoreLandsAndIsTold) {
  for (const double share : {0.6, 0.5}) {
    GuardedFlight flight;
    weaken(flight, share).fly(0.8);
    EXPECT_EQ(flight.rule(), Rule::kRotorLoss) << share;
    EXPECT_EQ(flight.mode(), Mode::kLanding) << share;
  }
}

TEST(RotorLoss, OfAWholeRotorEndsByTumble) {
  GuardedFlight flight;
  weaken(flight, 0.0).fly(3.0);
  EXPECT_EQ(flight.mode(), Mode::kDisarmed);
  EXPECT_TRUE(flight.rule() == Rule::kTumble || flight.rule() == Rule::kTipped);
  EXPECT_TRUE(flight.still());
}

TEST(RotorLoss, OfLessIsTheLawsToBear) {
  GuardedFlight flight("asmc");
  weaken(flight, 0.85).fly(3.0);
  EXPECT_NE(flight.rule(), Rule::kRotorLoss);
}

TEST(RotorLoss, IsNoLoadOffCentreAndNoShortPush) {
  GuardedFlight flight;
  flight.takeOff();
  flight.go(0.0, 0.0, 3.0);
  flight.fly(5.0);
  const double load = 0.6 * kGravity;
  flight.plant().setDisturbance({{0.0, 0.0, -load}, {0.0, 0.03 * load, 0.0}});
  flight.fly(3.0);
  EXPECT_EQ(flight.mode(), Mode::kFlying);
  flight.plant().setDisturbance({{}, {0.8, 0.0, 0.0}});
  flight.fly(0.1);
  flight.plant().setDisturbance({});
  flight.fly(2.0);
  EXPECT_EQ(flight.mode(), Mode::kFlying);
}

}  // namespace
}  // namespace aqc
