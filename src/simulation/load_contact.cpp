#include "simulation/load_contact.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "adaptive_quadrotor_control/model/state.h"

namespace aqc::kernel {

LoadContact::LoadContact(const Payload& payload, bool point, double crash_speed,
                         std::vector<Box> walls, bool ground)
    : walls_(std::move(walls)), ground_(ground), crash_speed_(crash_speed) {
  const double bottom = -0.5 * payload.size.z() - kRestSink;
  if (point) {
    points_.emplace_back(0.0, 0.0, bottom);
  } else {
    for (const double x : {-0.5, 0.5}) {
      for (const double y : {-0.5, 0.5}) {
        points_.emplace_back(x * payload.size.x(), y * payload.size.y(), bottom);
      }
    }
  }
  const auto count = static_cast<double>(points_.size());
  stiffness_ = payload.mass * kGravity / (count * kRestSink);
  damping_ = 2.0 * kDampingRatio * std::sqrt(stiffness_ * payload.mass / count);
  for (const Eigen::Vector3d& corner : points_) reach_ = std::max(reach_, corner.norm());
}

bool LoadContact::near(const Eigen::Vector3d& position) const noexcept {
  return isNear(position, reach_, ground_, walls_);
}

template <class Visit>
void LoadContact::forEachTouch(const Eigen::Vector3d& position, const Eigen::Matrix3d& rotation,
                               const Eigen::Vector3d& velocity, const Eigen::Vector3d& body_rate,
                               Visit visit) const noexcept {
  for (const Eigen::Vector3d& point : points_) {
    const Eigen::Vector3d place = position + rotation * point;
    const Eigen::Vector3d speed = velocity + rotation * body_rate.cross(point);
    if (ground_ && place.z() < 0.0) visit(point, speed, penetrationIntoGround(place.z()), false);
    for (const Box& wall : walls_) {
      const Penetration inside = penetrationInto(wall, place);
      if (inside.depth > 0.0) visit(point, speed, inside, true);
    }
  }
}

ForceMoment LoadContact::force(const Eigen::Vector3d& position, const Eigen::Matrix3d& rotation,
                               const Eigen::Vector3d& velocity,
                               const Eigen::Vector3d& body_rate) const noexcept {
  ForceMoment total;
  forEachTouch(position, rotation, velocity, body_rate,
               [&](const Eigen::Vector3d& point, const Eigen::Vector3d& speed,
                   const Penetration& inside, bool) {
                 const Eigen::Vector3d force = pushOf(inside, speed, stiffness_, damping_);
                 total.force += force;
                 total.moment += point.cross(rotation.transpose() * force);
               });
  return total;
}

Contact::Judgement LoadContact::judge(const Eigen::Vector3d& position,
                                      const Eigen::Matrix3d& rotation,
                                      const Eigen::Vector3d& velocity,
                                      const Eigen::Vector3d& body_rate) const noexcept {
  Contact::Judgement judgement;
  if (!near(position)) return judgement;
  forEachTouch(position, rotation, velocity, body_rate,
               [&](const Eigen::Vector3d&, const Eigen::Vector3d& speed, const Penetration& inside,
                   bool wall) {
                 judgement.touching = true;
                 if (judgement.crash != Crash::kNone) return;
                 if (wall) {
                   judgement.crash = Crash::kWallStrike;
                 } else if (-speed.dot(inside.normal) > crash_speed_) {
                   judgement.crash = Crash::kHardImpact;
                 }
               });
  return judgement;
}

}  // namespace aqc::kernel
