#include "adaptive_quadrotor_control/control/switched.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <new>
#include <string>

#include "adaptive_quadrotor_control/control/flight_controller.h"
#include "support/euler_model.h"
#include "support/fixtures.h"

namespace {
long allocation_count = 0;

[[gnu::noinline]] void* allocate(std::size_t size, std::size_t alignment) {
  ++allocation_count;
  void* const memory = std::aligned_alloc(alignment, (size + alignment) / alignment * alignment);
  if (memory == nullptr) throw std::bad_alloc();
  return memory;
}
[[gnu::noinline]] void release(void* memory) {
  std::free(memory);
}
}  // namespace

// Every allocation of this binary is counted, so that a test can show that there is none.
void* operator new(std::size_t size) {
  return allocate(size, alignof(std::max_align_t));
}
void* operator new(std::size_t size, std::align_val_t alignment) {
  return allocate(size, static_cast<std::size_t>(alignment));
}
void operator delete(void* memory) noexcept {
  release(memory);
}
void operator delete(void* memory, std::size_t) noexcept {
  release(memory);
}
void operator delete(void* memory, std::align_val_t) noexcept {
  release(memory);
}
void operator delete(void* memory, std::size_t, std::align_val_t) noexcept {
  release(memory);
}

namespace aqc {
namespace {

YAML::Node thesisTree() {
  return loadYamlFile(test::configFile("controller/switched"));
}

// Numbers for work by hand: K_1 = K_2 = I and Q = 2 I give P = [3 1; 1 2] an axis, r = e + 2 de,
// lambda_max(P) = (5 + sqrt 5) / 2.
YAML::Node plainTree() {
  return YAML::Load(R"(
law: switched
boundary_layer: 0.5
acceleration_cut_off: 10.0
chatter_bound: 4
switching_policy: refuse
subsystems:
  - &plain
    error_gain: [1, 1, 1, 1]
    rate_gain: [1, 1, 1, 1]
    input_gain: [2, 3, 4, 5]
    weight: [2, 2, 2, 2, 2, 2, 2, 2]
    leak: [1.0, 2.0, 3.0, 4.0]
    gamma_drive: 0.01
    zeta_drive: 0.02
    initial_theta: [0.1, 0.2, 0.3, 0.4]
    initial_zeta: 0.5
    initial_gamma: 0.25
  - *plain
)");
}

constexpr double kVarrho = 2.0 / 3.618033988749895;  // lambda_min(Q) / lambda_max(P)
constexpr double kStep = 0.01;                       // [s]

std::unique_ptr<Switched> makeLaw(const YAML::Node& tree) {
  const ParameterReader reader(tree, "switched");
  reader.text("law");
  auto law = std::make_unique<Switched>(reader, test::pelican());
  reader.finish();
  return law;
}

/// 0.3 m too high, climbing 0.4 m/s too fast: ||xi|| = 0.5, r_z = 0.3 + 0.8 = 1.1.
State tooHigh() {
  State state;
  state.position = {7.0, -8.0, 1.3};
  state.velocity = {0.0, 0.0, 0.6};
  return state;
}

SetPoint climb() {
  SetPoint set_point;
  set_point.position.z() = 1.0;
  set_point.velocity.z() = 0.2;
  set_point.acceleration.z() = 0.5;
  return set_point;
}

const Eigen::Vector3d kClimbing(0.0, 0.0, kGravity + 2.0);  // accelerates upwards with 2 m/s^2

TEST(Switched, OneStepByHand) {
  const auto law = makeLaw(plainTree());
  law->senseSpecificForce(kClimbing);
  const Wrench wrench = law->update(tooHigh(), climb(), kStep);
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
  law->senseSpecificForce({0.0, 0.0, kGravity});
  State state;
  state.position.z() = 0.1;  // r = 0.1 = varpi / 5
  const double rho = 0.1 + 0.2 * 0.1 + 0.3 * 0.01 + 0.75;
  EXPECT_NEAR(law->update(state, {}, kStep).thrust, 2.0 * (-0.1 - rho * 0.2), 1e-12);
}

// tau_phi and tau_theta are moment / arm length, tau_psi is a moment; r points as the errors do.
TEST(Switched, AttitudeInputsBecomeMoments) {
  const Eigen::Vector3d angles(0.1, -0.2, 0.3);
  test::EulerMotion motion;
  motion.q.tail<3>() = angles;
  const auto law = makeLaw(plainTree());
  law->senseSpecificForce(test::specificForce(test::toState(motion),
                                              {Eigen::Vector4d::Zero(), Eigen::Vector2d::Zero()}));
  const Wrench wrench = law->update(test::toState(motion), {}, kStep);
  const double xi = angles.norm();
  const double rho = 0.1 + 0.2 * xi + 0.3 * xi * xi + 0.75;
  const Eigen::Vector3d expected = -angles - rho * angles / 0.5;
  const double arm_length = test::pelican().rotors.front().arm_length;
  EXPECT_NEAR(wrench.moment.x(), arm_length * 3.0 * expected.x(), 1e-12);
  EXPECT_NEAR(wrench.moment.y(), arm_length * 4.0 * expected.y(), 1e-12);
  EXPECT_NEAR(wrench.moment.z(), 5.0 * expected.z(), 1e-12);
}

TEST(Switched, ErrorsAreEulerAnglesAndTheirRates) {
  const auto law = makeLaw(plainTree());
  test::Dice dice(3);
  for (int i = 0; i < 100; ++i) {
    test::EulerMotion motion;
    motion.q << dice.between(-3.0, 3.0), dice.between(-3.0, 3.0), dice.between(-1.4, 1.4),
        dice.between(-3.0, 3.0);
    motion.rate.tail<3>() = dice.vector(3.0);
    law->update(test::toState(motion), {}, kStep);
    EXPECT_LT((law->telemetry().attitude_error - motion.q.tail<3>()).norm(), 1e-9);
    EXPECT_LT((law->telemetry().rate_error - motion.rate.tail<3>()).norm(), 1e-9);
  }
}

TEST(Switched, YawErrorTakesTheShortWay) {
  const auto law = makeLaw(plainTree());
  test::EulerMotion motion;
  motion.q[3] = 3.0;
  SetPoint set_point;
  set_point.yaw = -3.0 + 4.0 * M_PI;
  set_point.yaw_rate = 0.5;
  law->update(test::toState(motion), set_point, kStep);
  EXPECT_NEAR(law->telemetry().attitude_error.z(), 6.0 - 2.0 * M_PI, 1e-9);
  EXPECT_NEAR(law->telemetry().rate_error.z(), -0.5, 1e-12);
}

TEST(Switched, StaysFiniteAtVerticalPitch) {
  const auto law = makeLaw(thesisTree());
  for (const double pitch : {0.5 * M_PI, -0.5 * M_PI, 0.5 * M_PI - 1e-9, 1.55}) {
    State state;
    state.attitude = Eigen::AngleAxisd(pitch, Eigen::Vector3d::UnitY());
    state.body_rate = {1.0, 2.0, 3.0};
    const Wrench wrench = law->update(state, {}, kStep);
    EXPECT_TRUE(std::isfinite(wrench.thrust) && wrench.moment.allFinite()) << pitch;
    EXPECT_LT(law->telemetry().rate_error.norm(), 50.0) << pitch;
  }
}

// ||q-ddot|| in rho: 0.4 of it here, all else equal.
double accelerationSeen(const Switched& law, const State& state, const SetPoint& set_point) {
  Vector8d xi;
  xi << (state.position - set_point.position).z(), law.telemetry().attitude_error,
      (state.velocity - set_point.velocity).z(), law.telemetry().rate_error;
  const double rest = 0.1 + 0.2 * xi.norm() + 0.3 * xi.squaredNorm() + 0.75;
  const AdaptiveValues& values = law.telemetry().adaptive;
  return (values[values.size() - 1] - rest) / 0.4;
}

TEST(Switched, AccelerationComesFromTheAccelerometer) {
  test::Dice dice(5);
  for (int i = 0; i < 20; ++i) {
    const auto law = makeLaw(plainTree());
    State state = dice.airborneState();
    const Eigen::Vector3d acceleration = dice.vector(10.0);
    law->senseSpecificForce(state.attitude.conjugate() *
                            (acceleration + kGravity * Eigen::Vector3d::UnitZ()));
    law->senseSpecificForce({NAN, 0.0, 0.0});  // ignored
    law->update(state, {}, kStep);
    EXPECT_NEAR(accelerationSeen(*law, state, {}), acceleration.norm(), 1e-9);
  }
}

TEST(Switched, ForgetsAStaleSample) {
  const auto silent = makeLaw(plainTree());
  const auto law = makeLaw(plainTree());
  law->senseSpecificForce(kClimbing);
  law->forgetSpecificForce();
  State state;
  state.velocity.z() = 0.1;
  for (int i = 0; i < 5; ++i) {
    state.velocity.z() += 0.01;
    EXPECT_EQ(law->update(state, {}, kStep).thrust, silent->update(state, {}, kStep).thrust);
  }
  law->senseSpecificForce(kClimbing);
  EXPECT_NE(law->update(state, {}, kStep).thrust, silent->update(state, {}, kStep).thrust);
}

TEST(Switched, WithoutOneItComesFromTheVelocityBehindTheLowPass) {
  const auto law = makeLaw(plainTree());
  State state;
  law->update(state, {}, kStep);
  EXPECT_NEAR(accelerationSeen(*law, state, {}), 0.0, 1e-12);
  state.velocity = {0.03, 0.0, 0.0};   // 3 m/s^2 over one step
  state.body_rate = {0.04, 0.0, 0.0};  // 4 rad/s^2
  law->update(state, {}, kStep);
  const double share = 1.0 - std::exp(-2.0 * M_PI * 10.0 * kStep);
  // The gains themselves moved a little during the first step.
  EXPECT_NEAR(accelerationSeen(*law, state, {}), 5.0 * share, 0.15);
}

TEST(Switched, FilteredDerivativeSettlesOnTheSlope) {
  FilteredDerivative derivative(10.0);
  for (int i = 0; i < 200; ++i) derivative.step({0.03 * i, -1.0, -0.02 * i}, kStep);
  EXPECT_LT((derivative.value() - Eigen::Vector3d(3.0, 0.0, -2.0)).norm(), 1e-9);
  derivative.reset();
  derivative.step({100.0, 0.0, 0.0}, kStep);
  EXPECT_EQ(derivative.value(), Eigen::Vector3d::Zero());
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
  law->senseSpecificForce(kClimbing);
  law->update(state, climb(), kStep);
  const SwitchedLaw before = law->law();
  const double thrust = law->update(state, climb(), kStep).thrust;
  SwitchedInput in;
  in.error << 0.3, 0.0, 0.0, 0.0, 0.4, 0.0, 0.0, 0.0;
  in.desired_acceleration = {0.5, 0.0, 0.0, 0.0};
  in.acceleration = 2.0;
  EXPECT_NEAR(thrust, before.output(0, in).input[0], 1e-12);

  ASSERT_TRUE(law->subsystems()->request(3, fromSeconds(1.0)).accepted());
  const SwitchedLaw at_switch = law->law();
  const double switched = law->update(state, climb(), kStep).thrust;
  EXPECT_NEAR(switched, at_switch.output(2, in).input[0], 1e-12);
  EXPECT_NE(switched, thrust);
  // Gains are continuous: those of the switch itself did not move.
  EXPECT_EQ(at_switch.subsystem(2).gains().theta, before.subsystem(2).gains().theta);
}

TEST(Switched, ResetForgetsGainsButNotTheSubsystem) {
  const auto law = makeLaw(plainTree());
  const AdaptiveValues fresh = law->telemetry().adaptive;
  law->subsystems()->request(2, 0);
  law->senseSpecificForce(kClimbing);
  for (int i = 0; i < 10; ++i) law->update(tooHigh(), climb(), kStep);
  law->reset();
  EXPECT_TRUE(test::sameBits(AdaptiveValues(fresh.head(12)),
                             AdaptiveValues(law->telemetry().adaptive.head(12))));
  EXPECT_EQ(law->subsystems()->active(), 2);
  EXPECT_EQ(law->subsystems()->counts().switched, 1);
}

TEST(Switched, NamesEveryAdaptiveValue) {
  const auto law = makeLaw(thesisTree());
  const std::vector<std::string> names = law->adaptiveNames();
  ASSERT_EQ(names.size(), 20u);
  EXPECT_EQ(static_cast<std::size_t>(law->telemetry().adaptive.size()), names.size());
  EXPECT_EQ(names[0], "theta_0[1]");
  EXPECT_EQ(names[10], "zeta[2]");
  EXPECT_EQ(names[17], "gamma[3]");
  EXPECT_EQ(names[18], "active_subsystem");
  EXPECT_EQ(names[19], "rho");
  EXPECT_TRUE(std::isnan(law->telemetry().mass_estimate));
}

TEST(Switched, StepAllocatesNothingWithEightSubsystems) {
  YAML::Node tree = thesisTree();
  while (tree["subsystems"].size() < kMaxSubsystems) {
    tree["subsystems"].push_back(tree["subsystems"][0]);
  }
  const Vehicle vehicle = test::pelican();
  FlightController controller(vehicle, makeLaw(tree));
  const State state = tooHigh();
  const SetPoint set_point = climb();
  const long before = allocation_count;
  for (int i = 0; i < 100; ++i) {
    controller.senseSpecificForce(kClimbing);
    controller.subsystems()->request(1 + i % 9, i);
    controller.step(state, &set_point, kStep);
  }
  controller.step(state, nullptr, kStep);
  EXPECT_EQ(allocation_count, before);
  EXPECT_TRUE(controller.law().needsImu());
}

std::string refusal(const YAML::Node& tree) {
  try {
    makeLaw(tree);
  } catch (const ParameterError& error) {
    return error.what();
  }
  return "accepted";
}

struct BadParameter {
  const char* name;
  const char* value;
  const char* words;  // of the refusal
};

TEST(Switched, RefusesParametersByName) {
  const BadParameter of_subsystem[] = {
      {"leak", "[0.6, 0.6, 0.3, 0.6]", "switched/subsystems[1]/leak"},
      {"leak", "[0.6, 0.6, 0.3, 0.6]", "> varrho / 2 = 0.4"},
      {"leak", "[0.6, 0.6, 0.6]", "4 numbers"},
      {"initial_zeta", "0.005", "is '0.005'; it must be > 'zeta_drive' = 0.005"},
      {"initial_gamma", "0.001", "subsystems[1]/initial_gamma"},
      {"initial_theta", "[1, 1, 0, 1]", "> 0"},
      {"zeta_drive", "0", "zeta_drive"},
      {"gamma_drive", "-1", "gamma_drive"},
      {"error_gain", "[1, 1, 1, -1]", "positive definite"},
      {"rate_gain", "[1, 1, 1]", "4 (the diagonal) or 16 (row by row)"},
      {"input_gain", "[1, 2, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1]", "symmetric"},
      {"weight", "[1, 1, 1, 1, 1, 1, 1, 0]", "weight"},
      {"wieght", "[1]", "unknown"},
  };
  for (const BadParameter& bad : of_subsystem) {
    YAML::Node tree = thesisTree();
    tree["subsystems"][1][bad.name] = YAML::Load(bad.value);
    const std::string why = refusal(tree);
    EXPECT_NE(why.find(bad.words), std::string::npos) << bad.name << ": " << why;
  }
  const BadParameter of_law[] = {
      {"dwell_time", "6.759", "it must be > theta*"},
      {"chatter_bound", "0.5", ">= 1"},
      {"kappa_ratio", "1.0", "< 1"},
      {"boundary_layer", "0", "boundary_layer"},
      {"switching_policy", "never", "refuse, warn"},
      {"initial_subsystem", "4", "<= 3"},
      {"acceleration_cut_off", "0", "acceleration_cut_off"},
      {"subsystems", "[]", "1 to 8"},
  };
  for (const BadParameter& bad : of_law) {
    YAML::Node tree = thesisTree();
    tree[bad.name] = YAML::Load(bad.value);
    const std::string why = refusal(tree);
    EXPECT_NE(why.find(bad.words), std::string::npos) << bad.name << ": " << why;
  }
}

TEST(Switched, EnforcesMoreThanTheLeastDwellTime) {
  const auto law = makeLaw(thesisTree());
  EXPECT_GT(toSeconds(law->subsystems()->monitor().dwellTime()), law->subsystems()->bound().least);
  YAML::Node tree = thesisTree();
  tree["dwell_time"] = 10.0;
  EXPECT_EQ(makeLaw(tree)->subsystems()->monitor().dwellTime(), fromSeconds(10.0));
}

}  // namespace
}  // namespace aqc
