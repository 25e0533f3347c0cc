#pragma once

#include <array>
#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "adaptive_quadrotor_control/flight/flight_log.h"

namespace aqc {

constexpr double kNothing = std::numeric_limits<double>::quiet_NaN();  ///< where there is no value
constexpr std::array<const char*, 3> kAxes = {"x", "y", "z"};
constexpr std::array<const char*, 3> kAngles = {"roll", "pitch", "yaw"};

/// One number of every sample of a flight.
struct FlightColumn {
  std::string name;                                  ///< with its unit: "velocity_x [m/s]"
  std::function<double(const FlightSample&)> value;  ///< not-a-number where there is none
  /// Puts such a value where it belongs; throws std::invalid_argument, saying what is allowed.
  /// Empty for what follows from other columns. `flying` goes first: the other way round, last to
  /// first.
  std::function<void(FlightSample&, double)> set;
};

/// What the columns of a flight depend on.
struct FlightLayout {
  std::vector<std::string> adaptive_names;  ///< at most kMaxAdaptive
  Eigen::Index rotors = 0;                  ///< at most kMaxRotors
  bool disturbed = false;                   ///< a disturbance acts at some time
};

FlightLayout layoutOf(const FlightLog& log);

/// All columns of such a flight, in order; adaptive quantities by their name and as many rotor
/// speeds as there are rotors. SI units, angles in rad, W is ENU, B is FLU, attitudes are B to W as
/// unit quaternions and, the same again, as roll, pitch, yaw. What belongs to a set point is
/// not-a-number while none is active.
std::vector<FlightColumn> flightColumns(const FlightLayout& layout);

}  // namespace aqc
