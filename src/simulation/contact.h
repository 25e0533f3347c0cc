#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <limits>
#include <vector>

#include "adaptive_quadrotor_control/model/force_moment.h"
#include "adaptive_quadrotor_control/model/vehicle.h"
#include "adaptive_quadrotor_control/simulation/box.h"
#include "adaptive_quadrotor_control/simulation/crash.h"
#include "adaptive_quadrotor_control/simulation/payload.h"

namespace aqc {

constexpr double kRestSink = 1e-3;     ///< of what rests on contact points under its weight [m]
constexpr double kDampingRatio = 0.5;  ///< of what bounces on them
constexpr double kFriction = 0.7;      ///< Coulomb coefficient

/// The force in W [N] on a point that moves with `speed` (W) in something solid: a damped spring
/// along the normal (never pulls), and friction, viscous up to the Coulomb limit. `stiffness`
/// [N/m]; `damping` along the normal and across it [N s/m].
inline Eigen::Vector3d pushOf(const Penetration& inside, const Eigen::Vector3d& speed,
                              double stiffness, double damping) {
  const double leaving = speed.dot(inside.normal);
  const double normal = std::max(0.0, stiffness * inside.depth - damping * leaving);
  const Eigen::Vector3d sliding = speed - leaving * inside.normal;
  const double sliding_speed = sliding.norm();
  const double drag =
      sliding_speed * damping > kFriction * normal ? kFriction * normal / sliding_speed : damping;
  return normal * inside.normal - drag * sliding;
}

/// Whether the ground, if there is one, or a wall is within `distance` [m] of `position` (W).
inline bool isNear(const Eigen::Vector3d& position, double distance, bool ground,
                   const std::vector<Box>& walls) noexcept {
  if (ground && position.z() < distance) return true;
  return std::any_of(walls.begin(), walls.end(), [&](const Box& wall) {
    return ((position - wall.min).array() > -distance).all() &&
           ((wall.max - position).array() > -distance).all();
  });
}

/// Contact of a vehicle and its payload with the flat ground z = 0 (unless there is none, as in a
/// study of free flight that starts at z = 0) and with walls, at points: four
/// feet, the hub of every rotor and the payload's four lower corners. Each point pushes back as a
/// damped spring along the normal (never pulls) and by friction, viscous up to the Coulomb limit.
class Contact {
 public:
  Contact(const Vehicle& vehicle, std::vector<Box> walls, bool ground = true);

  bool hasGround() const noexcept { return ground_; }
  const std::vector<Box>& walls() const noexcept { return walls_; }

  void setPayload(const Payload* payload);

  /// The longest integration step [s] with which RK4 keeps the vehicle standing on its feet: the
  /// lighter a vehicle turns, the faster it rocks on them. Infinite where there is nothing to
  /// touch.
  double longestStep() const noexcept { return longest_step_; }

  /// False when nothing can touch while the origin of B is within `margin` [m] of `position` (W).
  bool near(const Eigen::Vector3d& position, double margin) const noexcept;

  /// Contact force on a body whose origin is at `position` (W), with rotation R_B^W, velocity of
  /// the origin `velocity` (W) and `body_rate` (B); the moment is about `centre_of_mass` (in B).
  ForceMoment force(const Eigen::Vector3d& position, const Eigen::Matrix3d& rotation,
                    const Eigen::Vector3d& velocity, const Eigen::Vector3d& body_rate,
                    const Eigen::Vector3d& centre_of_mass) const noexcept;

  /// Whether any point touches, and whether that is a crash: anything that touches a wall, a rotor
  /// that touches, a contact faster than kCrashSpeed, or one while tilted by more than kCrashTilt.
  struct Judgement {
    bool touching = false;
    Crash crash = Crash::kNone;
  };
  Judgement judge(const Eigen::Vector3d& position, const Eigen::Matrix3d& rotation,
                  const Eigen::Vector3d& velocity, const Eigen::Vector3d& body_rate) const noexcept;

  static constexpr double kCrashSpeed = 3.0;  ///< [m/s], a fall from 0.46 m
  static constexpr double kCrashTilt = 0.8;   ///< [rad], 46 deg

 private:
  static constexpr int kFeet = 4;
  static constexpr int kCorners = 4;

  double longestStableStep(const Vehicle& vehicle) const;

  // Calls visit(index, point in B, penetration, is a wall) for every point that is inside
  // something.
  template <class Visit>
  void forEachTouch(const Eigen::Vector3d& position, const Eigen::Matrix3d& rotation,
                    Visit visit) const noexcept;

  std::array<Eigen::Vector3d, kFeet + kMaxRotors + kCorners> points_;  // in B; feet, hubs, corners
  std::vector<Box> walls_;
  bool ground_;
  int rotor_count_;
  int point_count_;
  double reach_ = 0.0;  // all points lie this close to the origin of B [m]
  double stiffness_;    // a point [N/m]
  double damping_;      // a point, along the normal and across it [N s/m]
  double longest_step_ = std::numeric_limits<double>::infinity();
};

}  // namespace aqc
