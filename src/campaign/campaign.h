#pragma once

#include <functional>
#include <string>
#include <vector>

#include "campaign/fault_result.h"

namespace aqc {

/// Many fault flights of one law.
struct Campaign {
  std::uint64_t seed = 1;  ///< of the first flight; the others follow
  int flights = 0;
  int threads = 1;  ///< >= 1
};

/// Flies them; the results are by seed and the same for any number of threads. `progress` (may be
/// empty) is told the share flown, 0 to 1, by one thread at a time.
std::vector<FaultResult> flyCampaign(const Campaign& campaign, const Vehicle& vehicle,
                                     const ControlLaw& law, const PilotLimits& limits,
                                     const std::function<void(double)>& progress);

/// A line each, with a header.
std::string campaignCsv(const std::vector<FaultResult>& results);

/// Verdicts by kind of fault, and reasons of what was lost, to print.
std::string campaignTable(const std::vector<FaultResult>& results);

/// What is wrong with a flight, and what it is asked, to print.
std::string flightText(const FaultFlight& flight);

}  // namespace aqc
