#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <string>
#include <vector>

#include "adaptive_quadrotor_control/model/vehicle.h"
#include "adaptive_quadrotor_control/reference/set_point_schedule.h"
#include "adaptive_quadrotor_control/simulation/scenario.h"

namespace aqc {

/// What can go wrong in a fault flight, in the order of faultKinds().
enum class FaultKind {
  kNoise,
  kDrift,
  kRate,
  kDelay,
  kJitter,
  kDropped,
  kDuplicated,
  kReordered,
  kJump,
  kFreeze,
  kNotANumber,
  kStamps,
  kClockStep,
  kGap,
  kNoOdometry,
  kImuNoise,
  kImuBias,
  kNoImu,
  kWind,
  kShove,
  kPayload,
  kTetherBelow,
  kTetherAbove,
  kGust,
  kRotorWeak,
  kRotorSlow,
  kRotorStuck,
  kRotorLost,
  kBattery,
  kCommandsLost,
  kPlanEnds,
  kPlanAbsurd,
  kPlanFar,
  kPlanNervous,
};

/// A row of the table of faults.
struct FaultKindText {
  FaultKind kind;
  const char* name;   ///< a word or two, for tables
  const char* range;  ///< what is drawn evenly
};
/// In the order of FaultKind.
const std::vector<FaultKindText>& faultKinds();

/// A fault of one flight.
struct DrawnFault {
  FaultKind kind = FaultKind::kNoise;
  std::string text;  ///< with its numbers and times
};

/// What an operator asks of the pilot.
struct Order {
  enum class Kind {
    kPlan,     ///< Pilot::plan(); may be refused
    kGoTo,     ///< Guard::goTo() of the first set point
    kRelease,  ///< Pilot::release()
    kLand,     ///< Guard::land(), again and again until it is down
  };
  Nanoseconds time = 0;
  Kind kind = Kind::kPlan;
  std::vector<TimedSetPoint> set_points;
};

/// A flight with its faults, all drawn from its seed.
struct FaultFlight {
  std::uint64_t seed = 0;
  Scenario scenario;          ///< world with sensors, events and duration; plans nothing by itself
  std::vector<Order> orders;  ///< by time
  std::vector<DrawnFault> faults;
  Eigen::AlignedBox3d asked;  ///< start and all goals [m]
};

/// Without faults and orders: standing at the origin, with perfect sensors, control at 250 Hz and a
/// plant of 1 ms; it takes off by itself (see ClosedLoop). The seed is that of the sensors.
FaultFlight emptyFlight(std::uint64_t seed, const Vehicle& vehicle);

/// Take-off at the start, one to four goals within 4 m, and in six of seven flights a landing; one
/// to three faults of different kinds. The same seed and vehicle give the same flight.
FaultFlight drawFaultFlight(std::uint64_t seed, const Vehicle& vehicle);

}  // namespace aqc
