#include "campaign/fault_draw.h"

#include <algorithm>
#include <iterator>

#include "adaptive_quadrotor_control/math/number_text.h"
#include "campaign/draw.h"

namespace aqc {
namespace {

const std::vector<FaultDraw>& faultDraws() {
  static const std::vector<FaultDraw> kDraws = [] {
    std::vector<FaultDraw> draws = sensorFaults();
    for (const auto& more : {plantFaults(), planFaults()}) {
      draws.insert(draws.end(), more.begin(), more.end());
    }
    return draws;
  }();
  return kDraws;
}

// Without odometry nothing but the IMU tells which way is up: never both.
bool blindfolds(const std::vector<DrawnFault>& faults) {
  constexpr FaultKind kSilences[] = {
      FaultKind::kJump,      FaultKind::kFreeze, FaultKind::kNotANumber, FaultKind::kStamps,
      FaultKind::kClockStep, FaultKind::kGap,    FaultKind::kNoOdometry};
  const auto has = [&](FaultKind kind) {
    return std::any_of(faults.begin(), faults.end(),
                       [kind](const DrawnFault& fault) { return fault.kind == kind; });
  };
  return has(FaultKind::kNoImu) && std::any_of(std::begin(kSilences), std::end(kSilences), has);
}

}  // namespace

std::string text(const TimeWindow& window) {
  return formatted("from %.3f to %.3f s", toSeconds(window.from), toSeconds(window.until));
}

std::string text(const Eigen::Vector3d& vector) {
  return formatted("(%.3g, %.3g, %.3g)", vector.x(), vector.y(), vector.z());
}

const std::vector<FaultKindText>& faultKinds() {
  static const std::vector<FaultKindText> kKinds = [] {
    std::vector<FaultKindText> kinds;
    for (const FaultDraw& fault : faultDraws()) kinds.push_back(fault.text);
    return kinds;
  }();
  return kKinds;
}

void drawFaults(Dice& dice, const Vehicle& vehicle, double end, FaultFlight& flight) {
  const Draw drawing{dice, vehicle, end, flight};
  const int kinds = static_cast<int>(faultKinds().size());
  const int faults = dice.count(1, 3);
  while (static_cast<int>(flight.faults.size()) < faults) {
    const auto kind = static_cast<FaultKind>(dice.count(0, kinds - 1));
    const auto same = [kind](const DrawnFault& fault) { return fault.kind == kind; };
    if (std::any_of(flight.faults.begin(), flight.faults.end(), same)) continue;
    flight.faults.push_back({kind, ""});
    if (blindfolds(flight.faults)) flight.faults.pop_back();
  }
  for (DrawnFault& fault : flight.faults) {
    fault.text = faultDraws()[static_cast<std::size_t>(fault.kind)].draw(drawing);
  }
}

}  // namespace aqc
