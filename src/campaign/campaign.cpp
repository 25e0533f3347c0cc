#include "campaign/campaign.h"

#include <atomic>
#include <mutex>
#include <thread>

namespace aqc {

std::vector<FaultResult> flyCampaign(const Campaign& campaign, const Vehicle& vehicle,
                                     const ControlLaw& law, const PilotLimits& limits,
                                     const std::function<void(double)>& progress) {
  std::vector<FaultResult> results(static_cast<std::size_t>(campaign.flights));
  std::atomic<int> next{0};
  std::mutex counting;
  int flown = 0;
  const auto work = [&] {
    for (int i = next++; i < campaign.flights; i = next++) {
      const std::uint64_t seed = campaign.seed + static_cast<std::uint64_t>(i);
      results[static_cast<std::size_t>(i)] =
          flyFaults(drawFaultFlight(seed, vehicle), vehicle, law.clone(), limits);
      const std::lock_guard<std::mutex> lock(counting);
      ++flown;
      if (progress) progress(static_cast<double>(flown) / campaign.flights);
    }
  };
  std::vector<std::thread> threads;
  for (int i = 0; i < campaign.threads; ++i) threads.emplace_back(work);
  for (std::thread& thread : threads) thread.join();
  return results;
}

}  // namespace aqc
