#include "simulation/hanging_load.h"

#include <cmath>

namespace aqc::kernel {

bool HangingLoad::arrive(const LoadMotion& motion) noexcept {
  const double norm = motion.attitude.norm();
  const bool bearable =
      motion.position.norm() < kMostDistance && motion.velocity.norm() < kMostSpeed &&
      motion.body_rate.norm() < kMostSpeed && std::abs(norm - 1.0) < kMostNormError;
  if (!bearable) return false;  // so is what is not a number
  motion_ = motion;
  motion_.attitude /= norm;
  return true;
}

void HangingLoad::judge(RigidBody& vehicle) noexcept {
  const Contact::Judgement judgement =
      contact_.judge(motion_.position, Eigen::Quaterniond(motion_.attitude).toRotationMatrix(),
                     motion_.velocity, motion_.body_rate);
  touching_ = judgement.touching;
  if (judgement.crash != Crash::kNone) vehicle.declare(judgement.crash);
}

LoadMotion HangingLoad::fall(const LoadMotion& load, Eigen::Vector3d& moment) const noexcept {
  LoadMotion slope;
  slope.position = load.velocity;
  slope.velocity = -kGravity * Eigen::Vector3d::UnitZ();
  moment.setZero();
  if (!contact_.near(load.position)) return slope;
  const Eigen::Matrix3d rotation = Eigen::Quaterniond(load.attitude).toRotationMatrix();
  const ForceMoment contact =
      contact_.force(load.position, rotation, load.velocity, load.body_rate);
  slope.velocity += contact.force / mass_;
  moment = contact.moment;
  return slope;
}

}  // namespace aqc::kernel
