#include "campaign/campaign.h"

#include "campaign/in_parallel.h"

namespace aqc {

std::vector<FaultResult> flyCampaign(const Campaign& campaign, const Vehicle& vehicle,
                                     const ControlLaw& law, const PilotLimits& limits,
                                     const std::function<void(double)>& progress) {
  std::vector<FaultResult> results(static_cast<std::size_t>(campaign.flights));
  const auto fly = [&](int i) {
    const std::uint64_t seed = campaign.seed + static_cast<std::uint64_t>(i);
    results[static_cast<std::size_t>(i)] =
        flyFaults(drawFaultFlight(seed, vehicle), vehicle, law.clone(), limits);
  };
  inParallel(campaign.flights, campaign.threads, fly, progress);
  return results;
}

}  // namespace aqc
