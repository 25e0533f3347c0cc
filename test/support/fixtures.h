#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cmath>
#include <cstring>
#include <memory>
#include <random>
#include <string>

#include "adaptive_quadrotor_control/law/law_factory.h"
#include "adaptive_quadrotor_control/model/state.h"
#include "adaptive_quadrotor_control/model/vehicle.h"
#include "adaptive_quadrotor_control/reference/set_point.h"
#include "adaptive_quadrotor_control/simulation/payload.h"
#include "support/source_tree.h"

/// What several tests and benchmarks share.
namespace aqc::test {

inline Vehicle vehicleNamed(const std::string& name) {
  return loadVehicle(configFile("vehicle/" + name));
}

inline Vehicle pelican() {
  return vehicleNamed("pelican_thesis");
}

inline std::unique_ptr<ControlLaw> lawNamed(const std::string& name, const Vehicle& vehicle) {
  return loadLaw(configFile("controller/" + name), vehicle);
}

/// One whole step of a law alone, as if the rotors gave just what it asks for.
inline Wrench step(ControlLaw& law, const Sensed& sensed, const SetPoint& set_point, double dt) {
  Allocation allocation;
  allocation.requested = allocation.achieved = law.command(sensed, set_point, dt);
  law.observe(allocation.achieved, dt);
  law.adapt({allocation, allocation.speeds}, dt);
  return allocation.requested;
}

/// A solid box whose top touches the origin of B.
inline Payload box(double mass, double edge = 0.1) {
  Payload payload;
  payload.mass = mass;
  payload.size.setConstant(edge);
  payload.offset = {0.0, 0.0, -0.5 * edge - 0.1};
  payload.inertia = boxInertia(mass, payload.size);
  return payload;
}

/// The speed at which all rotors together carry `mass` [rad/s].
inline RotorArray hoverSpeeds(const Vehicle& vehicle, double mass) {
  const auto count = static_cast<Eigen::Index>(vehicle.rotors.size());
  const double squared = mass * kGravity / (static_cast<double>(count) * vehicle.force_constant);
  return RotorArray::Constant(count, std::sqrt(squared));
}

/// Random numbers with a seed, the same on every machine.
class Dice {
 public:
  explicit Dice(unsigned seed) : engine_(seed) {}

  double between(double low, double high) {
    constexpr double kSpan = 4294967296.0;  // mt19937 gives 32 bits
    return low + (high - low) * static_cast<double>(engine_()) / kSpan;
  }
  int index(int count) { return static_cast<int>(between(0.0, count)); }
  Eigen::Vector3d vector(double size) {
    const double x = between(-size, size);
    const double y = between(-size, size);
    return {x, y, between(-size, size)};
  }
  Eigen::Quaterniond attitude() {
    Eigen::Vector4d q;
    do {
      for (double& entry : q) entry = between(-1.0, 1.0);
    } while (q.norm() > 1.0 || q.norm() < 0.1);
    return Eigen::Quaterniond(Eigen::Vector4d(q.normalized()));
  }
  /// Any attitude, high above the ground.
  State airborneState() {
    State state;
    state.position = Eigen::Vector3d(0.0, 0.0, 100.0) + vector(10.0);
    state.velocity = vector(5.0);
    state.attitude = attitude();
    state.body_rate = vector(4.0);
    return state;
  }
  RotorArray speeds(const Vehicle& vehicle) {
    RotorArray speeds(static_cast<Eigen::Index>(vehicle.rotors.size()));
    for (double& speed : speeds) speed = between(0.0, vehicle.max_rotor_speed);
    return speeds;
  }
  Payload payload() {
    Payload payload;
    payload.mass = between(0.05, 1.5);
    payload.size = {between(0.02, 0.3), between(0.02, 0.3), between(0.02, 0.3)};
    payload.offset = vector(0.2);
    payload.inertia = boxInertia(payload.mass, payload.size);
    return payload;
  }
  SetPoint setPoint() {
    SetPoint set_point;
    set_point.position = vector(5.0);
    set_point.velocity = vector(2.0);
    set_point.acceleration = vector(2.0);
    set_point.yaw = between(-7.0, 7.0);
    set_point.yaw_rate = between(-1.0, 1.0);
    return set_point;
  }

 private:
  std::mt19937 engine_;
};

/// The angle between two attitudes [rad].
inline double angleBetween(const Eigen::Quaterniond& a, const Eigen::Quaterniond& b) {
  return a.angularDistance(b);
}

template <typename Vector>
bool sameBits(const Vector& a, const Vector& b) {
  return a.size() == b.size() &&
         std::memcmp(a.data(), b.data(), sizeof(double) * static_cast<std::size_t>(a.size())) == 0;
}

inline bool sameBits(const State& a, const State& b) {
  return sameBits(a.position, b.position) && sameBits(a.velocity, b.velocity) &&
         sameBits(a.attitude.coeffs(), b.attitude.coeffs()) && sameBits(a.body_rate, b.body_rate);
}

}  // namespace aqc::test
