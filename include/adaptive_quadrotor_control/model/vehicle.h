#pragma once

#include <Eigen/Core>
#include <array>
#include <string>
#include <vector>

#include "adaptive_quadrotor_control/parameters/schema.h"

namespace aqc {

class ParameterReader;

/// Most rotors a vehicle may have: per-rotor arrays have this much room, so nothing is allocated
/// in flight.
constexpr int kMaxRotors = 16;

/// One number a rotor; as many rows as the vehicle has rotors.
using RotorArray = Eigen::Matrix<double, Eigen::Dynamic, 1, Eigen::ColMajor, kMaxRotors, 1>;

struct Rotor {
  double angle = 0.0;       ///< of the arm, from +x of B towards +y [rad]
  double arm_length = 0.0;  ///< l [m], > 0
  int direction = 1;        ///< +1 spins counter-clockwise seen from above, -1 clockwise

  Eigen::Vector2d position() const;  ///< of the hub in the x-y plane of B [m]
};

/// A multirotor whose rotors lie in the x-y plane of B and push along +z of B.
struct Vehicle {
  std::string name;
  double mass = 0.0;                                  ///< m, empty [kg], > 0
  Eigen::Matrix3d inertia = Eigen::Matrix3d::Zero();  ///< J about the centre of mass, in B [kg m^2]
  std::vector<Rotor> rotors;                          ///< 4 to kMaxRotors
  double force_constant = 0.0;                        ///< k_f [N s^2/rad^2], > 0
  double moment_constant = 0.0;                       ///< k_m [m], > 0: drag moment / thrust
  double max_rotor_speed = 0.0;                       ///< omega_max [rad/s], > 0
  double time_constant_up = 0.0;            ///< of a rotor that speeds up [s], >= 0; 0: at once
  double time_constant_down = 0.0;          ///< of a rotor that slows down [s], >= 0
  double drag_coefficient = 0.0;            ///< c_d [N s^2/(rad m)], >= 0
  double rolling_moment_coefficient = 0.0;  ///< c_r [N s^2/rad], >= 0
  double gear_height = 0.0;                 ///< from the ground to the origin of B [m], > 0
  double gear_radius = 0.0;                 ///< of the circle of four feet [m], > 0

  /// Largest thrust all rotors give together [N].
  double maxThrust() const;
  /// Where the feet stand below B, in its x and y [m].
  std::array<Eigen::Vector2d, 4> feet() const;
};

/// Of a multirotor alone [kg]: from a gram, a tenth of the lightest ones, to a tonne, twice the
/// heaviest ones.
inline const Range kVehicleMass = Range::between(1e-3, 1e3);
/// The least principal moment of inertia [kg m^2]: a gram 1 mm away.
constexpr double kLeastVehicleMoment = 1e-9;

/// Reads and validates a vehicle: see config/vehicle/*.yaml for the names and their meaning. Every
/// number has an upper bound that leaves room for a multirotor of 10 g as well as for one of 500
/// kg: arms and landing gear of 10 m, time constants of 10 s, rotors of 1e5 rad/s (ten times the
/// fastest ones). A force constant of 1 N s^2/rad^2 is a hundred times that of a rotor of 3 m; no
/// rotor's drag moment is that of its thrust 10 m away; 1 N s^2/(rad m) of rotor drag and 1 N
/// s^2/rad of rolling moment are ten thousand times a small quadrotor's. Throws ParameterError,
/// also when the rotors cannot give thrust and every moment independently.
Vehicle readVehicle(const ParameterReader& reader);

/// The vehicle of a YAML file. Throws ParameterError.
Vehicle loadVehicle(const std::string& path);

}  // namespace aqc
