#include "adaptive_quadrotor_control/reference/sampling.h"

#include "reference/invalid_argument.h"

namespace aqc {

SetPoint toSetPoint(const FlatOutput& output) {
  SetPoint set_point;
  set_point.position = output.derivative[0].head<3>();
  set_point.velocity = output.derivative[1].head<3>();
  set_point.acceleration = output.derivative[2].head<3>();
  set_point.jerk = output.derivative[3].head<3>();
  set_point.yaw = output.derivative[0][3];
  set_point.yaw_rate = output.derivative[1][3];
  set_point.yaw_acceleration = output.derivative[2][3];
  return set_point;
}

void requireFewSetPoints(double duration, Nanoseconds period, long most) {
  if (period <= 0) {
    throwInvalidArgument("the period of the set points is ", period, " ns; it must be > 0");
  }
  const double longest = static_cast<double>(most) * toSeconds(period);
  if (!(duration <= longest)) {
    throwInvalidArgument("the duration is ", duration, " s; it must be <= ", longest,
                         " s, which makes ", most, " set points, one every ", toSeconds(period),
                         " s");
  }
}

std::vector<TimedSetPoint> sample(const PolynomialTrajectory& trajectory, Nanoseconds begin,
                                  Nanoseconds period, long most) {
  requireFewSetPoints(trajectory.duration(), period, most);
  std::vector<TimedSetPoint> set_points;
  const Nanoseconds duration = fromSeconds(trajectory.duration());
  for (Nanoseconds time = 0; time < duration; time += period) {
    set_points.push_back({begin + time, toSetPoint(trajectory.evaluate(toSeconds(time)))});
  }
  set_points.push_back({begin + duration, toSetPoint(trajectory.evaluate(trajectory.duration()))});
  return set_points;
}

}  // namespace aqc
