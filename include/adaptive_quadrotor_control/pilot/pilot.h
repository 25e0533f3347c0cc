#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "adaptive_quadrotor_control/flight/flight_sample.h"
#include "adaptive_quadrotor_control/law/switched/switch_schedule.h"
#include "adaptive_quadrotor_control/pilot/dead_reckoning.h"
#include "adaptive_quadrotor_control/pilot/flight_controller.h"
#include "adaptive_quadrotor_control/pilot/guard.h"
#include "adaptive_quadrotor_control/pilot/imu_monitor.h"
#include "adaptive_quadrotor_control/pilot/odometry_gate.h"
#include "adaptive_quadrotor_control/pilot/pilot_limits.h"
#include "adaptive_quadrotor_control/pilot/rotor_observer.h"
#include "adaptive_quadrotor_control/reference/set_point_schedule.h"

namespace aqc {

/// What is to be published after something was heard.
enum class Publish {
  kNothing,
  kLastCommand,  ///< the rotor speeds of the last step once more
  kNewCommand,   ///< those of a step that was made just now
};

/// What became of a message.
struct Answer {
  Publish publish = Publish::kNothing;
  const char* refusal = nullptr;  ///< why it was dropped, in a few words; null: it was taken
  /// The clock of the odometry was started anew, and so was the pilot: see Pilot::hear().
  bool began_anew = false;
};

/// The one path from messages to rotor speeds. Whoever flies feeds it and publishes what it says:
/// the nodelet, the flight without ROS.
///
/// It has no clock: stamps are those of the messages, `now` is what the caller's clock shows; both
/// in the same time. hear() and tick() neither allocate, block, log nor throw.
class Pilot {
 public:
  /// `law` must not be null; `period` [ns] is that of the steps, > 0, else throws
  /// std::invalid_argument.
  Pilot(const Vehicle& vehicle, std::unique_ptr<ControlLaw> law, Nanoseconds period,
        StepClock::Trigger trigger, const PilotLimits& limits = {});

  /// Odometry. With a guard (PilotLimits::guard) it is judged by OdometryGate, and a clock that
  /// goes back in the air ends plans of the old time, not the flight. Without one it is refused
  /// when it is not finite, not a pose, or of a time before the last one; where its clock was
  /// started anew (see StepClock::hear()) the law forgets what it learned, set points and switches
  /// of the old time are gone, and the rotors stand still until a new set point comes.
  Answer hear(const State& state, Nanoseconds stamp, Nanoseconds now) noexcept;
  /// An accelerometer's sample at the origin of B, in B [m/s^2]: see ImuMonitor::take().
  Answer hear(const Eigen::Vector3d& specific_force, Nanoseconds stamp) noexcept;
  /// The same, with the gyroscope's sample [rad/s] in B: a guard can then do without odometry, and
  /// a law that ControlLaw::usesGyroscope() gets it when it is younger than odometry's body rate.
  Answer hear(const Eigen::Vector3d& specific_force, const Eigen::Vector3d& body_rate,
              Nanoseconds stamp) noexcept;
  /// A period has passed; for Trigger::kTimer.
  Publish tick(Nanoseconds now) noexcept;
  /// To be called about once a period with Trigger::kOdometry: makes the step that odometry does
  /// not, when a guard watches and two periods have passed without one.
  Publish watch(Nanoseconds now) noexcept;

  /// Set points that replace all that was planned after `now`: see SetPointSchedule::replace().
  /// `stamp` is that of their message, for the record. Throws std::invalid_argument, and changes
  /// nothing, when replace() does, for set points that are not valid() and, with a guard, for those
  /// that requireSafe() refuses.
  void plan(std::vector<TimedSetPoint> set_points, Nanoseconds now, Nanoseconds stamp);
  /// When a trajectory stamped `stamp` begins: then or, if that is too long ago, now.
  Nanoseconds beginning(Nanoseconds stamp, Nanoseconds now) const noexcept;
  /// Forgets all that is planned; a guard brakes and holds, without one the rotors stand still.
  void release() noexcept;
  /// Set points were not understood and never came here.
  void countRefusedSetPoints() noexcept;
  /// Odometry was not of this vehicle and never came here.
  void countRefusedOdometry() noexcept;
  /// A subsystem to switch to. False, and it is dropped, when too many wait already.
  bool order(const SwitchOrder& order);
  /// Puts `law` in and the old one in its place, between two steps (bumpless transfer). Empty, or
  /// why another law cannot take over now; nothing has changed then.
  std::string handOver(std::unique_ptr<ControlLaw>& law);

  /// Null without one.
  Guard* guard() noexcept { return guarded_ ? &guarded_->guard : nullptr; }
  const Guard* guard() const noexcept { return guarded_ ? &guarded_->guard : nullptr; }
  /// Where the vehicle is to go: the set point of the last step or, with a guard, where the
  /// governed set point is on its way to.
  const SetPoint& goal() const noexcept { return guarded_ ? guarded_->guard.goal() : set_point_; }
  /// Since odometry was accepted, counted by steps [s]; only with a guard.
  double silence() const noexcept { return guarded_ ? guarded_->silence : 0.0; }

  bool flying() const noexcept { return controller_.flying(); }
  /// The load has been too much for so long that it is told: see FlightMonitor.
  bool overloaded() const noexcept { return monitor_.overloaded(); }
  /// Of the last step.
  const Allocation& allocation() const noexcept { return controller_.allocation(); }
  const ControlLaw& law() const noexcept { return controller_.law(); }
  /// The record of the last step, without what only a plant knows.
  FlightSample sample() const;
  /// Switches of the last step that were refused, or done against the dwell time.
  const std::vector<SwitchReport>& objections() const noexcept { return objections_; }
  const std::optional<SwitchReport>& lastObjection() const noexcept { return last_objection_; }
  std::size_t switchesPending() const noexcept { return switches_.pending(); }
  std::size_t setPointsPending() const noexcept { return schedule_.pending(); }
  Nanoseconds setPointStamp() const noexcept { return set_point_stamp_; }
  std::uint32_t droppedOdometry() const noexcept { return dropped_odometry_; }
  std::uint32_t droppedSetPoints() const noexcept { return dropped_set_points_; }
  const ImuMonitor& imu() const noexcept { return imu_; }
  const StepClock& stepClock() const noexcept { return clock_; }

  /// Health since the last judgement: see FlightMonitor::judge(),
  /// and what the guard does, when there is one.
  std::vector<Finding> judge(Nanoseconds now, double silence);
  /// Of what judge() tells, in its order.
  std::vector<std::string> findingNames() const;

 private:
  const char* take(const Eigen::Vector3d& specific_force,
                   const std::optional<Eigen::Vector3d>& body_rate, Nanoseconds stamp) noexcept;
  Answer stepIfAwaited() noexcept;
  void beginAnew() noexcept;
  void step(Nanoseconds now) noexcept;
  void stepUnguarded(Nanoseconds now) noexcept;
  void stepGuarded(Nanoseconds now) noexcept;
  void countStep(Nanoseconds now, double dt) noexcept;
  Situation situation(const SetPoint* planned, double dt) const noexcept;
  void weigh(double dt) noexcept;
  Doubt judge(const State& state) noexcept;
  Doubt doubt(const State& state, const Innovation& innovation) noexcept;
  void takeOver(const State& state, const Innovation& innovation) noexcept;
  void switchSubsystem(Nanoseconds now) noexcept;
  Sensed sense(Nanoseconds now) noexcept;
  bool awaitsImu(Nanoseconds stamp) const noexcept;
  const char* unstableAxis(const ControlLaw& law) const;
  void observeRotors(double dt) noexcept;

  // What a guard needs beside it.
  struct Guarded {
    Guard guard;
    OdometryGate gate;
    DeadReckoning reckoning;
    RotorObserver rotors;
    double per_weight;         // 1 / the empty vehicle's weight [1/N]
    Wrench given = {};         // by the rotors at the end of the last step, as predicted
    double silence = 0.0;      // without odometry [s]
    double imu_silence = 0.0;  // [s]
    double plan_age = 0.0;     // [s]
    double mass = 0.0;         // that the thrust has held up lately [kg]
    bool streamed = false;     // the last plan was one set point
  };

  PilotLimits limits_;
  std::optional<Guarded> guarded_;
  StepClock clock_;
  FlightController controller_;
  FlightMonitor monitor_;
  LoadWatch load_;
  ImuMonitor imu_;
  Eigen::Vector3d inertia_;  // of the empty vehicle about x, y, z of B [kg m^2]
  double least_lag_;         // of its rotors [s]
  SetPointSchedule schedule_;
  SwitchSchedule switches_;
  Sensed sensed_;         // of the last good odometry
  bool located_ = false;  // there was one
  SetPoint set_point_;    // of the last step that had one
  std::vector<SwitchReport> objections_;
  std::optional<SwitchReport> last_objection_;
  Nanoseconds set_point_stamp_ = 0;
  std::uint32_t dropped_odometry_ = 0;
  std::uint32_t dropped_set_points_ = 0;
};

}  // namespace aqc
