#pragma once

#include <std_msgs/ColorRGBA.h>
#include <visualization_msgs/MarkerArray.h>

#include <vector>

#include "adaptive_quadrotor_control/ControllerState.h"
#include "adaptive_quadrotor_control/PlantStatus.h"
#include "adaptive_quadrotor_control/model/vehicle.h"
#include "adaptive_quadrotor_control/simulation/box.h"
#include "ros/border/conversions.h"

// What rviz shows of a flight, as markers. Functions of their arguments only: no node, no time.

namespace aqc {

using Markers = std::vector<visualization_msgs::Marker>;

/// The position error at which the flown path is all red [m].
constexpr double kWorstShownError = 0.5;

/// From green (no error) over yellow to red (`worst` and beyond, or not a number).
std_msgs::ColorRGBA errorColour(double error, double worst = kWorstShownError);

/// The scenario's walls, half transparent, in `world`. Namespace "walls".
Markers wallMarkers(const std::vector<Box>& walls);

/// The attached payload with its rod in `base_link` ("payload") and what lies about in `world`
/// ("cargo", with its name).
Markers payloadMarkers(const msgs::PlantStatus& status);

/// An arrow a rotor in `base_link`, as long as its thrust: green to yellow as it grows, red at a
/// limit. Namespace "thrust".
Markers thrustMarkers(const msgs::ControllerState& state, const Vehicle& vehicle);

/// While a set point is active: a ghost ring with its heading ("set_point") and an arrow from the
/// vehicle to it ("error").
Markers setPointMarkers(const msgs::ControllerState& state);

/// Arrows for wind (1 m is 5 m/s) and disturbing force (1 m is 5 N), if any. Namespaces "wind",
/// "disturbance".
Markers disturbanceMarkers(const msgs::PlantStatus& status, const Eigen::Vector3d& position);

/// The plumb line to the ground, which shows where above it the vehicle is. Namespace "plumb".
Markers plumbMarkers(const Eigen::Vector3d& position);

/// ControlLaw, what the vehicle does, mass estimate (and truth, if `status`, which may be null, has
/// it) and altitude error, above the vehicle. Namespace "text".
Markers textMarkers(const msgs::ControllerState& state, const msgs::PlantStatus* status,
                    const Vehicle& vehicle);
/// "flying", "saturated", "crashed: ...", or the guard's mode and why: the mode in the text.
std::string flightMode(const msgs::ControllerState& state, const msgs::PlantStatus* status);

/// `current` as a message, and a deletion of everything in `previous` that is not in it.
visualization_msgs::MarkerArray withDeletions(const Markers& previous, const Markers& current);

}  // namespace aqc
