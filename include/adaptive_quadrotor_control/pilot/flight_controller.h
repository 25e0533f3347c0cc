#pragma once

#include <memory>

#include "adaptive_quadrotor_control/law/control_law.h"
#include "adaptive_quadrotor_control/model/rotor_allocation.h"
#include "adaptive_quadrotor_control/model/rotor_lag.h"

namespace aqc {

/// From what is sensed and wanted to rotor speeds: a control law, the allocation behind it, and the
/// rotors' lag. This is the whole control step; whoever flies, flies this class.
class FlightController {
 public:
  /// `law` must not be null.
  FlightController(const Vehicle& vehicle, std::unique_ptr<ControlLaw> law);

  /// One step of `dt` seconds (> 0). Without a set point (null) the rotors stand still and the
  /// adaptive quantities are put back to their initial values. With `learn` false the law adapts
  /// nothing in this step. Allocates nothing, never throws.
  const Allocation& step(const Sensed& sensed, const SetPoint* set_point, double dt,
                         bool learn = true) noexcept;
  /// One step without the law, which forgets: all rotors turn at `speed` [rad/s], >= 0.
  void idle(double speed, double dt) noexcept;

  /// Bounds what this law and every later one may believe.
  void bound(const EstimateBounds& bounds) noexcept;
  /// The law goes back to its initial values in flight.
  void forget() noexcept { law_->reset(); }

  /// Swaps the law between two steps. The new one adopts what the old one knew and, unless flying,
  /// is reset then. The old law comes back, so that it need not die here.
  std::unique_ptr<ControlLaw> replaceLaw(std::unique_ptr<ControlLaw> law) noexcept;

  /// The switching signal of a law with several subsystems; null for others.
  SubsystemSwitch* subsystems() noexcept { return law_->subsystems(); }

  /// Whether the last step had a set point.
  bool flying() const noexcept { return flying_; }
  /// Of the last step().
  const Allocation& allocation() const noexcept { return allocation_; }
  const ControlLaw& law() const noexcept { return *law_; }
  /// What the rotors are predicted to give after the last step().
  Wrench given() const noexcept { return rotors_.wrench(lag_.speeds()); }

 private:
  void turnRotors(double dt) noexcept;

  RotorAllocation rotors_;
  RotorLag lag_;
  double most_speed_;  // of a rotor [rad/s]
  std::unique_ptr<ControlLaw> law_;
  Allocation allocation_;
  EstimateBounds bounds_;
  bool flying_ = false;  // the last step had a set point
};

}  // namespace aqc
