#include "adaptive_quadrotor_control/law/composite/applied_wrench.h"

#include <gtest/gtest.h>

namespace aqc {
namespace {

Wrench wrench(double thrust, double moment) {
  return {thrust, {moment, 0.0, -moment}};
}

TEST(AppliedWrench, KnowsNothingBeforeItHeardAnything) {
  const AppliedWrench applied;
  EXPECT_EQ(applied.now().thrust, 0.0);
  EXPECT_EQ(applied.since(0.1).thrust, 0.0);
  EXPECT_EQ(applied.mean(0.0, 0.1).moment.norm(), 0.0);
}

TEST(AppliedWrench, OfAConstantOneIsLinearAndQuadraticInTime) {
  AppliedWrench applied;
  for (int i = 0; i < 40; ++i) applied.observe(wrench(8.0, 2.0), 0.004);
  for (const double age : {0.0, 0.001, 0.004, 0.0105, 0.1, 0.5}) {  // the last beyond its memory
    const AppliedWrench::Impulse impulse = applied.since(age);
    EXPECT_NEAR(impulse.thrust, 8.0 * age, 1e-12) << age;
    EXPECT_NEAR(impulse.moment.x(), 2.0 * age, 1e-12) << age;
    EXPECT_NEAR(impulse.turn.z(), -age * age, 1e-12) << age;
  }
  EXPECT_NEAR(applied.mean(0.02, 0.004).thrust, 8.0, 1e-12);
}

// tau = t: its integrals over the last T seconds before t0 are t0 T - T^2 / 2, and of that integral
// from t0 - T on, (t0 - T) T^2 / 2 + T^3 / 6. What lies within a step counts as its mean.
TEST(AppliedWrench, OfARampIsItsClosedForm) {
  AppliedWrench applied;
  const double dt = 0.004;
  for (int i = 0; i <= 30; ++i) applied.observe(wrench(i * dt, i * dt), dt);
  const double now = 30 * dt;
  const double age = 10 * dt;
  const AppliedWrench::Impulse impulse = applied.since(age);
  EXPECT_NEAR(impulse.moment.x(), now * age - 0.5 * age * age, 1e-12);
  const double turn = 0.5 * (now - age) * age * age + age * age * age / 6.0;
  EXPECT_NEAR(impulse.turn.x(), turn, 10 * dt * dt * dt / 12.0 + 1e-12);
  EXPECT_NEAR(applied.mean(2 * dt, 4 * dt).thrust, now - 4 * dt, 1e-12);
}

}  // namespace
}  // namespace aqc
