#include "adaptive_quadrotor_control/reference/circle.h"

#include <cmath>

namespace aqc {
namespace {

// The angle gone and its derivatives.
struct Phase {
  double angle, first, second, third;
};

Phase phaseAt(const Circle& circle, double time) noexcept {
  const double rate = circle.rate;
  const double ease = circle.ease;
  if (time >= ease) return {rate * (time - 0.5 * ease), rate, 0.0, 0.0};
  const double x = time / ease;
  return {rate * ease * x * x * x * (1.0 - 0.5 * x), rate * x * x * (3.0 - 2.0 * x),
          rate * 6.0 * x * (1.0 - x) / ease, rate * 6.0 * (1.0 - 2.0 * x) / (ease * ease)};
}

}  // namespace

SetPoint onCircle(const Circle& circle, double time) noexcept {
  const Phase phase = phaseAt(circle, time);
  const Eigen::Vector2d arm = circle.start.head<2>() - circle.centre;
  const double cosine = std::cos(phase.angle);
  const double sine = std::sin(phase.angle);
  const Eigen::Vector2d out(cosine * arm.x() - sine * arm.y(), sine * arm.x() + cosine * arm.y());
  const Eigen::Vector2d along(-out.y(), out.x());
  const double square = phase.first * phase.first;
  SetPoint point;
  point.position << circle.centre + out, circle.start.z();
  point.velocity.head<2>() = phase.first * along;
  point.acceleration.head<2>() = phase.second * along - square * out;
  point.jerk.head<2>() =
      (phase.third - square * phase.first) * along - 3.0 * phase.first * phase.second * out;
  return point;
}

}  // namespace aqc
