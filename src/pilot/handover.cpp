#include "adaptive_quadrotor_control/pilot/handover.h"

#include "adaptive_quadrotor_control/math/number_text.h"

namespace aqc {
namespace {

std::string tooLarge(const char* what, double value, double limit, const char* unit) {
  if (value <= limit) return "";
  return formatted("the %s error is %.2f %s; at most %.2f %s is allowed", what, value, unit, limit,
                   unit);
}

}  // namespace

std::string handoverObstacle(const Telemetry& last, bool saturated, const HandoverLimits& limits) {
  if (saturated) return "the rotors are saturated; another law would have nothing left to steer";
  for (const std::string& problem :
       {tooLarge("position", last.position_error.norm(), limits.position_error, "m"),
        tooLarge("velocity", last.velocity_error.norm(), limits.velocity_error, "m/s"),
        tooLarge("attitude", last.attitude_error.norm(), limits.attitude_error, "rad")}) {
    if (!problem.empty()) return problem;
  }
  return "";
}

}  // namespace aqc
