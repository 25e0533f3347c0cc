#pragma once

#include <sstream>
#include <string>

namespace aqc {

/// A number as error messages print it: to 12 digits, which tells apart what a person would,
/// without noise in the last places.
inline std::string numberText(double value) {
  constexpr int kDigits = 12;
  std::ostringstream out;
  out.precision(kDigits);
  out << value;
  return out.str();
}

}  // namespace aqc
