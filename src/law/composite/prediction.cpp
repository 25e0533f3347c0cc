#include "adaptive_quadrotor_control/law/composite/prediction.h"

#include "adaptive_quadrotor_control/math/rotations.h"

namespace aqc {
Eigen::Vector3d predictedRate(const MomentObserver& observer, const AppliedWrench& applied,
                              const Eigen::Vector3d& inertia, double age) noexcept {
  if (age <= 0.0) return observer.rate();
  const Eigen::Vector3d impulse = applied.since(age).moment + age * observer.moment();
  return observer.rate() + impulse.cwiseQuotient(inertia);
}

// The rate at any time s is omega-hat + (I(s) - I(t_o) + (s - t_o) d_q) / J, where I is the
// integral of the rotors' moment and t_o the time of omega-hat; this is its integral from the
// pose's time to now.
Eigen::Quaterniond predictedAttitude(const Eigen::Quaterniond& measured,
                                     const MomentObserver& observer, const AppliedWrench& applied,
                                     const Eigen::Vector3d& inertia, const Ages& ages) noexcept {
  const double age = ages.pose;
  if (age <= 0.0) return measured;
  const AppliedWrench::Impulse pose = applied.since(age);
  Eigen::Vector3d impulse = pose.turn + age * (ages.body_rate - 0.5 * age) * observer.moment();
  if (age != ages.body_rate) {
    impulse += age * (applied.since(ages.body_rate).moment - pose.moment);
  }
  return measured * turn(age * observer.rate() + impulse.cwiseQuotient(inertia), 1.0);
}

}  // namespace aqc
