#pragma once

#include <string>

#include "adaptive_quadrotor_control/math/time.h"

namespace aqc {

/// Of all who publish on a topic it hears one: who was heard first, until nothing came of it for
/// `patience` [ns]. Two estimators that disagree would throw the vehicle to and fro.
class SoleSource {
 public:
  explicit SoleSource(Nanoseconds patience) : patience_(patience) {}

  /// Whether a message of `publisher` that comes at `now`, of a clock that does not go back, is to
  /// be heard.
  bool hears(const std::string& publisher, Nanoseconds now) {
    const bool silent = now - last_heard_ > patience_;
    if (publisher != name_) {
      if (!name_.empty() && !silent) return false;
      name_ = publisher;
    }
    last_heard_ = now;
    return true;
  }
  /// Who is heard; empty before anybody was.
  const std::string& name() const noexcept { return name_; }

 private:
  Nanoseconds patience_;
  Nanoseconds last_heard_ = 0;
  std::string name_;
};

}  // namespace aqc
