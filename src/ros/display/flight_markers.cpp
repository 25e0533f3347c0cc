#include "ros/display/flight_markers.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

#include "adaptive_quadrotor_control/math/number_text.h"
#include "adaptive_quadrotor_control/math/rotations.h"
#include "ros/display/marker_parts.h"

namespace aqc {
namespace {

using visualization_msgs::Marker;

constexpr double kLongestThrust = 0.35;    // an arrow of full thrust [m]
constexpr double kLeastArrow = 0.02;       // shorter ones are left out [m]
constexpr double kWindScale = 0.2;         // [m per m/s]
constexpr double kDisturbanceScale = 0.2;  // [m per N]
constexpr double kAtLimit = 0.999;         // of the rotor's range

std_msgs::ColorRGBA payloadColour() {
  return colour(0.93, 0.52, 0.18);
}
std_msgs::ColorRGBA setPointColour() {
  return colour(0.35, 0.85, 1.0, 0.9);
}

}  // namespace

std_msgs::ColorRGBA errorColour(double error, double worst) {
  const double share = std::isfinite(error) ? std::clamp(std::abs(error) / worst, 0.0, 1.0) : 1.0;
  return colour(std::min(1.0, 0.15 + 1.7 * share), std::min(0.9, 1.8 * (1.0 - share)), 0.18);
}

Markers wallMarkers(const std::vector<Box>& walls) {
  Markers markers;
  for (const Box& wall : walls) {
    markers.push_back(boxMarker(kWorldFrame, "walls", static_cast<int>(markers.size()),
                                0.5 * (wall.min + wall.max), wall.max - wall.min,
                                colour(0.85, 0.72, 0.55, 0.65)));
  }
  return markers;
}

Markers payloadMarkers(const msgs::PlantStatus& status) {
  Markers markers;
  if (status.payload_mass > 0.0) {
    const Eigen::Vector3d offset = toEigen(status.payload_offset);
    Marker rod =
        lineMarker(kBodyFrame, "payload", 1, Marker::LINE_STRIP, 0.012, colour(0.85, 0.85, 0.85));
    rod.points = {toPoint(Eigen::Vector3d::Zero()), toPoint(offset)};
    markers.push_back(rod);
    markers.push_back(
        boxMarker(kBodyFrame, "payload", 0, offset, toEigen(status.payload_size), payloadColour()));
  }
  for (std::size_t i = 0; i < status.cargo_positions.size() && i < status.cargo_sizes.size(); ++i) {
    const int id = static_cast<int>(2 * i);
    const Eigen::Vector3d place = toEigen(status.cargo_positions[i]);
    const Eigen::Vector3d size = toEigen(status.cargo_sizes[i]);
    markers.push_back(boxMarker(kWorldFrame, "cargo", id, place, size, payloadColour()));
    if (i >= status.cargo_names.size() || status.cargo_names[i].empty()) continue;
    Marker name =
        marker(kWorldFrame, "cargo", id + 1, Marker::TEXT_VIEW_FACING, colour(0.95, 0.85, 0.7));
    name.pose.position = toPoint(place + Eigen::Vector3d(0.0, 0.0, 0.5 * size.z() + 0.15));
    name.scale.z = 0.14;
    name.text = status.cargo_names[i];
    markers.push_back(name);
  }
  return markers;
}

Markers thrustMarkers(const msgs::ControllerState& state, const Vehicle& vehicle) {
  Markers markers;
  const std::size_t count = std::min(state.rotor_speeds.size(), vehicle.rotors.size());
  for (std::size_t i = 0; i < count; ++i) {
    const double share = state.rotor_speeds[i] / vehicle.max_rotor_speed;
    const double length = kLongestThrust * share * share;
    const bool idle = state.flying && share < 1.0 - kAtLimit;
    if (!std::isfinite(share) || (length < kLeastArrow && !idle)) continue;
    const bool limited = share > kAtLimit || idle;
    const Eigen::Vector2d hub = vehicle.rotors[i].position();
    const Eigen::Vector3d from(hub.x(), hub.y(), 0.2 * vehicle.rotors[i].arm_length);
    const Eigen::Vector3d to = from + std::max(length, kLeastArrow) * Eigen::Vector3d::UnitZ();
    markers.push_back(arrowMarker(
        kBodyFrame, "thrust", static_cast<int>(i), from, to, 0.022,
        limited ? colour(1.0, 0.1, 0.1) : colour(0.35 + 0.6 * share * share, 0.95, 0.45)));
  }
  return markers;
}

Markers setPointMarkers(const msgs::ControllerState& state) {
  if (!state.flying) return {};
  const Eigen::Vector3d position = toEigen(state.position);
  const Eigen::Vector3d desired = toEigen(state.desired_position);
  constexpr int kCorners = 32;
  constexpr double kRadius = 0.22;  // [m]
  Marker ring =
      lineMarker(kWorldFrame, "set_point", 0, Marker::LINE_STRIP, 0.018, setPointColour());
  ring.pose.position = toPoint(desired);
  for (int i = 0; i <= kCorners; ++i) {
    const double angle = 2.0 * M_PI * i / kCorners;
    ring.points.push_back(toPoint({kRadius * std::cos(angle), kRadius * std::sin(angle), 0.0}));
  }
  const Eigen::Vector3d nose = yawRotation(state.desired_yaw) * Eigen::Vector3d::UnitX();
  Markers markers = {ring, arrowMarker(kWorldFrame, "set_point", 1, desired, desired + 0.4 * nose,
                                       0.02, setPointColour())};
  const double error = (desired - position).norm();
  if (error > kLeastArrow) {
    markers.push_back(
        arrowMarker(kWorldFrame, "error", 0, position, desired, 0.02, colour(1.0, 0.25, 0.85)));
  }
  return markers;
}

Markers disturbanceMarkers(const msgs::PlantStatus& status, const Eigen::Vector3d& position) {
  Markers markers;
  const auto add = [&](const char* ns, const geometry_msgs::Vector3& vector, double scale,
                       const std_msgs::ColorRGBA& rgba) {
    const Eigen::Vector3d arrow = scale * toEigen(vector);
    if (!(arrow.norm() > kLeastArrow)) return;
    // It ends at the vehicle, as what pushes it would.
    markers.push_back(arrowMarker(kWorldFrame, ns, 0, position - arrow, position, 0.04, rgba));
  };
  add("wind", status.wind, kWindScale, colour(0.55, 0.75, 1.0, 0.9));
  add("disturbance", status.disturbance_force, kDisturbanceScale, colour(0.75, 0.4, 1.0, 0.9));
  return markers;
}

Markers plumbMarkers(const Eigen::Vector3d& position) {
  Marker line =
      lineMarker(kWorldFrame, "plumb", 0, Marker::LINE_STRIP, 0.008, colour(0.8, 0.8, 0.85, 0.5));
  line.points = {toPoint(position), toPoint({position.x(), position.y(), 0.0})};
  Marker foot = marker(kWorldFrame, "plumb", 1, Marker::CYLINDER, colour(0.0, 0.0, 0.0, 0.35));
  foot.pose.position = toPoint({position.x(), position.y(), 0.003});
  foot.scale.x = foot.scale.y = 0.4;
  foot.scale.z = 0.004;
  return {line, foot};
}

std::string flightMode(const msgs::ControllerState& state, const msgs::PlantStatus* status) {
  if (status != nullptr && status->crashed) return "crashed: " + status->crash_reason;
  if (status != nullptr && status->paused) return "waiting";
  if (!state.mode.empty()) return state.mode + " (" + state.mode_reason + ")";
  if (!state.flying) return "rotors off";
  if (state.saturated) return "saturated";
  return status != nullptr && status->touching ? "on the ground" : "flying";
}

Markers textMarkers(const msgs::ControllerState& state, const msgs::PlantStatus* status,
                    const Vehicle& vehicle) {
  const std::string mode = flightMode(state, status);
  std::string text = state.controller + "  |  " + mode;
  if (std::isfinite(state.mass_estimate)) {
    text += formatted("\nmass estimate %.2f kg", state.mass_estimate);
    if (status != nullptr) text += formatted(" (is %.2f)", vehicle.mass + status->payload_mass);
  } else if (status != nullptr) {
    text += formatted("\nmass %.2f kg", vehicle.mass + status->payload_mass);
  }
  if (state.flying) text += formatted("\naltitude error %+.1f cm", 100.0 * state.position_error.z);

  const bool calm = !state.saturated && (status == nullptr || !status->crashed);
  Marker m = marker(kWorldFrame, "text", 0, Marker::TEXT_VIEW_FACING,
                    calm ? colour(1.0, 1.0, 1.0) : colour(1.0, 0.45, 0.4));
  m.pose.position = toPoint(toEigen(state.position) + Eigen::Vector3d(0.0, 0.0, 1.15));
  m.scale.z = 0.17;
  m.text = text;
  return {m};
}

visualization_msgs::MarkerArray withDeletions(const Markers& previous, const Markers& current) {
  visualization_msgs::MarkerArray message;
  message.markers = current;
  std::set<std::pair<std::string, int>> there;
  for (const Marker& m : current) there.insert({m.ns, m.id});
  for (const Marker& m : previous) {
    if (there.count({m.ns, m.id}) > 0) continue;
    Marker gone;
    gone.header = m.header;
    gone.ns = m.ns;
    gone.id = m.id;
    gone.action = Marker::DELETE;
    gone.pose.orientation.w = 1.0;
    message.markers.push_back(gone);
  }
  return message;
}

}  // namespace aqc
