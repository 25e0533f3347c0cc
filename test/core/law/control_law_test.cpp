#include <gtest/gtest.h>

#include <cmath>

#include "adaptive_quadrotor_control/law/law_factory.h"
#include "support/fixtures.h"

// One step of every law, worked by hand with the gains of config/controller. The numbers in the
// comments come from the laws as they stand in the thesis and the papers.
namespace aqc {
namespace {

/// Level at (1, 0, 1), moving along x with 0.5 m/s and turning with (0.2, 0, -0.1) rad/s.
State levelState() {
  State state;
  state.position = {1.0, 0.0, 1.0};
  state.velocity = {0.5, 0.0, 0.0};
  state.body_rate = {0.2, 0.0, -0.1};
  return state;
}

/// At rest at (0, 0, 2), yaw 0.
SetPoint target() {
  SetPoint set_point;
  set_point.position = {0.0, 0.0, 2.0};
  return set_point;
}

void expectNear(const Eigen::Vector3d& actual, const Eigen::Vector3d& expected, double tolerance) {
  EXPECT_LT((actual - expected).cwiseAbs().maxCoeff(), tolerance)
      << actual.transpose() << " instead of " << expected.transpose();
}

TEST(AsmcLaw, OneStepWorkedByHand) {
  const Vehicle vehicle = test::pelican();
  const auto law = test::lawNamed("asmc", vehicle);
  const Wrench wrench = test::step(*law, {levelState()}, target(), 0.01);
  const Telemetry& seen = law->telemetry();
  // e_p = (1, 0, -1), de_p = (0.5, 0, 0); s_p = de_p + (1.2, 1.2, 0.8) e_p = (1.7, 0, -0.8).
  expectNear(seen.position_error, {1.0, 0.0, -1.0}, 1e-15);
  expectNear(seen.velocity_error, {0.5, 0.0, 0.0}, 1e-15);
  expectNear(seen.sliding_position, {1.7, 0.0, -0.8}, 1e-15);
  // ||s_p|| = sqrt(2.89 + 0.64) = 1.8788294; ||xi_p|| = sqrt(2 + 0.25) = 1.5.
  // rho_p = 0.01 + 0.01 * 1.5 = 0.025; sat = s_p / ||s_p|| = (0.9048187, 0, -0.4257970).
  // tau_p = -(2.4 * 1.7, 0, 16 * -0.8) - 0.025 sat + 0.01 * 9.81 z
  //       = (-4.08 - 0.0226205, 0, 12.8 + 0.0106449 + 0.0981).
  expectNear(seen.force, {-4.1026205, 0.0, 12.9087449}, 1e-7);
  EXPECT_NEAR(wrench.thrust, 12.9087449, 1e-7) << "level: all of the vertical part";
  // R_d is pitched by a with tan a = -4.1026205 / 12.9087449; the body is level, so that R_d' R
  // turns by -a about y and e_q = (0, sin(-a), 0) = (0, 4.1026205 / 13.5449988, 0).
  expectNear(seen.attitude_error, {0.0, 0.3028882, 0.0}, 1e-6);
  expectNear(seen.rate_error, {0.2, 0.0, -0.1}, 1e-15);
}

TEST(AsmcLaw, MomentWorkedByHand) {
  const Vehicle vehicle = test::pelican();
  const auto law = test::lawNamed("asmc", vehicle);
  // At the target in position, so that tau_p = m-hat g z = 0.0981 N straight up and R_d is level.
  State state;
  state.attitude = Eigen::AngleAxisd(M_PI / 6.0, Eigen::Vector3d::UnitX());
  state.body_rate = {0.0, 0.4, 0.0};
  const Wrench wrench = test::step(*law, {state}, SetPoint(), 0.01);
  // e_q = (sin 30 deg, 0, 0) = (0.5, 0, 0); de_q = (0, 0.4, 0); s_q = (2.25, 0.4, 0).
  expectNear(law->telemetry().sliding_attitude, {2.25, 0.4, 0.0}, 1e-12);
  // ||s_q|| = sqrt(5.0625 + 0.16) = 2.2852790 >= 1; ||xi_q||^2 = 0.25 + 0.16 = 0.41,
  // ||xi_q|| = 0.6403124. rho_q = 1e-4 (1 + 0.6403124 + 0.41) = 2.0503124e-4.
  // tau_q = -(0.22 * 2.25, 0.22 * 0.4, 0) - rho_q (0.9845625, 0.1750333, 0).
  expectNear(wrench.moment, {-0.495201866, -0.088035887, 0.0}, 1e-8);
  EXPECT_NEAR(wrench.thrust, 0.0981 * std::cos(M_PI / 6.0), 1e-12);
}

TEST(AsmcLaw, AdaptsAsPrinted) {
  const Vehicle vehicle = test::pelican();
  const auto law = test::lawNamed("asmc", vehicle);
  ASSERT_EQ(law->adaptiveQuantities().size(), 5u);
  EXPECT_EQ(law->telemetry().adaptive[0], 0.01) << "K_p0 at the start";
  EXPECT_EQ(law->telemetry().adaptive[4], 1e-4) << "K_q2 at the start";
  EXPECT_EQ(law->telemetry().mass_estimate, 0.01);
  const double dt = 1e-4;  // one step of Euler is then good to 1e-4 of the change
  test::step(*law, {levelState()}, target(), dt);
  const AdaptiveValues& K = law->telemetry().adaptive;
  // dK_p0 = ||s_p|| - 3 * 0.01 = 1.8788294 - 0.03; dK_p1 = 1.5 * 1.8788294 - 0.03.
  EXPECT_NEAR((K[0] - 0.01) / dt, 1.8488294, 1e-3);
  EXPECT_NEAR((K[1] - 0.01) / dt, 2.7882441, 1e-3);
  // d m-hat = -s_pz g - 0.1 * 0.01 = 0.8 * 9.81 - 0.001.
  EXPECT_NEAR((law->telemetry().mass_estimate - 0.01) / dt, 7.847, 1e-3);
  // s_q = de_q + (4.5, 4.5, 3.5) e_q, but de_q = (0.2, 0, -0.1): (0.2, 1.362997, -0.1).
  // ||s_q|| = 1.381215; ||xi_q||^2 = 0.3028882^2 + 0.05 = 0.141741; ||xi_q|| = 0.376485.
  // The leak of 50 takes 50 * 1e-4 = 0.005, and over this step 0.25 % of the drive.
  EXPECT_NEAR((K[2] - 1e-4) / dt, 1.381215 - 0.005, 5e-3);
  EXPECT_NEAR((K[3] - 1e-4) / dt, 1.381215 * 0.376485 - 0.005, 2e-3);
  EXPECT_NEAR((K[4] - 1e-4) / dt, 1.381215 * 0.141741 - 0.005, 1e-3);
  law->reset();
  EXPECT_EQ(law->telemetry().adaptive[0], 0.01);
  EXPECT_EQ(law->telemetry().mass_estimate, 0.01);
}

TEST(AsmcLaw, UsesTheGainsOfBeforeTheStep) {
  const Vehicle vehicle = test::pelican();
  const auto slow = test::lawNamed("asmc", vehicle);
  const auto fast = test::lawNamed("asmc", vehicle);
  const Wrench a = test::step(*slow, {levelState()}, target(), 1e-4);
  const Wrench b = test::step(*fast, {levelState()}, target(), 10.0);
  EXPECT_EQ(a.thrust, b.thrust);
  EXPECT_EQ((a.moment - b.moment).norm(), 0.0);
}

TEST(SmcLaw, OneStepWorkedByHand) {
  const Vehicle vehicle = test::pelican();
  const auto law = test::lawNamed("smc", vehicle);
  SetPoint set_point = target();
  set_point.acceleration = {0.0, 0.3, 0.0};
  const Wrench wrench = test::step(*law, {levelState()}, set_point, 0.01);
  // s_p = de_p + 3 e_p = (3.5, 0, -3): outside the boundary layer of 1, sat = (1, 0, -1).
  // b = g + a_d - 3 de_p = (-1.5, 0.3, 9.81); kappa = 4 + 0.4 |b| = (4.6, 4.12, 7.924).
  // tau_p = 2 b - kappa sat = (-3 - 4.6, 0.6, 19.62 + 7.924).
  expectNear(law->telemetry().sliding_position, {3.5, 0.0, -3.0}, 1e-15);
  expectNear(law->telemetry().force, {-7.6, 0.6, 27.544}, 1e-12);
  EXPECT_NEAR(wrench.thrust, 27.544, 1e-12);
}

TEST(SmcLaw, MomentWorkedByHand) {
  const Vehicle vehicle = test::pelican();
  const auto law = test::lawNamed("smc", vehicle);
  // At rest at the target: tau_p = 2 g z, so that R_d is level.
  State state;
  state.attitude = Eigen::AngleAxisd(M_PI / 6.0, Eigen::Vector3d::UnitX());
  state.body_rate = {0.0, 0.4, -0.2};
  const Wrench wrench = test::step(*law, {state}, SetPoint(), 0.01);
  // e_q = (0.5, 0, 0), de_q = (0, 0.4, -0.2), s_q = (1.5, 0.4, -0.2), sat = (1, 0.4, -0.2).
  // b = -3 de_q = (0, -1.2, 0.6); kappa = 0.3 + (0.093, 0.093, 0.0015) |b|
  //   = (0.3, 0.4116, 0.3009).
  // tau_q = J0 b - kappa sat = (-0.3, -0.00348 - 0.16464, 0.00108 + 0.06018).
  expectNear(wrench.moment, {-0.3, -0.16812, 0.06126}, 1e-12);
  EXPECT_NEAR(wrench.thrust, 19.62 * std::cos(M_PI / 6.0), 1e-12);
}

TEST(GeometricLaw, OneStepWorkedByHand) {
  const Vehicle vehicle = test::pelican();
  const auto law = test::lawNamed("geometric", vehicle);
  SetPoint set_point = target();
  set_point.acceleration = {0.0, 0.3, 0.5};
  const Wrench wrench = test::step(*law, {levelState()}, set_point, 0.01);
  // tau_p = 2 (a_d + g) - 4 e_p - 2.7 de_p = (-4 - 1.35, 0.6, 20.62 + 4).
  expectNear(law->telemetry().force, {-5.35, 0.6, 24.62}, 1e-12);
  EXPECT_NEAR(wrench.thrust, 24.62, 1e-12);
}

TEST(GeometricLaw, MomentWorkedByHand) {
  const Vehicle vehicle = test::pelican();
  const auto law = test::lawNamed("geometric", vehicle);
  State state;
  state.attitude = Eigen::AngleAxisd(M_PI / 6.0, Eigen::Vector3d::UnitX());
  state.body_rate = {1.0, 2.0, 3.0};
  SetPoint set_point;
  set_point.yaw_rate = 2.0;
  const Wrench wrench = test::step(*law, {state}, set_point, 0.01);
  // e_q = (0.5, 0, 0). R' R_d omega_d = 2 (0, sin 30, cos 30) = (0, 1, 1.7320508), so
  // de_q = (1, 1, 1.2679492). omega x J omega = (2 * 0.06 - 3 * 0.02, 3 * 0.01 - 1 * 0.06, 0)
  //   = (0.06, -0.03, 0).
  // tau_q = gyroscopic - (1, 1, 0.035) e_q - (0.22, 0.22, 0.01) de_q.
  expectNear(law->telemetry().rate_error, {1.0, 1.0, 1.2679492}, 1e-7);
  expectNear(wrench.moment, {0.06 - 0.5 - 0.22, -0.03 - 0.22, -0.012679492}, 1e-9);
}

TEST(CascadedLaws, ReportTheDesiredAttitudeOfTheirForce) {
  const Vehicle vehicle = test::pelican();
  for (const char* name : {"asmc", "smc", "geometric"}) {
    const auto law = test::lawNamed(name, vehicle);
    SetPoint set_point = target();
    set_point.yaw = 0.7;
    test::step(*law, {levelState()}, set_point, 0.01);
    const Eigen::Vector3d axis = law->telemetry().desired_attitude * Eigen::Vector3d::UnitZ();
    EXPECT_LT((axis - law->telemetry().force.normalized()).norm(), 1e-12) << name;
  }
}

}  // namespace
}  // namespace aqc
