#include "simulation/cable_load.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace aqc::kernel {
namespace {

// What RK4 leaves of a length in a step, and of its rate [m], [m/s]; a cable is taut within them.
constexpr double kSlop = 1e-6;
constexpr double kShortest = 1e-9;     // [s]: no step is shorter
constexpr double kLeastLength = 1e-3;  // [m]: nearer to its hook a load has no direction

LoadMotion pointAt(const FreeMotion& motion) {
  LoadMotion load;
  load.position = motion.position;
  load.velocity = motion.velocity;
  load.attitude.w() = 1.0;
  return load;
}

}  // namespace

// A load that swings down may meet the ground at any speed: nothing of the vehicle strikes.
CableLoad::CableLoad(const Payload& payload, const Cable& cable, const FreeMotion& motion,
                     const RigidBody& vehicle)
    : HangingLoad(payload,
                  LoadContact(payload, true, std::numeric_limits<double>::infinity(),
                              vehicle.walls(), vehicle.contact().hasGround()),
                  pointAt(motion)),
      hook_(payload.offset),
      length_(cable.length) {}

CableLoad::Line CableLoad::lineAt(const Carrier& vehicle, const LoadMotion& load) const noexcept {
  const Eigen::Vector3d hook = vehicle.position + vehicle.rotation * hook_;
  const Eigen::Vector3d speed =
      load.velocity - vehicle.velocity - vehicle.rotation * vehicle.body_rate.cross(hook_);
  Line line;
  line.along = load.position - hook;
  line.length = line.along.norm();
  line.along /= std::max(line.length, kLeastLength);
  line.rate = line.along.dot(speed);
  line.turning =
      (speed - line.rate * line.along).squaredNorm() / std::max(line.length, kLeastLength);
  line.lever = hook_.cross(vehicle.rotation.transpose() * line.along);
  line.mobility =
      1.0 / mass_ + vehicle.inverse_mass + line.lever.dot(vehicle.inverse_inertia * line.lever);
  return line;
}

double CableLoad::parting(const Line& line, const Carrier& vehicle,
                          const Eigen::Vector3d& load_acceleration) const noexcept {
  const Eigen::Vector3d& rate = vehicle.body_rate;
  const Eigen::Vector3d hook_acceleration =
      vehicle.acceleration + vehicle.rotation * (vehicle.angular_acceleration.cross(hook_) +
                                                 rate.cross(rate.cross(hook_)));
  return line.along.dot(load_acceleration - hook_acceleration) + line.turning;
}

double CableLoad::parting(const Line& line, const Carrier& vehicle) const noexcept {
  Eigen::Vector3d moment;
  return parting(line, vehicle, fall(motion_, moment).velocity);
}

ForceMoment CableLoad::pull(const Carrier& vehicle, const LoadMotion& load,
                            LoadMotion& slope) const noexcept {
  Eigen::Vector3d moment;
  slope = fall(load, moment);  // a point does not turn
  if (!taut_) return {};
  const Line line = lineAt(vehicle, load);
  const double tension = std::max(0.0, parting(line, vehicle, slope.velocity) / line.mobility);
  slope.velocity -= tension / mass_ * line.along;
  return {tension * line.along, tension * line.lever};
}

// Takes the rate of the length away.
void CableLoad::strike(RigidBody& vehicle, const Line& line) noexcept {
  const double impulse = line.rate / line.mobility;
  motion_.velocity -= impulse / mass_ * line.along;
  vehicle.strike({impulse * line.along, impulse * line.lever});
}

// Decides whether the cable pulls from now on, strikes if it must, and says for how long it stays
// as it is [s]: of a slack one as far as its present motion tells.
double CableLoad::judgeTension(RigidBody& vehicle) noexcept {
  constexpr double kForEver = std::numeric_limits<double>::infinity();
  taut_ = false;
  Carrier carrier = vehicle.carrier();
  Line line = lineAt(carrier, motion_);
  const double gap = line.length - length_;
  if (gap >= -kSlop && line.rate > -kSlop) {
    if (line.rate > 0.0) {
      strike(vehicle, line);
      carrier = vehicle.carrier();
      line = lineAt(carrier, motion_);
    }
    taut_ = parting(line, carrier) > 0.0;
    return kForEver;
  }
  if (gap >= 0.0) return kForEver;
  // gap + rate t + parting t^2 / 2 = 0
  const double root = line.rate * line.rate - 2.0 * parting(line, carrier) * gap;
  const double slowest = line.rate + std::sqrt(std::max(root, 0.0));
  return root >= 0.0 && slowest > 0.0 ? -2.0 * gap / slowest : kForEver;
}

void CableLoad::advance(RigidBody& vehicle, const RotorArray& command, double dt) noexcept {
  const double parts = std::max(1.0, std::ceil(dt / kLongestPart));
  for (int i = 0; i < static_cast<int>(parts); ++i) part(vehicle, command, dt / parts);
  judge(vehicle);
}

void CableLoad::part(RigidBody& vehicle, const RotorArray& command, double dt) noexcept {
  const double until = judgeTension(vehicle);
  if (until < dt) {  // the cable becomes taut on the way
    vehicle.stepWith(*this, command, std::max(until, kShortest));
    judgeTension(vehicle);
    dt -= until;
  }
  vehicle.stepWith(*this, command, std::max(dt, kShortest));
  if (taut_) keepLength(vehicle);
}

// The constraint is on the second derivative of the length; what a step has left in length and rate
// goes here, unless the cable has become slack.
void CableLoad::keepLength(RigidBody& vehicle) noexcept {
  const Line line = lineAt(vehicle.carrier(), motion_);
  const double gap = line.length - length_;
  if (gap < -kSlop || line.rate < -kSlop) return;
  motion_.position -= gap * line.along;
  strike(vehicle, line);
}

}  // namespace aqc::kernel
