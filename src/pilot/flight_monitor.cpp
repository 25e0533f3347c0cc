#include "adaptive_quadrotor_control/pilot/flight_monitor.h"

#include <algorithm>
#include <cmath>

#include "adaptive_quadrotor_control/math/number_text.h"

namespace aqc {
namespace {

constexpr Nanoseconds kOverload = 420'000'000;

Health judged(double value, const Threshold& threshold) {
  if (!(value <= threshold.error)) return Health::kError;  // not a number, too
  return value > threshold.warn ? Health::kWarn : Health::kOk;
}

double share(std::uint32_t part, std::uint32_t whole) {
  return whole == 0 ? 0.0 : static_cast<double>(part) / static_cast<double>(whole);
}

}  // namespace

FlightMonitor::FlightMonitor(Nanoseconds period, const MonitorLimits& limits)
    : period_(period), limits_(limits) {}

void FlightMonitor::countOdometry(Nanoseconds stamp, Nanoseconds now) noexcept {
  odometry_stamp_ = stamp;
  oldest_odometry_ = std::max(oldest_odometry_, now - stamp);
  ++odometry_;
}

void FlightMonitor::countStep(Nanoseconds now, bool flying, const Telemetry& telemetry,
                              bool saturated, const Load& load) noexcept {
  if (step_time_ >= 0 && now > step_time_) {
    const Nanoseconds interval = now - step_time_;
    ++intervals_;
    interval_sum_ += interval;
    longest_interval_ = std::max(longest_interval_, interval);
  }
  step_time_ = now;
  flying_ = flying;
  load_ = load;
  const bool heavy = flying && load.share() > limits_.lift.error;
  if (!heavy) heavy_since_ = -1;
  if (heavy && heavy_since_ < 0) heavy_since_ = now;
  overloaded_ = heavy && now - heavy_since_ >= kOverload;
  if (overloaded_) {
    was_overloaded_ = true;
    overload_ = load;
  }
  if (!flying) return;
  ++flying_steps_;
  if (saturated) ++saturated_steps_;
  distance_ = telemetry.position_error.norm();
}

std::vector<std::string> FlightMonitor::names() {
  return {"Control loop", "Odometry", "Set point", "Rotors", "Messages", "Payload"};
}

std::vector<Finding> FlightMonitor::judge(Nanoseconds now, double silence) {
  std::vector<Finding> findings = {judgeLoop(),        judgeOdometry(now, silence),
                                   judgeSetPoint(now), judgeRotors(),
                                   judgeMessages(),    judgePayload()};
  const std::vector<std::string> all = names();
  for (std::size_t i = 0; i < findings.size(); ++i) findings[i].name = all[i];
  intervals_ = odometry_ = dropped_odometry_ = dropped_set_points_ = new_starts_ = 0;
  flying_steps_ = saturated_steps_ = 0;
  was_overloaded_ = overloaded_;
  interval_sum_ = longest_interval_ = oldest_odometry_ = 0;
  return findings;
}

Finding FlightMonitor::judgeLoop() const {
  Finding finding;
  if (intervals_ == 0) {
    finding.health = flying_ ? Health::kError : Health::kWarn;
    finding.reason = flying_ ? "stands still in flight" : "waits for odometry with a new time";
    return finding;
  }
  const double nominal = 1.0 / toSeconds(period_);
  const double rate = intervals_ / toSeconds(interval_sum_);
  const double deviation = std::abs(rate / nominal - 1.0);
  const double late = toSeconds(longest_interval_ - period_) / toSeconds(period_);
  const Health by_rate = judged(deviation, limits_.rate_deviation);
  const Health by_jitter = judged(late, limits_.jitter);
  finding.health = std::max(by_rate, by_jitter);
  if (by_rate != Health::kOk && by_rate >= by_jitter) {
    finding.reason = formatted("runs at %.1f Hz instead of %.1f Hz", rate, nominal);
  } else if (by_jitter != Health::kOk) {
    finding.reason =
        formatted("one step came %.1f ms late", toSeconds(longest_interval_ - period_) * 1e3);
  } else {
    finding.reason = formatted("runs at %.1f Hz", rate);
  }
  finding.values = {{"rate [Hz]", formatted("%.2f", rate)},
                    {"nominal rate [Hz]", formatted("%.2f", nominal)},
                    {"longest step [ms]", formatted("%.2f", toSeconds(longest_interval_) * 1e3)}};
  return finding;
}

Finding FlightMonitor::judgeOdometry(Nanoseconds now, double silence) const {
  Finding finding;
  if (odometry_stamp_ < 0) {
    finding.health = Health::kWarn;
    finding.reason = "none has come yet; is the topic right?";
    return finding;
  }
  const double age = toSeconds(std::max(oldest_odometry_, now - odometry_stamp_));
  const Health by_silence = judged(silence, limits_.silence);
  finding.health = std::max(judged(age, limits_.odometry_age), by_silence);
  if (by_silence != Health::kOk) {
    finding.reason = formatted("none for %.1f s: the controller flies blind", silence);
  } else if (finding.health != Health::kOk) {
    finding.reason =
        formatted("up to %.0f ms old: check clocks, network and the estimator", age * 1e3);
  } else {
    finding.reason = formatted("fresh, at most %.1f ms old", age * 1e3);
  }
  finding.values = {{"oldest [ms]", formatted("%.2f", age * 1e3)},
                    {"silence [s]", formatted("%.2f", silence)},
                    {"messages", formatted("%u", odometry_)}};
  return finding;
}

Finding FlightMonitor::judgeSetPoint(Nanoseconds now) const {
  Finding finding;
  if (!flying_) {
    finding.reason = "none is active: the rotors stand still";
    return finding;
  }
  finding.health = judged(distance_, limits_.distance);
  finding.reason = formatted(
      finding.health == Health::kOk ? "%.2f m away" : "%.2f m away: the vehicle does not follow",
      distance_);
  finding.values = {{"age [s]", formatted("%.2f", toSeconds(now - set_point_time_))},
                    {"distance [m]", formatted("%.3f", distance_)}};
  return finding;
}

Finding FlightMonitor::judgeRotors() const {
  Finding finding;
  const double saturated = share(saturated_steps_, flying_steps_);
  finding.health = judged(saturated, limits_.saturation);
  finding.reason =
      finding.health == Health::kOk
          ? (flying_ ? "within their limits" : "stand still")
          : formatted("at a limit %.0f %% of the time: too heavy a payload or too high gains",
                      100.0 * saturated);
  finding.values = {{"saturated [%]", formatted("%.1f", 100.0 * saturated)}};
  return finding;
}

Finding FlightMonitor::judgeMessages() const {
  Finding finding;
  finding.health =
      judged(share(dropped_odometry_, dropped_odometry_ + odometry_), limits_.dropped_odometry);
  if (dropped_set_points_ + new_starts_ > 0) {
    finding.health = std::max(finding.health, Health::kWarn);
  }
  if (finding.health == Health::kOk) {
    finding.reason = "none refused";
  } else if (new_starts_ > 0) {
    finding.reason = "the clock of the odometry went back: began anew, without a set point";
  } else {
    finding.reason = formatted(
        "refused %u of odometry, %u of set points: not finite, not a pose or out of order",
        dropped_odometry_, dropped_set_points_);
  }
  finding.values = {{"odometry refused", formatted("%u", dropped_odometry_)},
                    {"set points refused", formatted("%u", dropped_set_points_)},
                    {"new starts", formatted("%u", new_starts_)}};
  return finding;
}

Finding FlightMonitor::judgePayload() const {
  Finding finding;
  if (!flying_) {
    finding.reason = "nothing is lifted";
    return finding;
  }
  const Load& load = was_overloaded_ ? overload_ : load_;
  const double carried = load.carried;
  const double liftable = load.liftable;
  if (was_overloaded_ || !std::isfinite(load_.share())) {
    finding.health = Health::kError;
    finding.reason =
        formatted("lifts %.2f kg, carries %.2f kg: too heavy, or held down", liftable, carried);
  } else if (load_.share() > limits_.lift.warn) {
    finding.health = Health::kWarn;
    finding.reason =
        formatted("%.2f kg of %.2f kg lift are used: little is left to steer", carried, liftable);
  } else {
    finding.reason =
        formatted("vehicle and payload take %.2f kg of %.2f kg lift", carried, liftable);
  }
  finding.values = {{"mass [kg]", formatted("%.3f", carried)},
                    {"lift limit [kg]", formatted("%.3f", liftable)}};
  return finding;
}

}  // namespace aqc
