#pragma once

#include <sstream>
#include <stdexcept>

#include "adaptive_quadrotor_control/math/number_text.h"

namespace aqc {

/// Throws std::invalid_argument with the concatenation of the parts as message, numbers to
/// kMessageDigits.
template <typename... Parts>
[[noreturn]] void throwInvalidArgument(const Parts&... parts) {
  std::ostringstream message;
  message.precision(kMessageDigits);
  (message << ... << parts);
  throw std::invalid_argument(message.str());
}

}  // namespace aqc
