#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "adaptive_quadrotor_control/flight/flight_log.h"
#include "adaptive_quadrotor_control/flight/truth.h"

namespace aqc {

/// What a controller tells of one control step.
struct StepReport {
  /// Switches that it refused or did against the dwell time.
  struct Objections {
    std::uint32_t count = 0;  ///< so far
    int subsystem = 0;        ///< that the last one was about
    std::string outcome;      ///< of the last one: toString(SwitchOutcome)
    Nanoseconds allowed = 0;  ///< when the next switch is or becomes legal
  };

  FlightSample sample;  ///< without truth
  std::string controller;
  std::vector<AdaptiveQuantity> adaptive_quantities;  ///< what Telemetry::adaptive holds
  Nanoseconds plan_stamp = 0;                         ///< of the last accepted set points
  Objections objections;
};

/// Makes the log of one flight from what controller and plant tell of it on one clock, each in the
/// order of time; one may be late against the other.
class Collector {
 public:
  /// Of a flight that begins by itself, see begin(), and lasts as long as there are steps.
  Collector() = default;
  /// Of the steps in [begin, begin + duration).
  Collector(Nanoseconds begin, Nanoseconds duration) : begin_(begin), end_(begin + duration) {}

  /// A step not later than one before it is told again: only its objections are looked at. Those
  /// counted in the first report were before the flight.
  void add(StepReport report);
  /// Of two truths of one time the later one counts.
  void add(Truth truth);

  /// Time of the last step and of the latest truth; nothing before there is one.
  std::optional<Nanoseconds> lastStep() const noexcept;
  std::optional<Nanoseconds> lastTruth() const noexcept;

  /// When the flight begins; nothing while none has begun. It is told by the constructor or
  /// found: the first step that flies. Set points that were accepted before that step, and whose
  /// stamp is not before the first step of all, are a mission, which begins at its stamp.
  std::optional<Nanoseconds> begin() const noexcept { return begin_; }

  /// The flight, its times counted from begin(); the collector is as new then, and open. Each
  /// sample has the latest truth that is not after it, if any. Controller and adaptive quantities
  /// are those of the first sample; a sample of a law that adapts others has no adaptive values.
  /// The crash is that of the first truth, from the begin on, which tells of one not after the end:
  /// of the flight or, where that is open, of its last sample. Of the objections in one report the
  /// last one is told. Throws std::logic_error when no flight has begun.
  FlightLog take();

 private:
  struct Law {
    std::string controller;
    std::vector<AdaptiveQuantity> adaptive_quantities;
  };

  void countObjections(const StepReport& report);
  void findBegin(const StepReport& report);
  void takeSamples(FlightLog& log);
  void addRefusals(FlightLog& log) const;
  void addCrash(FlightLog& log) const;
  bool holds(Nanoseconds time) const noexcept;

  std::optional<Nanoseconds> begin_;
  std::optional<Nanoseconds> end_;  // first time after the flight; open without one
  std::vector<FlightSample> samples_;
  std::map<Nanoseconds, Law> laws_;  // by the time of their first sample
  std::vector<std::pair<Nanoseconds, StepReport::Objections>> objections_;  // by step
  std::optional<std::uint32_t> known_objections_;  // none before the first report
  std::map<Nanoseconds, Truth> truth_;
};

}  // namespace aqc
