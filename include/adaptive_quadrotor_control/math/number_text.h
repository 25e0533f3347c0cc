#pragma once

#include <cstddef>
#include <cstdio>
#include <sstream>
#include <string>

namespace aqc {

/// Digits of numbers in error messages: they tell apart what a person would, without noise in the
/// last places.
constexpr int kMessageDigits = 12;

/// A number as error messages print it, to kMessageDigits.
inline std::string numberText(double value) {
  std::ostringstream out;
  out.precision(kMessageDigits);
  out << value;
  return out.str();
}

/// Values in a pattern of printf(), whose conversions they must fit.
template <class... Values>
std::string formatted(const char* pattern, Values... values) {
  const int size = std::snprintf(nullptr, 0, pattern, values...);
  std::string text(size > 0 ? static_cast<std::size_t>(size) : 0U, ' ');
  std::snprintf(text.data(), text.size() + 1, pattern, values...);
  return text;
}

}  // namespace aqc
