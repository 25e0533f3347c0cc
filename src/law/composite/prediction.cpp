#include "adaptive_quadrotor_control/law/composite/prediction.h"

#include "adaptive_quadrotor_control/math/rotations.h"

namespace aqc {

Meanwhile meanwhile(const AppliedWrench& applied, const Ages& ages) noexcept {
  const AppliedWrench::Impulse pose = applied.since(ages.pose);
  return {pose, ages.body_rate == ages.pose ? pose : applied.since(ages.body_rate)};
}

Eigen::Vector3d predictedRate(const MomentObserver& observer, const AppliedWrench::Impulse& given,
                              const Eigen::Vector3d& inertia, double age) noexcept {
  if (age <= 0.0) return observer.rate();
  const Eigen::Vector3d impulse = given.moment + age * observer.moment();
  return observer.rate() + impulse.cwiseQuotient(inertia);
}

// The rate at any time s is omega-hat + (I(s) - I(t_o) + (s - t_o) d_q) / J, where I is the
// integral of the rotors' moment and t_o the time of omega-hat; this is its integral from the
// pose's time to now.
Eigen::Quaterniond predictedAttitude(const Eigen::Quaterniond& measured,
                                     const MomentObserver& observer, const Meanwhile& given,
                                     const Eigen::Vector3d& inertia, const Ages& ages) noexcept {
  const double age = ages.pose;
  if (age <= 0.0) return measured;
  Eigen::Vector3d impulse =
      given.pose.turn + age * (ages.body_rate - 0.5 * age) * observer.moment();
  if (age != ages.body_rate) {
    impulse += age * (given.body_rate.moment - given.pose.moment);
  }
  return measured * turn(age * observer.rate() + impulse.cwiseQuotient(inertia), 1.0);
}

}  // namespace aqc
