#include "adaptive_quadrotor_control/pilot/load_watch.h"

#include <algorithm>

#include "adaptive_quadrotor_control/math/constants.h"

namespace aqc {
namespace {

constexpr double kMomentSmoothing = 0.1;  // [s]

}  // namespace

void LoadWatch::update(double carried, const Eigen::Vector3d& moment, double dt) noexcept {
  moment_ += std::min(dt / kMomentSmoothing, 1.0) * (moment - moment_);
  load_ = {carried, rotors_.mostThrust(moment_) / kGravity};
}

}  // namespace aqc
