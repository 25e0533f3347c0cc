#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "adaptive_quadrotor_control/law/control_law.h"
#include "campaign/payload_flight.h"

namespace aqc {

/// How a payload flight went.
struct PayloadResult {
  int number = 0;          ///< within the campaign
  std::uint64_t seed = 0;  ///< of the flight
  bool crashed = false;
  /// RMS of the norm of the true position error over what counts, to the end or to the crash [m].
  double rms = 0.0;
  std::string text;  ///< what was drawn
};

/// Not crashed, but off by more than this (RMS) [m].
constexpr double kLostError = 1.0;
inline bool lost(const PayloadResult& result) {
  return !result.crashed && !(result.rms <= kLostError);
}

/// Flies it to its end or its crash, without a guard; `law` knows `vehicle`, and so does the pilot.
PayloadResult flyPayload(const PayloadFlight& flight, const Vehicle& vehicle,
                         std::unique_ptr<ControlLaw> law);

/// Many payload flights of one law. A flight is drawn from mixedSeed(campaign, number).
struct PayloadCampaign {
  std::uint64_t campaign = 1;
  int first = 1;  ///< number of the first flight
  int last = 0;   ///< and of the last one
  PayloadConditions conditions;
  int threads = 1;  ///< >= 1
};

/// Flies them; the results are by number and the same for any number of threads. `progress` as of
/// inParallel().
std::vector<PayloadResult> flyCampaign(const PayloadCampaign& campaign, const Vehicle& vehicle,
                                       const ControlLaw& law,
                                       const std::function<void(double)>& progress);

/// What many flights come to. Errors are of those that did not crash [m]; 0 when all did.
struct PayloadSummary {
  int flights = 0;
  int crashed = 0;
  int lost = 0;
  double median = 0.0;
  double most = 0.0;  ///< that 95 % are not beyond
  double worst = 0.0;
};
PayloadSummary summary(const std::vector<PayloadResult>& results);

/// A line each, that begins with the name of the law.
std::string payloadCsvHeading();
std::string payloadCsv(const std::string& law, const std::vector<PayloadResult>& results);
/// A table of summaries, a row each [cm].
std::string summaryHeading();
std::string summaryRow(const std::string& law, const PayloadSummary& summary);

}  // namespace aqc
