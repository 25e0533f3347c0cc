#pragma once

#include "adaptive_quadrotor_control/model/rotor_allocation.h"
#include "adaptive_quadrotor_control/pilot/flight_monitor.h"
#include "adaptive_quadrotor_control/pilot/guard_limits.h"
#include "adaptive_quadrotor_control/pilot/guard_rules.h"
#include "adaptive_quadrotor_control/pilot/load_watch.h"
#include "adaptive_quadrotor_control/pilot/mode.h"
#include "adaptive_quadrotor_control/reference/governor.h"

namespace aqc {

/// What the guard sees when a step is due.
struct Situation {
  double dt = 0.0;               ///< since the step before [s]
  const State* state = nullptr;  ///< where the vehicle is or must be; null: never known
  double silence = 0.0;          ///< without odometry [s]
  bool feels = false;            ///< the IMU is alive
  double support = 0.0;  ///< felt by the IMU: part of the empty weight that no rotor carries
  const SetPoint* planned = nullptr;  ///< what is planned for now; null: nothing
  bool plan_ended = false;            ///< and nothing follows it
  double plan_age = 0.0;              ///< since set points were accepted [s]
  const Allocation* given = nullptr;  ///< what became of the last command
  Load load;                          ///< what is carried, and what can be
  bool law_finite = true;             ///< what it learned is
  double missing_rotors = 0.0;        ///< see RotorObserver::missing()
};

/// What is to be done in a step.
struct Decision {
  const SetPoint* set_point = nullptr;  ///< for the law; null: no law, rotors at `idle`
  double idle = 0.0;                    ///< [rad/s]
  bool learn = false;                   ///< the law may adapt
  bool forget = false;                  ///< the law goes back to its initial values
  bool stands = false;                  ///< descending without odometry, it feels the ground
};

/// The state machine that decides whether the rotors turn and which set point the law gets, in the
/// manner of PX4's Takeoff class. What it looks at, when it acts and how is the table of
/// guard_rules.h; numbers are GuardLimits. It has no clock; nothing in it allocates or throws.
class Guard {
 public:
  /// `max_thrust` [N] of all rotors together.
  Guard(const GuardLimits& limits, double max_thrust);

  /// Whether the law may carry a vehicle: null, or why it must not be armed with it (a text that
  /// lasts).
  void judgeLaw(const char* why_not) noexcept { unfit_ = why_not; }

  /// Each order is empty when it is obeyed, else says why not, and nothing has changed.
  const char* arm() noexcept;
  const char* disarm() noexcept;  ///< refused in the air: see kill()
  const char* takeOff() noexcept;
  const char* land() noexcept;
  const char* hold() noexcept;
  /// Flies to a place (yaw included) and holds there.
  const char* goTo(const SetPoint& place) noexcept;
  void kill() noexcept { enter(Mode::kKilled, Rule::kOperator); }

  // What happened to the inputs.
  void heardPlan() noexcept { plan_is_new_ = true; }  ///< set points were accepted
  void heardOdometry(const State& state) noexcept;
  /// Where odometry comes back from it tells heights that are by `rise` [m] greater than before.
  void groundRose(double rise) noexcept {
    stood_at_ += rise;
    ground_ += rise;
  }
  /// The source was reset: where it said `expected` it says `said` now.
  void sourceReset(const State& expected, const State& said) noexcept;
  void clockStepped() noexcept;
  /// What was planned is withdrawn: brakes and holds.
  void planReleased() noexcept;
  /// At the start: the controller was armed when it was last alive.
  void wasArmed() noexcept { was_armed_ = true; }

  Decision step(const Situation& now) noexcept;

  /// What it does and why, as a line of a health report; allocates.
  Finding judge() const;

  Mode mode() const noexcept { return mode_; }
  Rule rule() const noexcept { return rule_; }  ///< of the last change or reaction
  /// Where the last step wanted the vehicle: the reference that the law gets is on its way there.
  const SetPoint& goal() const noexcept { return goal_; }
  bool armed() const noexcept { return mode_ != Mode::kDisarmed && mode_ != Mode::kKilled; }
  /// The rotors are to carry it.
  bool flies() const noexcept { return armed() && mode_ != Mode::kArmed; }
  /// Armed and off the ground, as far as known.
  bool airborne() const noexcept { return armed() && airborne_; }

 private:
  // How long something has been so.
  struct Lasting {
    double time = 0.0;
    bool update(bool is_so, double dt, double limit) noexcept {
      time = is_so ? time + dt : 0.0;
      return is_so && time >= limit;
    }
  };

  void enter(Mode mode, Rule rule) noexcept;
  void restartReference(const State& moving) noexcept;
  void restAhead() noexcept;
  void brake(Rule rule) noexcept;
  void begin(const Situation& now) noexcept;
  void watchOdometry(const Situation& now) noexcept;
  void watchAttitude(const Situation& now) noexcept;
  void watchLift(const Situation& now) noexcept;
  void watchRotors(const Situation& now) noexcept;
  void watchPlan(const Situation& now) noexcept;
  void progress(const Situation& now) noexcept;
  bool thrustIsShort(const Situation& now) const noexcept;
  void settle() noexcept;
  bool mustBeDown(const Situation& now) const noexcept;
  double wayDown() const noexcept;
  bool brakesFirst() const noexcept;
  double blindSinking() const noexcept;
  double floor() const noexcept;
  bool mayLearn(const Situation& now) const noexcept;
  void aim(const Situation& now) noexcept;

  // Least vertical part of the body's z axis: cosines of the largest tilts.
  struct LeastUp {
    double flying, near, standing;
  };

  GuardLimits limits_;
  double max_thrust_;
  ReferenceGovernor governor_;
  LeastUp least_up_;
  Mode mode_ = Mode::kDisarmed;
  Rule rule_ = Rule::kNone;
  SetPoint place_;  // to hold, or to rise or sink from
  SetPoint goal_;
  State state_;            // of the last step
  bool located_ = false;   // it was ever known
  double stood_at_ = 0.0;  // height where it was armed [m]
  double ground_;          // as odometry tells heights [m]
  bool airborne_ = false;
  bool plan_is_new_ = false;
  bool was_armed_ = false;
  const char* unfit_ = nullptr;  // why it must not be armed with the present law
  bool crashed_ = false;         // no arming by itself any more
  bool was_landing_ = false;     // when odometry was lost
  double climbing_ = 0.0;        // vertical velocity, smoothed [m/s]
  double mode_time_ = 0.0;       // in this mode [s]
  double sunk_ = 0.0;            // part of it, in which a landing or a descent sank [s]
  Lasting tumbling_, tipped_, rocking_, overloaded_, saturated_, failing_, lagging_, standing_;
};

}  // namespace aqc
