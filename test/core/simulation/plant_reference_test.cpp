#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <boost/numeric/odeint.hpp>
#include <cmath>
#include <vector>

#include "adaptive_quadrotor_control/simulation/rigid_plant.h"
#include "support/fixtures.h"

namespace aqc {
namespace {

namespace odeint = boost::numeric::odeint;
using Numbers = std::vector<double>;

/// The same physics set up another way: motion of the origin of B (not of the centre of mass),
/// rotation matrix (not quaternion), the 6 x 6 equations of a rigid body about that origin, every
/// rotor's forces at its own hub, and the rotors' lag as a differential equation.
struct Textbook {
  Vehicle vehicle;
  const Payload* payload = nullptr;
  Eigen::Vector3d wind = Eigen::Vector3d::Zero();
  ForceMoment disturbance;
  RotorArray command;
  std::array<RotorCondition, kMaxRotors> conditions;

  static Eigen::Matrix3d skew(const Eigen::Vector3d& v) {
    Eigen::Matrix3d matrix;
    matrix << 0.0, -v.z(), v.y(), v.z(), 0.0, -v.x(), -v.y(), v.x(), 0.0;
    return matrix;
  }

  // x holds p, v, R by columns, omega and the rotors' speeds.
  void operator()(const Numbers& x, Numbers& slope, double) const {
    const Eigen::Map<const Eigen::Vector3d> v(&x[3]);
    const Eigen::Map<const Eigen::Matrix3d> R(&x[6]);
    const Eigen::Map<const Eigen::Vector3d> omega(&x[15]);

    double mass = vehicle.mass;
    Eigen::Vector3d first = Eigen::Vector3d::Zero();  // mass times centre
    Eigen::Matrix3d second = vehicle.inertia;         // about the origin of B
    if (payload != nullptr) {
      mass += payload->mass;
      first = payload->mass * payload->offset;
      second += payload->inertia - payload->mass * skew(payload->offset) * skew(payload->offset);
    }

    Eigen::Vector3d force =
        R.transpose() * (disturbance.force - Eigen::Vector3d(0.0, 0.0, mass * kGravity));
    Eigen::Vector3d moment = disturbance.moment + (first / mass).cross(force);
    for (std::size_t i = 0; i < vehicle.rotors.size(); ++i) {
      const Rotor& rotor = vehicle.rotors[i];
      const double speed = x[18 + i];
      const Eigen::Vector3d hub(rotor.arm_length * std::cos(rotor.angle),
                                rotor.arm_length * std::sin(rotor.angle), 0.0);
      Eigen::Vector3d air = R.transpose() * (v - wind) + omega.cross(hub);
      air.z() = 0.0;
      const RotorCondition& condition = conditions[i];
      const double thrust = condition.effectiveness * vehicle.force_constant * speed * speed;
      const Eigen::Vector3d pull =
          Eigen::Vector3d(0.0, 0.0, thrust) - std::abs(speed) * vehicle.drag_coefficient * air;
      force += pull;
      moment += hub.cross(pull) - std::abs(speed) * vehicle.rolling_moment_coefficient * air;
      moment.z() -= rotor.direction * vehicle.moment_constant * thrust;
      const double target = command[static_cast<Eigen::Index>(i)];
      const double lag = target > speed ? vehicle.time_constant_up : vehicle.time_constant_down;
      slope[18 + i] = condition.stuck_at ? 0.0 : (target - speed) / (condition.slower * lag);
    }

    Eigen::Matrix<double, 6, 6> matrix;
    matrix << mass * Eigen::Matrix3d::Identity(), -skew(first), skew(first), second;
    Eigen::Matrix<double, 6, 1> load;
    load << force - omega.cross(omega.cross(first)), moment - omega.cross(second * omega);
    const Eigen::Matrix<double, 6, 1> acceleration = matrix.partialPivLu().solve(load);
    Eigen::Map<Eigen::Vector3d> dp(&slope[0]);
    Eigen::Map<Eigen::Vector3d> dv(&slope[3]);
    Eigen::Map<Eigen::Matrix3d> dR(&slope[6]);
    Eigen::Map<Eigen::Vector3d> domega(&slope[15]);
    dp = v;
    dv = R * acceleration.head<3>();
    dR = R * skew(omega);
    domega = acceleration.tail<3>();
  }

  State fly(const State& start, double duration) const {
    Numbers x(18 + vehicle.rotors.size(), 0.0);
    const Eigen::Matrix3d rotation = start.attitude.toRotationMatrix();
    std::copy_n(start.position.data(), 3, &x[0]);
    std::copy_n(start.velocity.data(), 3, &x[3]);
    std::copy_n(rotation.data(), 9, &x[6]);
    std::copy_n(start.body_rate.data(), 3, &x[15]);
    for (std::size_t i = 0; i < vehicle.rotors.size(); ++i) {
      x[18 + i] = conditions[i].stuck_at.value_or(0.0);
    }
    const auto stepper = odeint::make_controlled<odeint::runge_kutta_dopri5<Numbers>>(1e-12, 1e-12);
    odeint::integrate_adaptive(stepper, *this, x, 0.0, duration, 1e-4);
    State end;
    end.position = Eigen::Vector3d(&x[0]);
    end.velocity = Eigen::Vector3d(&x[3]);
    end.attitude = Eigen::Quaterniond(Eigen::Matrix3d(&x[6]));
    end.body_rate = Eigen::Vector3d(&x[15]);
    return end;
  }
};

/// Largest of the errors in position [m], velocity [m/s], attitude [rad] and body rate [rad/s].
double difference(const State& a, const State& b) {
  const Eigen::Quaterniond turn = a.attitude.conjugate() * b.attitude;
  return std::max({(a.position - b.position).norm(), (a.velocity - b.velocity).norm(),
                   2.0 * turn.vec().norm(), (a.body_rate - b.body_rate).norm()});
}

/// One random motion, flown by both.
struct Motion {
  Motion(const std::string& vehicle, bool loaded, test::Dice& dice)
      : book{test::vehicleNamed(vehicle), nullptr, dice.vector(6.0), {}, {}, {}},
        load(dice.payload()),
        start(dice.airborneState()),
        is_loaded(loaded) {
    book.disturbance = {dice.vector(2.0), dice.vector(0.02)};
    const double mass = book.vehicle.mass + (loaded ? load.mass : 0.0);
    book.command = test::hoverSpeeds(book.vehicle, mass);
    for (double& speed : book.command) speed *= dice.between(0.93, 1.05);
  }

  State textbook(double duration) {
    State begin = start;
    if (is_loaded) {
      book.payload = &load;
      begin = makePlant().state();  // attaching changes the motion; that has its own test
    }
    return book.fly(begin, duration);
  }

  RigidPlant makePlant() const {
    RigidPlant plant(book.vehicle, start);
    if (is_loaded) plant.attach(load);
    plant.setWind(book.wind);
    plant.setDisturbance(book.disturbance);
    for (std::size_t i = 0; i < book.vehicle.rotors.size(); ++i) {
      plant.setRotor(i, book.conditions[i]);
    }
    return plant;
  }

  State plant(double duration, double step) const {
    RigidPlant plant = makePlant();
    for (long i = 0; i < std::lround(duration / step); ++i) plant.step(book.command, step);
    return plant.state();
  }

  Textbook book;
  Payload load;
  State start;
  bool is_loaded;
};

TEST(PlantReference, AgreesWithAnAdaptiveIntegratorOnRandomMotions) {
  test::Dice dice(1);
  for (int i = 0; i < 40; ++i) {
    const char* names[] = {"pelican_thesis", "pelican", "hummingbird", "firefly"};
    Motion motion(names[i % 4], i % 8 >= 4, dice);
    const State expected = motion.textbook(0.5);
    const State actual = motion.plant(0.5, 1e-3);
    // These motions turn at W = 30 rad/s at most, so a step h of RK4 errs by about (W h)^5 / 120 =
    // 2e-10, 500 steps by 1e-7 rad, and the body rate by W times that.
    EXPECT_LT(expected.body_rate.norm(), 30.0) << "motion " << i;
    EXPECT_LT(difference(actual, expected), 3e-6) << "motion " << i;
    EXPECT_GT((expected.position - motion.start.position).norm(), 0.1) << "motion " << i;
  }
}

// One of each kind; small enough for the motion to stay as slow as the test's bound asks.
TEST(PlantReference, AgreesWithAnAdaptiveIntegratorWhenRotorsAreDamaged) {
  test::Dice dice(3);
  for (int i = 0; i < 24; ++i) {
    const char* names[] = {"pelican_thesis", "pelican", "hummingbird", "firefly"};
    Motion motion(names[i % 4], i % 8 >= 4, dice);
    const auto rotors = motion.book.vehicle.rotors.size();
    auto& conditions = motion.book.conditions;
    const auto first = static_cast<std::size_t>(dice.index(static_cast<int>(rotors)));
    conditions[first].effectiveness = dice.between(0.8, 1.0);
    conditions[(first + 1) % rotors].slower = dice.between(1.0, 3.0);
    conditions[(first + 2) % rotors].stuck_at = motion.book.command[0] * dice.between(0.95, 1.05);
    const State expected = motion.textbook(0.3);
    EXPECT_LT(expected.body_rate.norm(), 30.0) << "motion " << i;
    EXPECT_LT(difference(motion.plant(0.3, 1e-3), expected), 3e-6) << "motion " << i;
  }
}

TEST(PlantReference, ConvergesWithTheFourthPowerOfTheStep) {
  test::Dice dice(2);
  for (int i = 0; i < 8; ++i) {
    Motion motion("pelican_thesis", i % 2 == 1, dice);
    const State expected = motion.textbook(0.4);
    const double coarse = difference(motion.plant(0.4, 4e-3), expected);
    const double middle = difference(motion.plant(0.4, 2e-3), expected);
    const double fine = difference(motion.plant(0.4, 1e-3), expected);
    EXPECT_NEAR(std::log2(coarse / middle), 4.0, 0.6) << "motion " << i;
    EXPECT_NEAR(std::log2(middle / fine), 4.0, 0.6) << "motion " << i;
  }
}

}  // namespace
}  // namespace aqc
