#pragma once

#include <vector>

#include "simulation/contact.h"

namespace aqc::kernel {

/// Contact of a payload that moves on its own with the ground and with walls, by the law of Contact
/// at its lower corners or, as a point mass, at its lowest point. Under its own weight it rests at
/// half its height: what presses on it from above makes it sink in.
class LoadContact {
 public:
  /// A load with four corners, or, if `point`, with one place that touches. A touch of the ground
  /// faster than `crash_speed` [m/s] is a crash, and so is any of a wall.
  LoadContact(const Payload& payload, bool point, double crash_speed, std::vector<Box> walls,
              bool ground);

  /// False when nothing can touch while its centre of mass is there (W).
  bool near(const Eigen::Vector3d& position) const noexcept;
  /// On a load whose centre of mass is at `position` and moves with `velocity` (W), with rotation R
  /// to W and `body_rate` in its own axes: the force in W, and the moment about that centre in its
  /// own axes.
  ForceMoment force(const Eigen::Vector3d& position, const Eigen::Matrix3d& rotation,
                    const Eigen::Vector3d& velocity,
                    const Eigen::Vector3d& body_rate) const noexcept;
  Contact::Judgement judge(const Eigen::Vector3d& position, const Eigen::Matrix3d& rotation,
                           const Eigen::Vector3d& velocity,
                           const Eigen::Vector3d& body_rate) const noexcept;

 private:
  // Calls visit(point in its own axes, its speed in W, penetration, is a wall).
  template <class Visit>
  void forEachTouch(const Eigen::Vector3d& position, const Eigen::Matrix3d& rotation,
                    const Eigen::Vector3d& velocity, const Eigen::Vector3d& body_rate,
                    Visit visit) const noexcept;

  std::vector<Eigen::Vector3d> points_;  // from the centre of mass
  std::vector<Box> walls_;
  bool ground_;
  double crash_speed_;
  double reach_ = 0.0;  // all points lie this close to the centre [m]
  double stiffness_;    // a point [N/m]
  double damping_;      // a point [N s/m]
};

}  // namespace aqc::kernel
