#include "adaptive_quadrotor_control/law/composite/applied_wrench.h"

#include <algorithm>

namespace aqc {

void AppliedWrench::observe(const Wrench& given, double dt) noexcept {
  if (count_ == 0) now_ = given;  // nothing is known from before
  last_ = (last_ + 1) % kSteps;
  Step& step = steps_[last_];
  step.mean.thrust = 0.5 * (now_.thrust + given.thrust);
  step.mean.moment = 0.5 * (now_.moment + given.moment);
  step.dt = dt;
  now_ = given;
  count_ = std::min(count_ + 1, kSteps);
}

AppliedWrench::Impulse AppliedWrench::since(double age) const noexcept {
  Impulse sum;
  double passed = 0.0;  // from now back
  for (std::size_t i = 0; i < count_ && passed < age; ++i) {
    const Step& step = steps_[(last_ + kSteps - i) % kSteps];
    const bool oldest = i + 1 == count_;
    const double dt = oldest ? age - passed : std::min(step.dt, age - passed);
    sum.thrust += dt * step.mean.thrust;
    sum.moment += dt * step.mean.moment;
    sum.turn += dt * (passed + 0.5 * dt) * step.mean.moment;
    passed += dt;
  }
  return sum;
}

Wrench AppliedWrench::mean(const Impulse& late, double age, double span) const noexcept {
  const Impulse whole = since(age + span);
  return {(whole.thrust - late.thrust) / span, (whole.moment - late.moment) / span};
}

}  // namespace aqc
