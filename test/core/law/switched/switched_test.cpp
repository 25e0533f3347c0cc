#include "adaptive_quadrotor_control/law/switched/switched.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "adaptive_quadrotor_control/math/rotations.h"
#include "adaptive_quadrotor_control/pilot/flight_controller.h"
#include "support/euler_model.h"
#include "support/heap_counter.h"
#include "support/switched_laws.h"

namespace aqc {
namespace {

using test::climb;
using test::kClimbing;
using test::kVarrho;
using test::makeLaw;
using test::plainTree;
using test::thesisTree;
using test::tooHigh;

constexpr double kStep = 0.01;  // [s]
const Eigen::Vector3d kResting(0.0, 0.0, kGravity);

TEST(Switched, OneStepByHand) {
  const auto law = makeLaw(plainTree());
  const Wrench wrench = test::step(*law, {tooHigh(), kClimbing}, climb(), kStep);
  // rho = 0.1 + 0.2 * 0.5 + 0.3 * 0.25 + 0.4 * 2 + 0.5 + 0.25
  const double rho = 1.825;
  EXPECT_NEAR(wrench.thrust, 2.0 * (-0.3 - 0.4 - rho + 0.5), 1e-12);
  EXPECT_LT(wrench.moment.norm(), 1e-12);

  const AdaptiveValues& gains = law->telemetry().adaptive;
  const double Y[] = {1.0, 0.5, 0.25, 2.0};
  for (int i = 0; i < 4; ++i) {  // theta-hat decays towards ||r|| Y_i / alpha_i
    const double alpha = i + 1.0;
    const double rest = 1.1 * Y[i] / alpha;
    EXPECT_NEAR(gains[i], rest + (0.1 * (i + 1) - rest) * std::exp(-alpha * kStep), 1e-14) << i;
  }
  const double zeta_rate = 1.0 + 0.4 * 2.0 * 1.1;
  const double zeta_rest = 0.02 / zeta_rate;
  EXPECT_NEAR(gains[4], zeta_rest + (0.5 - zeta_rest) * std::exp(-zeta_rate * kStep), 1e-14);
  EXPECT_EQ(gains[5], 0.25);  // gamma of the active subsystem rests
  for (int i = 0; i < 4; ++i) EXPECT_DOUBLE_EQ(gains[6 + i], 0.1 * (i + 1)) << i;
  EXPECT_EQ(gains[10], 0.5);  // zeta of the inactive one rests
  const double gamma_rate = 1.0 + 0.5 * kVarrho * 0.3;
  const double gamma_rest = 0.01 / gamma_rate;
  EXPECT_NEAR(gains[11], gamma_rest + (0.25 - gamma_rest) * std::exp(-gamma_rate * kStep), 1e-12);
  EXPECT_EQ(gains[12], 1.0);
  EXPECT_NEAR(gains[13], rho, 1e-12);
}

TEST(Switched, InsideTheBoundaryLayerTheRobustPartFades) {
  const auto law = makeLaw(plainTree());
  State state;
  state.position.z() = 0.1;  // r = 0.1 = varpi / 5
  const double rho = 0.1 + 0.2 * 0.1 + 0.3 * 0.01 + 0.75;
  EXPECT_NEAR(test::step(*law, {state, kResting}, {}, kStep).thrust, 2.0 * (-0.1 - rho * 0.2),
              1e-12);
}

// tau_phi and tau_theta are moment / arm length, tau_psi is a moment; r points as the errors do.
TEST(Switched, AttitudeInputsBecomeMoments) {
  const Eigen::Vector3d angles(0.1, -0.2, 0.3);
  test::EulerMotion motion;
  motion.q.tail<3>() = angles;
  const auto law = makeLaw(plainTree());
  const State state = test::toState(motion);
  const Eigen::Vector3d still =
      test::specificForce(state, {Eigen::Vector4d::Zero(), Eigen::Vector2d::Zero()});
  const Wrench wrench = test::step(*law, {state, still}, {}, kStep);
  const double xi = angles.norm();
  const double rho = 0.1 + 0.2 * xi + 0.3 * xi * xi + 0.75;
  const Eigen::Vector3d expected = -angles - rho * angles / 0.5;
  const double arm_length = test::pelican().rotors.front().arm_length;
  EXPECT_NEAR(wrench.moment.x(), arm_length * 3.0 * expected.x(), 1e-12);
  EXPECT_NEAR(wrench.moment.y(), arm_length * 4.0 * expected.y(), 1e-12);
  EXPECT_NEAR(wrench.moment.z(), 5.0 * expected.z(), 1e-12);
}

// Gains neither depend on how a span is cut into steps nor leave their bounds, however long a step.
TEST(Switched, GainsAreIntegratedExactly) {
  const auto whole = makeLaw(plainTree());
  const auto cut = makeLaw(plainTree());
  SwitchedLaw coarse = whole->law();
  SwitchedLaw fine = cut->law();
  SwitchedInput in;
  in.error << 1.0, 0.2, -0.1, 0.3, -0.5, 0.1, 0.0, 0.4;
  in.desired_acceleration.setZero();
  in.acceleration = 3.0;
  const double r = coarse.output(0, in).filtered_error.norm();
  coarse.adapt(0, in, r, 0.4);
  for (int i = 0; i < 8; ++i) fine.adapt(0, in, r, 0.05);
  const SubsystemGains& a = coarse.subsystem(0).gains();
  const SubsystemGains& b = fine.subsystem(0).gains();
  EXPECT_LT((a.theta - b.theta).norm(), 1e-12);
  EXPECT_NEAR(coarse.subsystem(1).gains().gamma, fine.subsystem(1).gains().gamma, 1e-14);
  coarse.adapt(0, in, r, 1e6);
  EXPECT_TRUE((a.theta.array() >= 0.0).all() && a.theta.allFinite());
  EXPECT_GT(a.zeta, 0.0);
  EXPECT_GT(coarse.subsystem(1).gains().gamma, 0.0);
}

// Before and after, the command is each law's own at the very same state: nothing else jumps.
TEST(Switched, ASwitchChangesOnlyTheLaw) {
  const auto law = makeLaw(thesisTree());
  const State state = tooHigh();
  test::step(*law, {state, kClimbing}, climb(), kStep);
  const SwitchedLaw before = law->law();
  const double thrust = test::step(*law, {state, kClimbing}, climb(), kStep).thrust;
  SwitchedInput in;
  in.error << 0.3, 0.0, 0.0, 0.0, 0.4, 0.0, 0.0, 0.0;
  in.desired_acceleration = {0.5, 0.0, 0.0, 0.0};
  in.acceleration = 2.0;
  EXPECT_NEAR(thrust, before.output(0, in).input[0], 1e-12);

  ASSERT_TRUE(law->subsystems()->request(3, fromSeconds(1.0)).accepted());
  const SwitchedLaw at_switch = law->law();
  const double switched = test::step(*law, {state, kClimbing}, climb(), kStep).thrust;
  EXPECT_NEAR(switched, at_switch.output(2, in).input[0], 1e-12);
  EXPECT_NE(switched, thrust);
  // Gains are continuous: those of the switch itself did not move.
  EXPECT_EQ(at_switch.subsystem(2).gains().theta, before.subsystem(2).gains().theta);
}

TEST(Switched, ResetForgetsGainsButNotTheSubsystem) {
  const auto law = makeLaw(plainTree());
  const AdaptiveValues fresh = law->telemetry().adaptive;
  law->subsystems()->request(2, 0);
  for (int i = 0; i < 10; ++i) test::step(*law, {tooHigh(), kClimbing}, climb(), kStep);
  law->reset();
  EXPECT_TRUE(test::sameBits(AdaptiveValues(fresh.head(12)),
                             AdaptiveValues(law->telemetry().adaptive.head(12))));
  EXPECT_EQ(law->subsystems()->active(), 2);
  EXPECT_EQ(law->subsystems()->counts().switched, 1);
}

TEST(Switched, NamesEveryAdaptiveValue) {
  const auto law = makeLaw(thesisTree());
  const std::vector<AdaptiveQuantity> all = law->adaptiveQuantities();
  ASSERT_EQ(all.size(), 20u);
  EXPECT_EQ(static_cast<std::size_t>(law->telemetry().adaptive.size()), all.size());
  EXPECT_EQ(all[0], (AdaptiveQuantity{"theta_0[1]", "m/s\u00b2"}));
  EXPECT_EQ(all[10], (AdaptiveQuantity{"zeta[2]", "m/s\u00b2"}));
  EXPECT_EQ(all[15], (AdaptiveQuantity{"theta_3[3]", "1"}));
  EXPECT_EQ(all[17], (AdaptiveQuantity{"gamma[3]", "m/s\u00b2"}));
  EXPECT_EQ(all[18], (AdaptiveQuantity{"active_subsystem", ""}));
  EXPECT_EQ(all[19], (AdaptiveQuantity{"rho", "m/s\u00b2"}));
  EXPECT_TRUE(std::isnan(law->telemetry().mass_estimate));
}

TEST(Switched, StepAllocatesNothingWithEightSubsystems) {
  if (!test::canCountHeap()) GTEST_SKIP() << "the allocator cannot be watched here";
  YAML::Node tree = thesisTree();
  while (tree["subsystems"].size() < kMaxSubsystems) {
    tree["subsystems"].push_back(tree["subsystems"][0]);
  }
  const Vehicle vehicle = test::pelican();
  FlightController controller(vehicle, makeLaw(tree));
  const State state = tooHigh();
  const SetPoint set_point = climb();
  const test::HeapCounter counter;
  for (int i = 0; i < 100; ++i) {
    controller.subsystems()->request(1 + i % 9, i);
    controller.step({state, kClimbing}, &set_point, kStep);
  }
  controller.step({state}, nullptr, kStep);
  EXPECT_EQ(counter.count(), 0u);
  EXPECT_TRUE(controller.law().usesSpecificForce());
}

// cos^2 of 45 deg in floating point is beyond 1/2, and so is the sine of this pitch beyond 1.
TEST(Switched, PitchesStraightUpAndDownWithoutNan) {
  for (const double sign : {-1.0, 1.0}) {
    State state;
    state.attitude = Eigen::Quaterniond(M_SQRT1_2, 0.0, sign * M_SQRT1_2, 0.0);
    ASSERT_GT(std::abs(state.attitude.toRotationMatrix()(2, 0)), 1.0);
    EXPECT_EQ(rollPitchYaw(state.attitude).y(), sign * M_PI_2);
    const auto law = makeLaw(plainTree());
    const Wrench wrench = test::step(*law, {state, kResting}, {}, kStep);
    EXPECT_EQ(law->telemetry().attitude_error.y(), sign * M_PI_2);
    EXPECT_TRUE(wrench.moment.allFinite() && std::isfinite(wrench.thrust));
  }
}

TEST(Switched, WantsToStandUprightAndTurned) {
  const auto law = makeLaw(plainTree());
  SetPoint set_point;
  set_point.yaw = 0.7;
  test::step(*law, {State(), kResting}, set_point, kStep);
  EXPECT_TRUE(law->telemetry().desired_attitude.isApprox(yawRotation(0.7), 1e-15));
}

// Every subsystem's gains go over; a law of another kind, or of another number, has none to give.
TEST(Switched, TellsNothingOfItsOwnLastStepAfterItAdopted) {
  const auto law = makeLaw(plainTree());
  test::step(*law, {tooHigh(), kClimbing}, climb(), kStep);
  ASSERT_NE(law->telemetry().sliding_position.z(), 0.0);
  law->adopt(*makeLaw(plainTree()));
  EXPECT_EQ(law->telemetry().sliding_position.z(), 0.0);
}

TEST(Switched, AdoptsEverySubsystemOfALawOfItsKind) {
  const auto old = makeLaw(plainTree());
  for (int subsystem : {1, 2}) {
    old->subsystems()->request(subsystem, 0);
    for (int i = 0; i < 10; ++i) test::step(*old, {tooHigh(), kClimbing}, climb(), kStep);
  }
  const auto fresh = makeLaw(plainTree());
  const AdaptiveValues initial = fresh->telemetry().adaptive;
  fresh->adopt(*old);
  for (int i = 0; i < 13; ++i) {
    EXPECT_EQ(fresh->telemetry().adaptive[i], old->telemetry().adaptive[i]) << i;
    EXPECT_NE(fresh->telemetry().adaptive[i], initial[i]) << i;
  }
  YAML::Node tree = plainTree();
  tree["subsystems"].push_back(tree["subsystems"][0]);
  const auto larger = makeLaw(tree);
  const AdaptiveValues before = larger->telemetry().adaptive;
  larger->adopt(*old);
  larger->adopt(*test::lawNamed("asmc", test::pelican()));
  EXPECT_TRUE(test::sameBits(larger->telemetry().adaptive, before));
}

}  // namespace
}  // namespace aqc
