#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "adaptive_quadrotor_control/math/number_text.h"
#include "campaign/campaign.h"

namespace aqc {
namespace {

const FaultKindText& textOf(FaultKind kind) {
  return faultKinds()[static_cast<std::size_t>(kind)];
}

template <class Items, class Text>
std::string joined(const Items& items, Text text) {
  std::string all;
  for (const auto& item : items) all += (all.empty() ? "" : " + ") + std::string(text(item));
  return all;
}

std::string faultsOf(const FaultResult& result) {
  return joined(result.faults, [](FaultKind kind) { return textOf(kind).name; });
}

struct Counts {
  int flights = 0;
  std::array<int, 5> verdicts = {};
  double impact = 0.0;
  double astray = 0.0;

  void add(const FaultResult& result) {
    ++flights;
    ++verdicts[static_cast<std::size_t>(result.verdict)];
    if (result.verdict == Verdict::kForced) return;
    impact = std::max(impact, result.impact);
    astray = std::max(astray, result.astray);
  }
};

std::string row(const char* name, const char* range, const Counts& counts) {
  const auto of = [&](Verdict verdict) {
    return counts.verdicts[static_cast<std::size_t>(verdict)];
  };
  return formatted("| %-16s | %-63s | %6d | %6d | %5d | %5d | %5d | %6d | %7.2f | %6.1f |\n", name,
                   range, counts.flights, of(Verdict::kLanded), of(Verdict::kHeld),
                   of(Verdict::kHard), of(Verdict::kLost), of(Verdict::kForced), counts.impact,
                   counts.astray);
}

}  // namespace

std::string campaignCsv(const std::vector<FaultResult>& results) {
  std::string text =
      "seed,faults,verdict,reason,impact [m/s],astray [m],duration [s],guard's rules\n";
  for (const FaultResult& result : results) {
    text += std::to_string(result.seed) + "," + faultsOf(result) + "," + toString(result.verdict) +
            "," + result.reason +
            formatted(",%.6g,%.6g,%.6g,", result.impact, result.astray, result.duration) +
            joined(result.rules, [](Rule rule) { return textOf(rule).name; }) + "\n";
  }
  return text;
}

std::string campaignTable(const std::vector<FaultResult>& results) {
  Counts all;
  std::vector<Counts> by_kind(faultKinds().size());
  std::map<std::string, int> reasons;
  for (const FaultResult& result : results) {
    all.add(result);
    for (const FaultKind kind : result.faults) by_kind[static_cast<std::size_t>(kind)].add(result);
    if (result.verdict == Verdict::kLost) ++reasons[result.reason];
  }
  std::string text = formatted(
      "| %-16s | %-63s | %6s | %6s | %5s | %5s | %5s | %6s | %7s | %6s |\n", "fault",
      "drawn evenly", "flown", "landed", "held", "hard", "lost", "forced", "impact", "astray");
  text += "| --- | --- | --- | --- | --- | --- | --- | --- | --- | --- |\n";
  for (const FaultKindText& kind : faultKinds()) {
    text += row(kind.name, kind.range, by_kind[static_cast<std::size_t>(kind.kind)]);
  }
  text += row("all flights", "one to three of these", all);
  for (const auto& [reason, count] : reasons) {
    text += formatted("lost: %d %s\n", count, reason.c_str());
  }
  return text;
}

std::string flightText(const FaultFlight& flight) {
  std::string text;
  for (const DrawnFault& fault : flight.faults) {
    text += formatted("%-16s %s\n", textOf(fault.kind).name, fault.text.c_str());
  }
  const char* const names[] = {"plan", "go to", "release", "land"};
  for (const Order& order : flight.orders) {
    text += formatted("%8.3f s  %s", toSeconds(order.time),
                      names[static_cast<std::size_t>(order.kind)]);
    if (!order.set_points.empty()) {
      const SetPoint& point = order.set_points.front().set_point;
      text += formatted(" (%.3g, %.3g, %.3g), yaw %.3g", point.position.x(), point.position.y(),
                        point.position.z(), point.yaw);
    }
    text += "\n";
  }
  return text;
}

}  // namespace aqc
