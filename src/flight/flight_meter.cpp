#include "adaptive_quadrotor_control/flight/flight_meter.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "adaptive_quadrotor_control/math/number_text.h"

namespace aqc {
namespace {

constexpr Nanoseconds kSettledWindow = 5'000'000'000;

}  // namespace

FlightMeter::FlightMeter(const MetricsWindow& window, std::string name)
    : window_(window), name_(std::move(name)) {}

void FlightMeter::add(const Step& step) noexcept {
  const bool grounded = step.touching && step.flying;
  if (!grounded) grounded_from_.reset();
  if (!step.flying) return;
  if (grounded && !grounded_from_) grounded_from_ = step.time;

  const double altitude_error = std::abs(step.position_error.z());
  lateral_error_ = step.position_error.head<2>();
  if (step.time >= window_.from) {
    position_ += step.position_error.array().square();
    attitude_ += step.attitude_error.array().square();
    ++count_;
  }
  if (step.time >= window_.last_payload_change) peak_ = std::max(peak_, altitude_error);
  if (step.time >= window_.end - kSettledWindow) {
    settled_ += altitude_error;
    ++settled_count_;
  }
}

FlightMetrics FlightMeter::metrics(const std::optional<Nanoseconds>& crash_time) const {
  if (count_ == 0 || settled_count_ == 0) {
    const Nanoseconds from = count_ == 0 ? window_.from : window_.end - kSettledWindow;
    throw std::invalid_argument("the flight of '" + name_ + "' has no step with a set point from " +
                                numberText(toSeconds(from)) + " s to " +
                                numberText(toSeconds(window_.end)) +
                                " s; its metrics need at least one");
  }
  FlightMetrics metrics;
  metrics.rms.position = (position_ / count_).sqrt();
  metrics.rms.attitude = (attitude_ / count_).sqrt() * 180.0 / M_PI;
  metrics.peak_altitude_error = peak_;
  metrics.settled_altitude_error = settled_ / settled_count_;
  metrics.final_lateral_error = lateral_error_->norm();
  if (crash_time) metrics.crash_time = toSeconds(*crash_time);
  if (grounded_from_) metrics.grounded_from = toSeconds(*grounded_from_);
  metrics.duration = toSeconds(window_.end);
  return metrics;
}

}  // namespace aqc
