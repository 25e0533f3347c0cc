#pragma once

#include <Eigen/Core>

#include "adaptive_quadrotor_control/law/low_pass.h"
#include "adaptive_quadrotor_control/model/vehicle.h"

namespace aqc {

class ParameterReader;

/// The body rate as the moments make it, and the moment d_q that is beside those of the rotors,
/// above all that of a payload whose mass is off the centre: a Luenberger observer with a double
/// pole for each axis.
///
/// Every update starts from what was learned so far; keep() makes it so.
class MomentObserver {
 public:
  /// Reads moment_bandwidth. Throws ParameterError.
  MomentObserver(const ParameterReader& reader, const Vehicle& vehicle);

  /// What a body rate was measured by.
  enum class Source {
    kGyroscope,
    kOdometry,  ///< whose age may be more than it says: tilt is observed with half the bandwidth
  };
  /// By a body rate [rad/s] and the mean moment of the rotors [N m] over the `elapsed` seconds
  /// since the one before it; 0: it is the same one.
  void see(const Eigen::Vector3d& body_rate, const Eigen::Vector3d& moment,
           const Eigen::Vector3d& inertia, double elapsed, Source source) noexcept;
  /// The rate is observed anew from this one; d_q stays.
  void restart(const Eigen::Vector3d& body_rate) noexcept;
  void keep() noexcept { learned_ = values_; }
  /// Something fell off, and each axis has kept that share (0 to 1) of its inertia: what has gone
  /// took its moment along, so that of d_q / J no more is left than there was.
  void shrink(const Eigen::Vector3d& share) noexcept {
    values_.moment = values_.moment.cwiseProduct(share);
    learned_.moment = learned_.moment.cwiseProduct(share);
  }

  /// At the time of the last body rate [rad/s].
  const Eigen::Vector3d& rate() const noexcept { return values_.rate; }
  /// d_q in B [N m].
  const Eigen::Vector3d& moment() const noexcept { return values_.moment; }

  void reset() noexcept;
  void adopt(const MomentObserver& old) noexcept { learned_ = values_ = old.learned_; }
  bool finite() const noexcept;

 private:
  struct Values {
    Eigen::Vector3d rate = Eigen::Vector3d::Zero();
    Eigen::Vector3d moment = Eigen::Vector3d::Zero();
  };

  Eigen::Vector3d most_;  // |d_q| [N m]
  LowPass tilt_lag_;
  LowPass careful_tilt_lag_;
  LowPass yaw_lag_;
  Values learned_;
  Values values_;
};

}  // namespace aqc
