#pragma once

#include <string>

#include "adaptive_quadrotor_control/math/time.h"

namespace aqc {

/// Something that a flight was told to do and that was impossible, or done against a rule.
struct Refusal {
  Nanoseconds time = 0;
  std::string reason;
};

}  // namespace aqc
