#include "adaptive_quadrotor_control/law/cascaded_law.h"

#include <string>

#include "adaptive_quadrotor_control/parameters/parameter_reader.h"
#include "law/gain_ranges.h"

namespace aqc {
namespace {

AttitudeErrorKind readErrorKind(const ParameterReader& reader) {
  if (!reader.has("attitude_error")) return AttitudeErrorKind::kThesis;
  const std::string kind =
      reader.choice({"attitude_error", "e_q", "", "of the turn's sine or of its quaternion"},
                    {"thesis", "quaternion"});
  return kind == "thesis" ? AttitudeErrorKind::kThesis : AttitudeErrorKind::kQuaternion;
}

}  // namespace

CascadedLaw::CascadedLaw(const ParameterReader& reader)
    : limits_{reader.angle({"max_tilt_deg", "", "deg", "largest tilt commanded"},
                           Range::positiveUpTo(89.0)),
              reader.number(
                  {"min_lift", "", "N", "least vertical force that decides the commanded attitude"},
                  kPush)},
      error_kind_(readErrorKind(reader)) {}

Wrench CascadedLaw::command(const Sensed& sensed, const SetPoint& set_point, double) noexcept {
  const State& state = sensed.state;
  const PositionErrors position = {state.position - set_point.position,
                                   state.velocity - set_point.velocity};
  const Eigen::Vector3d force = this->force(position, set_point);
  const Eigen::Matrix3d desired = desiredAttitude(force, set_point.yaw, limits_);
  AttitudeErrors attitude = attitudeErrors(state, desired, set_point.yaw_rate, error_kind_);
  if (turn_) attitude.rate -= state.attitude.conjugate() * *turn_;
  const Wrench wrench = {force.dot(state.attitude * Eigen::Vector3d::UnitZ()),
                         moment(state, attitude)};

  telemetry_.position_error = position.position;
  telemetry_.velocity_error = position.velocity;
  telemetry_.force = force;
  telemetry_.desired_attitude = Eigen::Quaterniond(desired);
  telemetry_.attitude_error = attitude.angle;
  telemetry_.rate_error = attitude.rate;
  return wrench;
}

}  // namespace aqc
