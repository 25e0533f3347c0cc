#pragma once

#include <sstream>
#include <stdexcept>

namespace aqc {

/// Throws std::invalid_argument with the concatenation of the parts as message.
template <typename... Parts>
[[noreturn]] void throwInvalidArgument(const Parts&... parts) {
  std::ostringstream message;
  (message << ... << parts);
  throw std::invalid_argument(message.str());
}

}  // namespace aqc
