#include "adaptive_quadrotor_control/parameters/schema.h"

#include <cmath>

#include "adaptive_quadrotor_control/math/number_text.h"

namespace aqc {

bool Range::contains(double value) const {
  return std::isfinite(value) && value <= max && (exclusive_min ? value > min : value >= min);
}

std::string Range::text() const {
  std::string text = "a finite number";
  if (std::isfinite(min)) text += (exclusive_min ? " > " : " >= ") + numberText(min);
  if (std::isfinite(max)) text += (std::isfinite(min) ? " and <= " : " <= ") + numberText(max);
  return text;
}

std::string Parameter::text() const {
  const std::string unit = key.unit.empty() ? "" : "[" + key.unit + "]";
  if (key.symbol.empty()) {
    return key.description + (unit.empty() || key.description.empty() ? "" : " ") + unit;
  }
  return key.symbol + (unit.empty() ? "" : " ") + unit + (key.description.empty() ? "" : ": ") +
         key.description;
}

}  // namespace aqc
