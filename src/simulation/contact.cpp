#include "adaptive_quadrotor_control/simulation/contact.h"

#include <algorithm>
#include <cmath>

#include "adaptive_quadrotor_control/model/state.h"

namespace aqc {
namespace {

constexpr double kRestSink = 1e-3;      // of the feet under the empty vehicle [m]
constexpr double kDampingRatio = 0.5;   // of the empty vehicle bouncing on its feet
constexpr double kFriction = 0.7;       // Coulomb coefficient

}  // namespace

const char* toString(Crash crash) {
  switch (crash) {
    case Crash::kNone: return "none";
    case Crash::kHardImpact: return "hard impact";
    case Crash::kTiltedContact: return "tilted contact";
    case Crash::kRotorStrike: return "rotor strike";
  }
  return "unknown";
}

Contact::Contact(const Vehicle& vehicle)
    : rotor_count_(static_cast<int>(vehicle.rotors.size())),
      stiffness_(vehicle.mass * kGravity / (kFeet * kRestSink)),
      damping_(2.0 * kDampingRatio * std::sqrt(stiffness_ * vehicle.mass / kFeet)) {
  std::size_t next = 0;
  for (int i = 0; i < kFeet; ++i) {
    const double angle = (0.25 + 0.5 * i) * M_PI;
    // The feet sink a little at rest; the vehicle then stands at exactly gear_height.
    points_[next++] = {vehicle.gear_radius * std::cos(angle), vehicle.gear_radius * std::sin(angle),
                       -vehicle.gear_height - kRestSink};
  }
  for (const Rotor& rotor : vehicle.rotors) points_[next++] << rotor.position(), 0.0;
  setPayload(nullptr);
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

ForceMoment Contact::force(const Eigen::Vector3d& position, const Eigen::Matrix3d& rotation,
                           const Eigen::Vector3d& velocity, const Eigen::Vector3d& body_rate,
                           const Eigen::Vector3d& centre_of_mass) const noexcept {
  ForceMoment total;
  for (int i = 0; i < point_count_; ++i) {
    const Eigen::Vector3d& point = points_[static_cast<std::size_t>(i)];
    const double depth = -(position.z() + rotation.row(2).dot(point));
    if (depth <= 0.0) continue;
    const Eigen::Vector3d speed = velocity + rotation * body_rate.cross(point);
    const double normal = std::max(0.0, stiffness_ * depth - damping_ * speed.z());
    const Eigen::Vector2d sliding = speed.head<2>();
    const double sliding_speed = sliding.norm();
    const double drag = sliding_speed * damping_ > kFriction * normal
                            ? kFriction * normal / sliding_speed
                            : damping_;
    Eigen::Vector3d force;
    force << -drag * sliding, normal;
    total.force += force;
    total.moment += (point - centre_of_mass).cross(rotation.transpose() * force);
  }
  return total;
}

Contact::Judgement Contact::judge(const Eigen::Vector3d& position, const Eigen::Matrix3d& rotation,
                                  const Eigen::Vector3d& velocity,
                                  const Eigen::Vector3d& body_rate) const noexcept {
  Judgement judgement;
  for (int i = 0; i < point_count_; ++i) {
    const Eigen::Vector3d& point = points_[static_cast<std::size_t>(i)];
    if (position.z() + rotation.row(2).dot(point) >= 0.0) continue;
    judgement.touching = true;
    const double falling = -(velocity + rotation * body_rate.cross(point)).z();
    if (i >= kFeet && i < kFeet + rotor_count_) {
      judgement.crash = Crash::kRotorStrike;
    } else if (falling > kCrashSpeed) {
      judgement.crash = Crash::kHardImpact;
    } else if (rotation(2, 2) < std::cos(kCrashTilt)) {
      judgement.crash = Crash::kTiltedContact;
    }
    if (judgement.crash != Crash::kNone) break;
  }
  return judgement;
}

}  // namespace aqc
