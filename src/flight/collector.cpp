#include "adaptive_quadrotor_control/flight/collector.h"

#include <algorithm>
#include <iterator>
#include <stdexcept>
#include <utility>

#include "adaptive_quadrotor_control/law/switched/switch_schedule.h"

namespace aqc {
namespace {

// The entry of the latest time not after `time`; null without one.
template <class Value>
const Value* latest(const std::map<Nanoseconds, Value>& history, Nanoseconds time) {
  const auto later = history.upper_bound(time);
  return later == history.begin() ? nullptr : &std::prev(later)->second;
}

}  // namespace

void Collector::add(StepReport report) {
  countObjections(report);
  const Nanoseconds time = report.sample.time;
  if (!samples_.empty() && time <= samples_.back().time) return;
  if (!begin_ && report.sample.flying) findBegin(report);
  if (laws_.empty() || laws_.rbegin()->second.controller != report.controller ||
      laws_.rbegin()->second.adaptive_quantities != report.adaptive_quantities) {
    laws_[time] = {std::move(report.controller), std::move(report.adaptive_quantities)};
  }
  samples_.push_back(std::move(report.sample));
}

void Collector::add(Truth truth) {
  const Nanoseconds time = truth.time;
  truth_[time] = std::move(truth);
}

void Collector::countObjections(const StepReport& report) {
  const std::uint32_t count = report.objections.count;
  // A law that takes over in flight counts anew.
  if (known_objections_ && count > *known_objections_) {
    objections_.emplace_back(report.sample.time, report.objections);
  }
  known_objections_ = count;
}

void Collector::findBegin(const StepReport& report) {
  const Nanoseconds time = report.sample.time;
  const Nanoseconds sent = report.plan_stamp;
  const bool mission = !samples_.empty() && sent >= samples_.front().time && sent <= time;
  begin_ = mission ? sent : time;
}

std::optional<Nanoseconds> Collector::lastStep() const noexcept {
  if (samples_.empty()) return std::nullopt;
  return samples_.back().time;
}

std::optional<Nanoseconds> Collector::lastTruth() const noexcept {
  if (truth_.empty()) return std::nullopt;
  return truth_.rbegin()->first;
}

bool Collector::holds(Nanoseconds time) const noexcept {
  return time >= *begin_ && (!end_ || time < *end_);
}

FlightLog Collector::take() {
  if (!begin_) throw std::logic_error("a log was asked of a flight that has not begun");
  FlightLog log;
  addRefusals(log);
  addCrash(log);
  takeSamples(log);
  *this = Collector();
  return log;
}

void Collector::addRefusals(FlightLog& log) const {
  for (const auto& [time, last] : objections_) {
    if (!holds(time)) continue;
    log.refusals.push_back({time - *begin_, switchObjection(last.subsystem, last.outcome,
                                                            last.allowed, time, *begin_)});
  }
}

void Collector::addCrash(FlightLog& log) const {
  // A begin that was found is that of a sample.
  const Nanoseconds end = end_ ? *end_ : samples_.back().time;
  for (auto entry = truth_.lower_bound(*begin_); entry != truth_.end(); ++entry) {
    const Truth& truth = entry->second;
    if (!truth.crash_time || *truth.crash_time > end) continue;
    log.crash_time = *truth.crash_time - *begin_;
    log.crash_reason = truth.crash_reason;
    return;
  }
}

void Collector::takeSamples(FlightLog& log) {
  const auto outside = [this](const FlightSample& sample) { return !holds(sample.time); };
  samples_.erase(std::remove_if(samples_.begin(), samples_.end(), outside), samples_.end());
  if (samples_.empty()) return;
  // Figures have one set of names and units: that of the law at the start.
  const Law& first = *latest(laws_, samples_.front().time);
  for (FlightSample& sample : samples_) {
    if (const Truth* truth = latest(truth_, sample.time)) addTruth(*truth, sample);
    const Law& law = *latest(laws_, sample.time);
    if (law.adaptive_quantities != first.adaptive_quantities) sample.telemetry.adaptive.resize(0);
    sample.time -= *begin_;
  }
  log.controller = first.controller;
  log.adaptive_quantities = first.adaptive_quantities;
  log.samples = std::move(samples_);
}

}  // namespace aqc
