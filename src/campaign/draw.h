#pragma once

#include <string>
#include <vector>

#include "adaptive_quadrotor_control/math/constants.h"
#include "campaign/fault_draw.h"

// How single faults are drawn.

namespace aqc {

/// A flight that faults are being added to.
struct Draw {
  Dice& dice;
  const Vehicle& vehicle;
  double end;  ///< of the mission [s]
  FaultFlight& flight;

  static constexpr double kArmed = 0.5;     ///< [s]: from here on things go wrong
  static constexpr double kDown = 4.0;      ///< [s] after the mission's end, in most landings
  static constexpr double kShortest = 0.1;  ///< of a spell [s]
  static constexpr double kLongest = 5.0;   ///< [s]

  OdometryFaults& odometry() const { return flight.scenario.world.sensors->odometry; }
  ImuFaults& imu() const { return flight.scenario.world.sensors->imu; }
  double weight() const { return vehicle.mass * kGravity; }
  double spareThrust() const { return vehicle.maxThrust() - weight(); }

  /// At which something begins [s].
  double time() const { return dice.between(kArmed, end + kDown); }
  /// While the mission lasts.
  Nanoseconds timeOfMission() const { return fromSeconds(dice.between(kArmed, end)); }
  TimeWindow spell(double shortest = kShortest, double longest = kLongest) const {
    TimeWindow window;
    window.from = fromSeconds(time());
    window.until = window.from + fromSeconds(dice.between(shortest, longest));
    return window;
  }
  void happens(Nanoseconds at, PlantAction action) const {
    flight.scenario.mission.events.push_back({at, std::move(action)});
  }
  void pull(const TimeWindow& window, const ForceMoment& load) const {
    happens(window.from, ApplyDisturbance{window.until - window.from, load, 0.0});
  }
  void asks(Nanoseconds at, const SetPoint& point) const {
    flight.orders.push_back({at, Order::Kind::kPlan, {{at, point}}});
  }
};

/// A kind of fault and the function that adds one of it to a flight and tells its numbers.
struct FaultDraw {
  FaultKindText text;
  std::string (*draw)(const Draw& draw);
};

/// Of odometry and IMU, of the plant, and of who plans; in the order of FaultKind.
std::vector<FaultDraw> sensorFaults();
std::vector<FaultDraw> plantFaults();
std::vector<FaultDraw> planFaults();

/// In words.
std::string text(const TimeWindow& window);
std::string text(const Eigen::Vector3d& vector);

}  // namespace aqc
