#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <optional>
#include <string>
#include <vector>

#include "adaptive_quadrotor_control/law/composite/bounded_surface.h"
#include "adaptive_quadrotor_control/law/composite/thrust_share.h"
#include "adaptive_quadrotor_control/law/saturation.h"
#include "adaptive_quadrotor_control/simulation/closed_loop.h"
#include "support/fixtures.h"
#include "support/hover_flights.h"

// The position loop of the law `composite`: docs/stability.md derives what is asked for here, along
// flights of the real law on the real plant, with the true mass, force and thrust.
namespace aqc {
namespace {

using Eigen::Vector3d;

// config/controller/composite.yaml and the constants of the law, on axes x, y, z.
const Vector3d kDamping(5.0, 5.0, 6.0);   // Lambda
const Vector3d kDrive(2.0, 2.0, 4.0);     // Gamma
constexpr double kLeak = 0.05;            // sigma
constexpr double kForgetting = 3.0;       // alpha
constexpr double kLayer = 0.1;            // varpi
constexpr double kMassRate = 1.0 / 0.01;  // beta
constexpr double kSampleTime = 0.005;     // of thrust and specific force
constexpr double kMostSliding = 2.0;      // of s_b
const Vector3d kWeight = kDrive.cwiseInverse();
const Vector3d kGravityVector = kGravity * Vector3d::UnitZ();

Vector3d bounded(const Vector3d& s) {
  const double side = std::max(s.head<2>().norm(), kMostSliding);
  return {s.x() * kMostSliding / side, s.y() * kMostSliding / side,
          std::clamp(s.z(), -kMostSliding, kMostSliding)};
}

/// The loop at the time of one command.
struct Instant {
  Vector3d sliding;       // s
  Vector3d learning;      // 1 on the axes on which d_s is learned, else 0
  Vector3d bias;          // d_s
  Vector3d left;          // d - d_f, what is left for d_s
  Vector3d tracking;      // epsilon: what rotors and attitude do to F / m
  double asked;           // |F| / m-hat
  double mass_error;      // m-hat - m
  double measured_error;  // nu
  double mass;            // m
  double size;            // ||xi||
  bool gains_learn;
  Vector3d goal;
  std::array<double, 2> gains;  // K

  Vector3d bias_error() const { return bias - left; }
  double value(double mass_weight) const {
    return 0.5 * sliding.squaredNorm() + 0.5 * kWeight.dot(bias_error().cwiseAbs2()) +
           0.5 * mass_weight * mass_error * mass_error +
           0.5 * (gains[0] * gains[0] + gains[1] * gains[1]);
  }
};

/// The terms of the bound on dV/dt, each times a factor that is 1 where the law is right.
struct Factors {
  double damping = 1.0, tracking = 1.0, coupling = 1.0, drive = 1.0, leak = 1.0, change = 1.0,
         mass = 1.0, measured = 1.0, robust = 1.0, forgetting = 1.0;
  double mass_weight = 12.0;  // c: any one does along a flight
};

struct Bound {
  double power;  // the bound
  double scale;  // its terms without their signs
};

/// `change` is the rate of what is left for d_s.
Bound bound(const Instant& at, const Vector3d& change, const Factors& factors) {
  const Vector3d& s = at.sliding;
  const double norm = s.norm();
  const Vector3d bias_error = at.bias_error();
  const Vector3d weighed = kWeight.cwiseProduct(bias_error);
  const double x = std::min(at.size, 1.0);
  const double robust = at.gains[0] + at.gains[1] * at.size;
  const double driven =
      at.gains_learn ? std::min(norm, 1.0) * (at.gains[0] + at.gains[1] * x) : 0.0;
  const double squares = at.gains[0] * at.gains[0] + at.gains[1] * at.gains[1];
  const std::array<double, 11> terms = {
      -factors.damping * s.dot(kDamping.cwiseProduct(bounded(s))),
      factors.tracking * norm * at.tracking.norm(),
      factors.coupling * norm * at.asked * std::abs(at.mass_error) / at.mass,
      -s.dot(bias_error),
      factors.drive * bias_error.cwiseProduct(at.learning).dot(bounded(s)),
      -factors.leak * kLeak * weighed.cwiseProduct(at.learning).dot(at.bias),
      -factors.change * weighed.dot(change),
      -factors.mass * factors.mass_weight * kMassRate * at.mass_error * at.mass_error,
      factors.measured * factors.mass_weight * kMassRate * at.mass_error * at.measured_error,
      -factors.robust * robust * norm * std::min(norm / kLayer, 1.0) + driven,
      at.gains_learn ? -factors.forgetting * kForgetting * squares : 0.0};
  Bound sum = {0.0, 0.0};
  for (const double term : terms) {
    sum.power += term;
    sum.scale += std::abs(term);
  }
  return sum;
}

/// What the law knows and does, and what is true, from one step of a flight to the next.
class Witness {
 public:
  explicit Witness(const Vehicle& vehicle)
      : vehicle_(vehicle), share_(0.98 * vehicle.maxThrust(), 1.0) {}

  /// Before a step: the truth of now, and what the law has learned until now.
  void look(const ClosedLoop& loop) {
    const Plant& plant = loop.plant().plant();
    const State state = plant.state();
    const Eigen::Matrix3d attitude = state.attitude.toRotationMatrix();
    const Vector3d felt = plant.specificForce();
    state_ = state;
    mass_ = vehicle_.mass + plant.payloadMass();
    const double thrust = vehicle_.force_constant * plant.rotorSpeeds().cwiseAbs2().sum();
    rotors_ = thrust * attitude.col(2);
    beside_ = attitude * felt - rotors_ / mass_;
    const double part = -std::expm1(-dt_ / kSampleTime);
    thrust_ += (started_ ? part : 1.0) * (thrust - thrust_);
    lift_ += (started_ ? part : 1.0) * (felt.z() - lift_);
    started_ = true;
    const AdaptiveValues& learned = loop.pilot().law().telemetry().adaptive;
    gains_ = {learned[0], learned[1]};
    bias_ = learned.segment<3>(8);
  }
  /// After it: what the law did.
  Instant tell(const ClosedLoop& loop) const;
  void setStep(double dt) { dt_ = dt; }

 private:
  BoundedSurface surface(const Vector3d& error, double mass) const {
    const double side = std::clamp(0.7 * share_.sideways(mass), 0.3, 4.0);
    const double down = std::clamp(0.8 * share_.upwards(mass), 0.2, 6.0);
    return {error, {2.5, side, 5.0}, {3.0, error.z() > 0.0 ? down : 6.0, 4.0}};
  }

  const Vehicle& vehicle_;
  ThrustShare share_;
  State state_;
  double mass_ = 0.0;
  Vector3d rotors_, beside_, bias_;
  std::array<double, 2> gains_ = {};
  double thrust_ = 0.0, lift_ = 0.0, dt_ = 0.0;
  bool started_ = false;
};

Instant Witness::tell(const ClosedLoop& loop) const {
  const Telemetry& did = loop.pilot().law().telemetry();
  const SetPoint& goal = loop.pilot().goal();
  const double estimate = did.mass_estimate;
  const Vector3d error = state_.position - goal.position;
  const Vector3d rate = state_.velocity - goal.velocity;
  const BoundedSurface surface = this->surface(error, estimate);
  Instant at;
  at.sliding = rate + surface.value();
  at.size = std::hypot(error.norm(), rate.norm());
  at.bias = bias_;
  at.gains = gains_;
  const Vector3d force = did.adaptive.segment<3>(5);
  at.left = beside_ - force;
  const double robust = gains_[0] + gains_[1] * at.size;
  const Vector3d wanted = goal.acceleration - surface.slopeTimes(rate) -
                          kDamping.cwiseProduct(bounded(at.sliding)) -
                          robust * saturate(at.sliding, kLayer) - force - bias_ + kGravityVector;
  const ThrustShare::Force shared = share_.share(estimate * wanted, estimate);
  at.tracking = (rotors_ - did.force) / mass_ - (wanted - shared.force / estimate);
  at.asked = did.force.norm() / estimate;
  at.mass = mass_;
  at.mass_error = estimate - mass_;
  at.measured_error = thrust_ / lift_ - mass_;
  at.goal = goal.position;
  at.gains_learn = !shared.clamped && !loop.pilot().allocation().saturated;
  const double side = at.gains_learn && surface.linearSideways() ? 1.0 : 0.0;
  at.learning = {side, side, at.gains_learn && surface.linearVertically() ? 1.0 : 0.0};
  return at;
}

/// A flight at 2 kHz, where steps hardly matter, and the steps of it in which V rose faster than
/// the bound lets it.
struct Judged {
  int steps = 0;
  int broken = 0;
  double worst = 0.0;  // beyond the bound, as a share of its terms
};

struct Step {
  Instant before, after;
};

std::vector<Step> flown(Scenario scenario) {
  scenario.world.control_period = 500'000;
  scenario.world.plant_step = 250'000;
  const Vehicle vehicle = test::vehicleNamed("pelican");
  ClosedLoop loop(scenario, vehicle, test::lawNamed("composite", vehicle));
  Witness witness(vehicle);
  witness.setStep(toSeconds(scenario.world.control_period));
  std::vector<Step> steps;
  std::optional<Instant> before;
  while (!loop.done()) {
    witness.look(loop);
    loop.advance();
    const Instant after = witness.tell(loop);
    // A payload that comes or goes is a jump of V, and so is a step of the set point.
    if (before && before->mass == after.mass && (before->goal - after.goal).norm() < 0.1 &&
        toSeconds(loop.plant().now()) > 0.2) {
      steps.push_back({*before, after});
    }
    before = after;
  }
  EXPECT_FALSE(loop.plant().crashTime());
  return steps;
}

Judged judge(const std::vector<Step>& steps, const Factors& factors) {
  constexpr double kStep = 5e-4;
  constexpr double kTolerance = 0.01;
  Judged judged;
  for (const Step& step : steps) {
    const Vector3d change = (step.after.left - step.before.left) / kStep;
    const Bound first = bound(step.before, change, factors);
    const Bound second = bound(step.after, change, factors);
    const double power =
        (step.after.value(factors.mass_weight) - step.before.value(factors.mass_weight)) / kStep;
    const double excess = power - 0.5 * (first.power + second.power);
    const double scale = 0.5 * (first.scale + second.scale) + 1e-4;
    ++judged.steps;
    judged.worst = std::max(judged.worst, excess / scale);
    if (excess > kTolerance * scale) ++judged.broken;
  }
  return judged;
}

class CompositeTheorem : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    flights_ = new std::vector<std::vector<Step>>{
        flown(test::carrying(0.4, 0.0, {1.0, 4.0}, 7.0)), flown(test::circling(1.0, 0.3, 7.0)),
        flown(test::blown(8.0, 1.0, 6.0)), flown(test::stepping(7.0))};
  }
  static void TearDownTestSuite() { delete flights_; }
  static int broken(const Factors& factors) {
    int broken = 0;
    for (const std::vector<Step>& flight : *flights_) broken += judge(flight, factors).broken;
    return broken;
  }
  static std::vector<std::vector<Step>>* flights_;
};
std::vector<std::vector<Step>>* CompositeTheorem::flights_ = nullptr;

TEST_F(CompositeTheorem, HoldsAlongFlightsOfTheRealLaw) {
  const std::array<const char*, 4> names = {"payload", "circle", "wind", "steps"};
  for (std::size_t i = 0; i < flights_->size(); ++i) {
    const Judged judged = judge((*flights_)[i], {});
    std::printf("%s: %d steps, beyond the bound by at most %.4f of its terms, broken %d\n",
                names[i], judged.steps, judged.worst, judged.broken);
    EXPECT_EQ(judged.broken, 0) << names[i];
    EXPECT_GT(judged.steps, 10000);
  }
}

TEST_F(CompositeTheorem, HoldsForAnyWeightOfTheMass) {
  Factors factors;
  factors.mass_weight = 0.1;
  EXPECT_EQ(broken(factors), 0);
}

// A bound that promises more than this one is broken: a decay twice as fast, half of what disturbs.
TEST_F(CompositeTheorem, EachOfItsConstantsIsNeeded) {
  struct Wrong {
    const char* name;
    double Factors::*constant;
    double factor;
  };
  const std::array<Wrong, 10> wrongs = {{{"damping", &Factors::damping, 2.0},
                                         {"tracking", &Factors::tracking, 0.5},
                                         {"coupling", &Factors::coupling, 0.5},
                                         {"drive", &Factors::drive, 0.5},
                                         {"leak", &Factors::leak, 2.0},
                                         {"change", &Factors::change, 0.5},
                                         {"mass", &Factors::mass, 2.0},
                                         {"measured", &Factors::measured, 0.5},
                                         {"robust", &Factors::robust, 2.0},
                                         {"forgetting", &Factors::forgetting, 2.0}}};
  for (const Wrong& wrong : wrongs) {
    Factors factors;
    factors.mass_weight = 0.1;
    factors.*wrong.constant = wrong.factor;
    const int steps = broken(factors);
    std::printf("%s x %.1f: broken in %d steps\n", wrong.name, wrong.factor, steps);
    EXPECT_GT(steps, 50) << wrong.name;
  }
}

// The projections: what the accelerometer says wrongly is more than d_s may make good, and a
// payload is heavier than the rotors lift.
TEST(CompositeProjections, KeepTheEstimatesWithinTheirBounds) {
  const Vehicle vehicle = test::vehicleNamed("pelican");
  Scenario scenario = test::sensing(test::carrying(3.0, 0.0, {4.0, 20.0}, 5.0), true, 0);
  scenario.world.sensors->imu.force_bias.x() = 5.0;
  scenario.world.start.position.z() = 20.0;
  scenario.mission.set_points.front().set_point.position.z() = 20.0;
  ClosedLoop loop(scenario, vehicle, test::lawNamed("composite", vehicle));
  double bias = 0.0;
  double mass = 0.0;
  while (!loop.done()) {
    loop.advance();
    const Telemetry& seen = loop.pilot().law().telemetry();
    bias = std::max(bias, seen.adaptive.segment<3>(8).norm());
    mass = std::max(mass, seen.mass_estimate);
  }
  EXPECT_NEAR(bias, 3.0, 1e-9);
  EXPECT_NEAR(mass, 0.98 * vehicle.maxThrust() / kGravity, 1e-9);
}

/// The numbers of the second half of the theorem, dV/dt <= -varrho V + D, each as it is printed.
struct Ultimate {
  double sliding = 0.5;   // lambda |s|^2
  double bias = 0.25;     // sigma |d~|^2
  double mass = 0.25;     // c beta m~^2
  double tracking = 1.0;  // |epsilon|^2 / lambda
  double measured = 0.5;  // c beta nu^2
  double left = 0.5;      // sigma |d-bar|^2
  double change = 1.0;    // |d-bar'|^2 / sigma
  double layer = 0.25;    // rho varpi
};

/// How far the bound of the flights is above -varrho V + D at worst, of scalars drawn by the dice,
/// each of them 0 in every second draw.
double worstExcess(const Ultimate& of) {
  constexpr double kLambda = 5.0;
  test::Dice dice(31);
  double worst = -1e9;
  for (int i = 0; i < 200000; ++i) {
    const auto draw = [&dice] { return dice.index(2) == 0 ? 0.0 : dice.between(-2.0, 2.0); };
    const double s = std::abs(draw()), tracking = std::abs(draw()), m = 0.1 * draw();
    const double bias = draw(), left = draw(), change = 0.05 * draw(), nu = 0.1 * draw();
    const double asked = 20.0 * std::abs(draw()), gain = std::abs(draw());
    const double c = 4.0 * 40.0 * 40.0 / (kLambda * kMassRate);  // of a mass of 1 kg
    const double rate = c * kMassRate;
    const double power = -kLambda * s * s + s * tracking + s * asked * std::abs(m) -
                         kLeak * bias * (bias + left) - bias * change - rate * m * m +
                         rate * m * nu - gain * s * std::min(s / kLayer, 1.0) +
                         std::min(s, 1.0) * gain - kForgetting * gain * gain;
    const double decay = of.sliding * kLambda * s * s + of.bias * kLeak * bias * bias +
                         of.mass * rate * m * m + kForgetting * gain * gain;
    const double drift = of.tracking * tracking * tracking / kLambda +
                         of.measured * rate * nu * nu + of.left * kLeak * left * left +
                         of.change * change * change / kLeak +
                         (s < kLayer ? of.layer * gain * kLayer : 0.0);
    worst = std::max(worst, power - (drift - decay));
  }
  return worst;
}

TEST(CompositeUltimateBound, FollowsFromTheBoundAndNeedsEachOfItsNumbers) {
  EXPECT_LT(worstExcess({}), 1e-12);
  for (double Ultimate::*decay : {&Ultimate::sliding, &Ultimate::bias, &Ultimate::mass}) {
    Ultimate wrong;
    wrong.*decay *= 2.0;
    EXPECT_GT(worstExcess(wrong), 1e-6);
  }
  for (double Ultimate::*drift : {&Ultimate::tracking, &Ultimate::measured, &Ultimate::left,
                                  &Ultimate::change, &Ultimate::layer}) {
    Ultimate wrong;
    wrong.*drift *= 0.5;
    EXPECT_GT(worstExcess(wrong), 1e-6);
  }
}

}  // namespace
}  // namespace aqc
