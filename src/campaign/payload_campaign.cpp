#include "campaign/payload_campaign.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "adaptive_quadrotor_control/math/number_text.h"
#include "adaptive_quadrotor_control/simulation/closed_loop.h"
#include "adaptive_quadrotor_control/simulation/random.h"
#include "campaign/in_parallel.h"

namespace aqc {

PayloadResult flyPayload(const PayloadFlight& flight, const Vehicle& vehicle,
                         std::unique_ptr<ControlLaw> law) {
  ClosedLoop loop(flight.scenario, flight.airframe, vehicle, std::move(law), {});
  double square = 0.0;
  int count = 0;
  while (!loop.done() && !loop.plant().crashTime()) {
    const Nanoseconds now = loop.plant().now();
    const Eigen::Vector3d position = loop.plant().plant().state().position;
    loop.advance();
    if (std::any_of(flight.uncounted.begin(), flight.uncounted.end(),
                    [now](const TimeWindow& window) { return window.contains(now); })) {
      continue;
    }
    square += (position - loop.pilot().goal().position).squaredNorm();
    ++count;
  }
  PayloadResult result;
  result.seed = flight.seed;
  result.crashed = loop.plant().crashTime().has_value();
  result.rms = std::sqrt(square / std::max(count, 1));
  result.text = flight.text;
  return result;
}

std::vector<PayloadResult> flyCampaign(const PayloadCampaign& campaign, const Vehicle& vehicle,
                                       const ControlLaw& law,
                                       const std::function<void(double)>& progress) {
  const int flights = std::max(campaign.last - campaign.first + 1, 0);
  std::vector<PayloadResult> results(static_cast<std::size_t>(flights));
  const auto fly = [&](int i) {
    const int number = campaign.first + i;
    const std::uint64_t seed = mixedSeed(campaign.campaign, static_cast<std::uint64_t>(number));
    PayloadResult& result = results[static_cast<std::size_t>(i)];
    result =
        flyPayload(drawPayloadFlight(seed, vehicle, campaign.conditions), vehicle, law.clone());
    result.number = number;
  };
  inParallel(flights, campaign.threads, fly, progress);
  return results;
}

PayloadSummary summary(const std::vector<PayloadResult>& results) {
  PayloadSummary summary;
  summary.flights = static_cast<int>(results.size());
  std::vector<double> errors;
  for (const PayloadResult& result : results) {
    summary.crashed += result.crashed ? 1 : 0;
    summary.lost += lost(result) ? 1 : 0;
    if (!result.crashed) errors.push_back(result.rms);
  }
  if (errors.empty()) return summary;
  std::sort(errors.begin(), errors.end());
  const auto ofShare = [&](double share) {
    const double rank = std::ceil(share * static_cast<double>(errors.size()));
    return errors[static_cast<std::size_t>(std::max(rank, 1.0)) - 1];
  };
  summary.median = ofShare(0.5);
  summary.most = ofShare(0.95);
  summary.worst = errors.back();
  return summary;
}

std::string payloadCsvHeading() {
  return "law,flight,seed,verdict,error [m],drawn\n";
}

std::string payloadCsv(const std::string& law, const std::vector<PayloadResult>& results) {
  std::string text;
  for (const PayloadResult& result : results) {
    const char* verdict = result.crashed ? "crashed" : lost(result) ? "lost" : "flown";
    text += law + "," + std::to_string(result.number) + "," + std::to_string(result.seed) + "," +
            verdict + formatted(",%.6g,", result.rms) + result.text + "\n";
  }
  return text;
}

std::string summaryHeading() {
  return formatted("| %-16s | %7s | %7s | %6s | %8s | %8s | %8s |\n", "law", "flights", "crashed",
                   "lost", "median", "95 %", "worst") +
         "| --- | --- | --- | --- | --- | --- | --- |\n";
}

std::string summaryRow(const std::string& law, const PayloadSummary& summary) {
  return formatted("| %-16s | %7d | %7d | %6d | %8.2f | %8.2f | %8.2f |\n", law.c_str(),
                   summary.flights, summary.crashed, summary.lost, 100.0 * summary.median,
                   100.0 * summary.most, 100.0 * summary.worst);
}

}  // namespace aqc
