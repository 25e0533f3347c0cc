#include "simulation/contact.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "adaptive_quadrotor_control/model/state.h"

namespace aqc {

Contact::Contact(const Vehicle& vehicle, std::vector<Box> walls, bool ground)
    : walls_(std::move(walls)),
      ground_(ground),
      rotor_count_(static_cast<int>(vehicle.rotors.size())),
      stiffness_(vehicle.mass * kGravity / (kFeet * kRestSink)),
      damping_(2.0 * kDampingRatio * std::sqrt(stiffness_ * vehicle.mass / kFeet)) {
  if (ground_ || !walls_.empty()) longest_step_ = longestStableStep(vehicle);
  std::size_t next = 0;
  // The feet sink a little at rest; the vehicle then stands at exactly gear_height.
  const double bottom = -vehicle.gear_height - kRestSink;
  for (const Eigen::Vector2d& foot : vehicle.feet()) points_[next++] << foot, bottom;
  for (const Rotor& rotor : vehicle.rotors) points_[next++] << rotor.position(), 0.0;
  setPayload(nullptr);
}

// Rocking on the feet: springs and dampers along the normal at half the squared radius, dampers
// across it at the height of the centre of mass.
double Contact::longestStableStep(const Vehicle& vehicle) const {
  constexpr double kStable = 2.5;  // rate * step; RK4's limit is 2.78
  const double inertia = vehicle.inertia.diagonal().minCoeff();
  const double radius = 0.5 * kFeet * vehicle.gear_radius * vehicle.gear_radius;
  const double height = kFeet * vehicle.gear_height * vehicle.gear_height;
  const double spring_rate = std::sqrt(stiffness_ * radius / inertia);
  const double damper_rate = damping_ * (radius + height) / inertia;
  return kStable / (spring_rate + damper_rate);
}

void Contact::setPayload(const Payload* payload) {
  point_count_ = kFeet + rotor_count_;
  if (payload != nullptr) {
    for (const double x : {-0.5, 0.5}) {
      for (const double y : {-0.5, 0.5}) {
        points_[static_cast<std::size_t>(point_count_++)] =
            payload->offset + payload->size.cwiseProduct(Eigen::Vector3d(x, y, -0.5));
      }
    }
  }
  reach_ = 0.0;
  for (int i = 0; i < point_count_; ++i) {
    reach_ = std::max(reach_, points_[static_cast<std::size_t>(i)].norm());
  }
}

bool Contact::near(const Eigen::Vector3d& position, double margin) const noexcept {
  return isNear(position, reach_ + margin, ground_, walls_);
}

template <class Visit>
void Contact::forEachTouch(const Eigen::Vector3d& position, const Eigen::Matrix3d& rotation,
                           Visit visit) const noexcept {
  for (int i = 0; i < point_count_; ++i) {
    const Eigen::Vector3d& point = points_[static_cast<std::size_t>(i)];
    const double height = position.z() + rotation.row(2).dot(point);
    if (ground_ && height < 0.0) visit(i, point, penetrationIntoGround(height), false);
    for (const Box& wall : walls_) {
      const Penetration inside = penetrationInto(wall, position + rotation * point);
      if (inside.depth > 0.0) visit(i, point, inside, true);
    }
  }
}

ForceMoment Contact::force(const Eigen::Vector3d& position, const Eigen::Matrix3d& rotation,
                           const Eigen::Vector3d& velocity, const Eigen::Vector3d& body_rate,
                           const Eigen::Vector3d& centre_of_mass) const noexcept {
  ForceMoment total;
  const auto push = [&](int, const Eigen::Vector3d& point, const Penetration& inside, bool) {
    const Eigen::Vector3d speed = velocity + rotation * body_rate.cross(point);
    const Eigen::Vector3d force = pushOf(inside, speed, stiffness_, damping_);
    total.force += force;
    total.moment += (point - centre_of_mass).cross(rotation.transpose() * force);
  };
  forEachTouch(position, rotation, push);
  return total;
}

Contact::Judgement Contact::judge(const Eigen::Vector3d& position, const Eigen::Matrix3d& rotation,
                                  const Eigen::Vector3d& velocity,
                                  const Eigen::Vector3d& body_rate) const noexcept {
  Judgement judgement;
  const auto look = [&](int index, const Eigen::Vector3d& point, const Penetration& inside,
                        bool wall) {
    judgement.touching = true;
    if (judgement.crash != Crash::kNone) return;
    const double impact = -(velocity + rotation * body_rate.cross(point)).dot(inside.normal);
    if (wall) {
      judgement.crash = Crash::kWallStrike;
    } else if (index >= kFeet && index < kFeet + rotor_count_) {
      judgement.crash = Crash::kRotorStrike;
    } else if (impact > kCrashSpeed) {
      judgement.crash = Crash::kHardImpact;
    } else if (rotation(2, 2) < std::cos(kCrashTilt)) {
      judgement.crash = Crash::kTiltedContact;
    }
  };
  forEachTouch(position, rotation, look);
  return judgement;
}

}  // namespace aqc
