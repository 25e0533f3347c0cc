#include "adaptive_quadrotor_control/law/composite/moment_observer.h"

#include <Eigen/Geometry>
#include <algorithm>

#include "adaptive_quadrotor_control/law/bearable.h"
#include "adaptive_quadrotor_control/parameters/parameter_reader.h"
#include "law/gain_ranges.h"

namespace aqc {
namespace {

constexpr double kCareful = 0.5;  // of the bandwidth

LowPass lag(const ParameterReader& reader, std::size_t which, double share = 1.0) {
  const std::vector<double> bandwidth = reader.numbers(
      {"moment_bandwidth", "omega_o", "rad/s", "of the moment's observer", {"tilt", "yaw"}}, 2,
      kDecay);
  return LowPass(1.0 / (share * bandwidth[which]));
}

}  // namespace

MomentObserver::MomentObserver(const ParameterReader& reader, const Vehicle& vehicle)
    : most_(bearable(vehicle).moment),
      tilt_lag_(lag(reader, 0)),
      careful_tilt_lag_(lag(reader, 0, kCareful)),
      yaw_lag_(lag(reader, 1)) {}

void MomentObserver::see(const Eigen::Vector3d& body_rate, const Eigen::Vector3d& moment,
                         const Eigen::Vector3d& inertia, double elapsed, Source source) noexcept {
  values_ = learned_;
  if (elapsed <= 0.0) return;
  Eigen::Vector3d& rate = values_.rate;
  const Eigen::Vector3d spin = inertia.cwiseProduct(rate);
  rate += elapsed * (moment - rate.cross(spin) + values_.moment).cwiseQuotient(inertia);
  const Eigen::Vector3d gap = body_rate - rate;
  LowPass& tilt_lag = source == Source::kGyroscope ? tilt_lag_ : careful_tilt_lag_;
  const double tilt = tilt_lag.share(elapsed);
  const double yaw = yaw_lag_.share(elapsed);
  const Eigen::Vector3d share(tilt, tilt, yaw);  // 1 - p, of the double pole p
  const Eigen::Vector3d left = (1.0 - share.array()).square();
  rate = body_rate - left.cwiseProduct(gap);
  values_.moment += inertia.cwiseProduct(share.cwiseAbs2()).cwiseProduct(gap) / elapsed;
  values_.moment = values_.moment.cwiseMax(-most_).cwiseMin(most_);
}

void MomentObserver::restart(const Eigen::Vector3d& body_rate) noexcept {
  values_ = learned_;
  values_.rate = body_rate;
}

void MomentObserver::reset() noexcept {
  learned_ = values_ = Values();
}

bool MomentObserver::finite() const noexcept {
  return learned_.rate.allFinite() && learned_.moment.allFinite();
}

}  // namespace aqc
