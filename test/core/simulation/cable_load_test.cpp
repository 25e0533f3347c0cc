#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <array>
#include <boost/numeric/odeint.hpp>
#include <cmath>
#include <memory>
#include <vector>

#include "adaptive_quadrotor_control/simulation/flexible_plant.h"
#include "adaptive_quadrotor_control/simulation/timed_plant.h"
#include "support/fixtures.h"

namespace aqc {
namespace {

constexpr double kMass = 0.4;

// Without drag: what closed forms are about.
Vehicle smooth() {
  Vehicle vehicle = test::vehicleNamed("pelican");
  vehicle.drag_coefficient = vehicle.rolling_moment_coefficient = 0.0;
  return vehicle;
}

Payload bob(double length, const Eigen::Vector3d& hook = Eigen::Vector3d::Zero()) {
  Payload payload = test::box(kMass);
  payload.offset = hook;
  payload.mount = Cable{length};
  return payload;
}

State at(double height) {
  State state;
  state.position.z() = height;
  return state;
}

/// Rotors that turn at these speeds already.
void spinUp(FlexiblePlant& plant, const RotorArray& speeds) {
  for (int i = 0; i < 4; ++i) {
    RotorCondition turning;
    turning.stuck_at = speeds[i];
    plant.setRotor(static_cast<std::size_t>(i), turning);
  }
}

/// Swung aside by `angle` from straight below a vehicle at 50 m.
std::unique_ptr<FlexiblePlant> swung(const Vehicle& vehicle, double length, double angle,
                                     const Eigen::Vector3d& hook = Eigen::Vector3d::Zero()) {
  auto plant = std::make_unique<FlexiblePlant>(vehicle, at(50.0));
  FreeMotion motion;
  motion.position = Eigen::Vector3d(0.0, 0.0, 50.0) + hook +
                    length * Eigen::Vector3d(std::sin(angle), 0.0, -std::cos(angle));
  plant->pickUp(bob(length, hook), motion);
  return plant;
}

// Thrust carries both, the vehicle is free to move: sqrt(g (m_Q + m_L) / (l m_Q)).
TEST(CableLoad, SwingsFreelyAtTheFrequencyOfTheTextbook) {
  const Vehicle vehicle = smooth();
  for (const double length : {0.5, 1.0, 2.0}) {
    const auto plant = swung(vehicle, length, 0.01);
    const RotorArray hover = test::hoverSpeeds(vehicle, vehicle.mass + kMass);
    spinUp(*plant, hover);
    const double expected = std::sqrt(kGravity * (vehicle.mass + kMass) / (length * vehicle.mass));
    // Through zero for the n-th time after n - 1/2 half periods.
    int crossings = 0;
    double last = 1.0;
    double time = 0.0;
    while (crossings < 8 && time < 60.0) {
      plant->step(hover, 1e-3);
      time += 1e-3;
      const double aside = plant->payloadMotion().position.x() - plant->state().position.x();
      if ((aside > 0.0) != (last > 0.0)) ++crossings;
      last = aside;
    }
    EXPECT_NEAR(7.5 * M_PI / time, expected, 1e-3 * expected) << length;
  }
}

TEST(CableLoad, KeepsItsEnergyAndItsLengthWhenItSwingsFar) {
  const Vehicle vehicle = smooth();
  for (const Eigen::Vector3d& hook :
       {Eigen::Vector3d(0.0, 0.0, 0.0), Eigen::Vector3d(0.03, 0.02, -0.05)}) {
    // In free fall and spun up: the cable stays taut without a thrust that works.
    State start = at(500.0);
    start.body_rate = {0.5, 1.0, 0.3};
    FlexiblePlant plant(vehicle, start);
    FreeMotion motion;
    motion.position = Eigen::Vector3d(0.0, 0.0, 500.0) + hook + Eigen::Vector3d(1.0, 0.0, 0.0);
    motion.velocity = start.body_rate.cross(hook) + Eigen::Vector3d(0.0, 3.0, 1.0);
    plant.pickUp(bob(1.0, hook), motion);
    const double energy = plant.energy();
    for (int i = 0; i < 3000; ++i) {
      plant.step(RotorArray::Zero(4), 1e-3);
      const State state = plant.state();
      const Eigen::Vector3d cable =
          plant.payloadMotion().position - state.position - state.attitude * hook;
      ASSERT_NEAR(cable.norm(), 1.0, 1e-6) << i;
    }
    EXPECT_NEAR(plant.energy(), energy, 1e-6 * std::abs(energy));
  }
}

// The load flies away from the vehicle: at l the parting speed is gone, momentum is not.
TEST(CableLoad, SnatchTakesAwayThePartingSpeedAndKeepsMomentum) {
  const Vehicle vehicle = smooth();
  FlexiblePlant plant(vehicle, at(50.0));
  FreeMotion motion;
  motion.position = {0.3, 0.0, 50.0};
  motion.velocity = {2.0, 0.0, 0.0};
  plant.pickUp(bob(1.0), motion);
  const double before = plant.linearMomentum().x();
  const double slack_energy = plant.energy();
  for (int i = 0; i < 349; ++i) plant.step(RotorArray::Zero(4), 1e-3);
  EXPECT_NEAR(plant.payloadMotion().velocity.x(), 2.0, 1e-12);  // slack for 0.35 s
  for (int i = 0; i < 2; ++i) plant.step(RotorArray::Zero(4), 1e-3);
  const double common = kMass * 2.0 / (vehicle.mass + kMass);
  EXPECT_NEAR(plant.payloadMotion().velocity.x(), common, 1e-9);
  EXPECT_NEAR(plant.state().velocity.x(), common, 1e-9);
  EXPECT_NEAR(plant.linearMomentum().x(), before, 1e-12);
  const double reduced = vehicle.mass * kMass / (vehicle.mass + kMass);
  EXPECT_NEAR(slack_energy - plant.energy(), 0.5 * reduced * 4.0, 1e-6);
  EXPECT_NEAR(plant.payloadMotion().position.x() - plant.state().position.x(), 1.0, 1e-6);
}

/// K. Sreenath, T. Lee, V. Kumar 2013, eq. (1) to (5), of a hook in the centre of mass: position
/// and velocity of the load, direction q of the cable from vehicle to load and its rate omega,
/// attitude by columns and body rate, under a constant thrust f and moment M.
struct Sreenath {
  using Numbers = std::vector<double>;
  Vehicle vehicle;
  double length;
  double thrust;
  Eigen::Vector3d moment;

  void operator()(const Numbers& x, Numbers& slope, double) const {
    using Map = Eigen::Map<const Eigen::Vector3d>;
    const Map v(&x[3]);
    const Map q(&x[6]);
    const Map omega(&x[9]);
    const Eigen::Map<const Eigen::Matrix3d> R(&x[12]);
    const Map Omega(&x[21]);
    const double m_Q = vehicle.mass;
    const Eigen::Vector3d push = thrust * R.col(2);
    const Eigen::Vector3d dq = omega.cross(q);
    const Eigen::Vector3d a = (q.dot(push) - m_Q * length * dq.squaredNorm()) / (m_Q + kMass) * q -
                              kGravity * Eigen::Vector3d::UnitZ();
    const Eigen::Vector3d domega = -q.cross(push) / (m_Q * length);
    const Eigen::Vector3d dOmega =
        vehicle.inertia.inverse() * (moment - Omega.cross(vehicle.inertia * Omega));
    slope.resize(x.size());
    const auto write = [&slope](std::size_t where, const Eigen::Vector3d& value) {
      for (std::size_t i = 0; i < 3; ++i) slope[where + i] = value[static_cast<Eigen::Index>(i)];
    };
    write(0, v);
    write(3, a);
    write(6, dq);
    write(9, domega);
    for (std::size_t i = 0; i < 3; ++i) {
      const Eigen::Vector3d column = R * Omega.cross(Eigen::Vector3d::Unit(static_cast<int>(i)));
      write(12 + 3 * i, column);
    }
    write(21, dOmega);
  }
};

TEST(CableLoad, MovesAsTheEquationsOfSreenathLeeAndKumarSay) {
  namespace odeint = boost::numeric::odeint;
  const Vehicle vehicle = smooth();
  const double length = 0.8;
  const auto plant = swung(vehicle, length, 0.7);
  RotorArray speeds = test::hoverSpeeds(vehicle, vehicle.mass + kMass);
  speeds[0] *= 1.004;
  speeds[1] *= 0.995;
  spinUp(*plant, speeds);

  Sreenath book{vehicle, length, 0.0, Eigen::Vector3d::Zero()};
  for (std::size_t i = 0; i < 4; ++i) {
    const double speed = speeds[static_cast<Eigen::Index>(i)];
    const double thrust = vehicle.force_constant * speed * speed;
    const Eigen::Vector2d arm = vehicle.rotors[i].position();
    book.thrust += thrust;
    book.moment += Eigen::Vector3d(arm.y() * thrust, -arm.x() * thrust,
                                   -vehicle.rotors[i].direction * vehicle.moment_constant * thrust);
  }
  Sreenath::Numbers x(24, 0.0);
  const Eigen::Vector3d q(std::sin(0.7), 0.0, -std::cos(0.7));
  for (std::size_t i = 0; i < 3; ++i) {
    x[6 + i] = q[static_cast<Eigen::Index>(i)];
    x[i] = length * x[6 + i];
    x[12 + 4 * i] = 1.0;
  }
  x[2] += 50.0;
  const auto stepper =
      odeint::make_controlled<odeint::runge_kutta_dopri5<Sreenath::Numbers>>(1e-12, 1e-12);
  odeint::integrate_adaptive(stepper, book, x, 0.0, 1.0, 1e-3);

  for (int i = 0; i < 1000; ++i) plant->step(speeds, 1e-3);
  const Eigen::Vector3d load(x[0], x[1], x[2]);
  const Eigen::Vector3d hook = load - length * Eigen::Vector3d(x[6], x[7], x[8]);
  EXPECT_GT((load - Eigen::Vector3d(0.8 * q.x(), 0.0, 50.0 + 0.8 * q.z())).norm(), 0.3);
  EXPECT_LT((plant->payloadMotion().position - load).norm(), 1e-6);
  EXPECT_LT((plant->state().position - hook).norm(), 1e-6);
  EXPECT_LT((plant->payloadMotion().velocity - Eigen::Vector3d(x[3], x[4], x[5])).norm(), 1e-5);
}

TEST(CableLoad, IsLiftedOffTheGroundWhenTheCableIsTaut) {
  const Vehicle vehicle = test::vehicleNamed("pelican");
  Cargo cargo{"bob", bob(1.0), {0.3, 0.0, 0.05}, Eigen::Vector3d::Zero()};
  auto plant = std::make_unique<FlexiblePlant>(vehicle, at(0.6));
  TimedPlant timed(std::move(plant), {cargo}, 1'000'000);
  timed.schedule({0, AttachPayload{"bob", {}}});
  const RotorArray strong = test::hoverSpeeds(vehicle, 1.15 * (vehicle.mass + kMass));
  timed.advance(strong, 100'000'000);
  const Plant& now = timed.plant();
  ASSERT_TRUE(now.payload());
  EXPECT_TRUE(now.touching());
  EXPECT_NEAR(now.payloadMotion().position.z(), 0.05, 1e-4);
  EXPECT_NEAR(now.payloadMotion().position.x(), 0.3, 1e-4);
  timed.advance(strong, 1'500'000'000);
  EXPECT_FALSE(now.touching());
  EXPECT_GT(now.payloadMotion().position.z(), 0.3);
  EXPECT_NEAR((now.payloadMotion().position - now.state().position).norm(), 1.0, 1e-6);
  EXPECT_EQ(now.crash(), Crash::kNone);
}

TEST(CableLoad, CargoBeyondTheCableIsOutOfReach) {
  Cargo cargo{"bob", bob(1.0), {0.0, 0.0, 0.05}, Eigen::Vector3d::Zero()};
  const auto timed = [&](double height) {
    return TimedPlant(std::make_unique<FlexiblePlant>(test::pelican(), at(height)), {cargo},
                      1'000'000);
  };
  EXPECT_EQ(timed(1.0).obstacle({"bob", {}}), "");
  EXPECT_EQ(timed(1.15).obstacle({"bob", {}}),
            "bob is 1.10 m from the hook; its cable is 1.00 m long");
}

}  // namespace
}  // namespace aqc
