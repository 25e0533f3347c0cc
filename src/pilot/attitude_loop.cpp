#include "adaptive_quadrotor_control/pilot/attitude_loop.h"

#include <Eigen/Eigenvalues>
#include <cmath>

namespace aqc {
namespace {

constexpr double kSmall = 1e-4;   // [rad], [rad/s]: within every boundary layer
constexpr double kGrowth = 1e-6;  // in a step: less is rounding

// What the law asks for in this attitude at rest where it is to be.
double momentAbout(int axis, const ControlLaw& law, const State& state, double period) {
  Sensed sensed;
  sensed.state = state;
  sensed.specific_force = kGravity * Eigen::Vector3d::UnitZ();
  return law.clone()->command(sensed, SetPoint(), period).moment[axis];
}

// Of (angle, rate, moment), with the law's moment held for a step.
Eigen::Matrix3d step(double per_angle, double per_rate, double inertia, double lag, double period) {
  const double rest = lag > 0.0 ? std::exp(-period / lag) : 0.0;
  // What the present moment and the one asked for give of the moment's integral and its integral.
  const double present = lag * (1.0 - rest), asked = period - present;
  const double present_twice = lag * asked, asked_twice = 0.5 * period * period - present_twice;
  Eigen::Matrix3d step;
  step << 1.0, period, present_twice / inertia, 0.0, 1.0, present / inertia, 0.0, 0.0, rest;
  const Eigen::Vector3d input(asked_twice / inertia, asked / inertia, 1.0 - rest);
  return step + input * Eigen::RowVector3d(per_angle, per_rate, 0.0);
}

}  // namespace

const char* unstableAxis(const ControlLaw& law, const Eigen::Vector3d& inertia, double lag,
                         double period) {
  static constexpr const char* kNames[] = {"x", "y", "z"};
  for (int axis = 0; axis < 3; ++axis) {
    State turned, turning;
    turned.attitude = Eigen::AngleAxisd(kSmall, Eigen::Vector3d::Unit(axis));
    turning.body_rate[axis] = kSmall;
    const double level = momentAbout(axis, law, State(), period);
    const double per_angle = (momentAbout(axis, law, turned, period) - level) / kSmall;
    const double per_rate = (momentAbout(axis, law, turning, period) - level) / kSmall;
    const Eigen::Matrix3d loop = step(per_angle, per_rate, inertia[axis], lag, period);
    if (!loop.allFinite()) return kNames[axis];
    const Eigen::EigenSolver<Eigen::Matrix3d> poles(loop, false);
    if (poles.eigenvalues().cwiseAbs().maxCoeff() > 1.0 + kGrowth) return kNames[axis];
  }
  return nullptr;
}

}  // namespace aqc
