#include "adaptive_quadrotor_control/law/cascaded_law.h"

#include "adaptive_quadrotor_control/parameters/parameter_reader.h"

namespace aqc {

CascadedLaw::CascadedLaw(const ParameterReader& reader)
    : limits_{reader.angle({"max_tilt_deg", "", "deg", "largest tilt commanded"},
                           Range::positiveUpTo(89.0)),
              reader.number(
                  {"min_lift", "", "N", "least vertical force that decides the commanded attitude"},
                  Range::positive())} {}

Wrench CascadedLaw::update(const State& state, const SetPoint& set_point, double dt) noexcept {
  telemetry_.position_error = state.position - set_point.position;
  telemetry_.velocity_error = state.velocity - set_point.velocity;
  telemetry_.force = force(set_point, dt);

  const Eigen::Matrix3d desired = desiredAttitude(telemetry_.force, set_point.yaw, limits_);
  const AttitudeErrors errors = attitudeErrors(state, desired, set_point.yaw_rate);
  telemetry_.desired_attitude = Eigen::Quaterniond(desired);
  telemetry_.attitude_error = errors.angle;
  telemetry_.rate_error = errors.rate;

  Wrench wrench;
  wrench.thrust = telemetry_.force.dot(state.attitude * Eigen::Vector3d::UnitZ());
  wrench.moment = moment(state, errors, dt);
  report(telemetry_);
  return wrench;
}

}  // namespace aqc
