#include "figures/vehicle_urdf.h"

#include <algorithm>
#include <cmath>
#include <sstream>

namespace aqc {
namespace {

// Shares of the arm length that look like a multirotor.
constexpr double kBodyRadius = 0.36;
constexpr double kBodyHeight = 0.22;
constexpr double kArmWidth = 0.08;
constexpr double kMotorRadius = 0.09;
constexpr double kHubHeight = 0.18;   // of the rotor discs above the arms
constexpr double kDiscShare = 0.46;   // of the distance between neighbouring hubs
constexpr double kThickness = 0.012;  // of discs and legs [m]

constexpr const char* kFrame = "0.72 0.75 0.80 1";  // seen before a dark ground
constexpr const char* kMetal = "0.62 0.65 0.70 1";
constexpr const char* kNose = "0.90 0.22 0.20 1";
constexpr const char* kCounterClockwise = "0.25 0.60 1.00 0.75";
constexpr const char* kClockwise = "1.00 0.62 0.15 0.75";

std::string join(const Eigen::Vector3d& v) {
  std::ostringstream text;
  text << v.x() << ' ' << v.y() << ' ' << v.z();
  return text.str();
}

std::string escaped(const std::string& text) {
  std::string safe;
  for (const char c : text) {
    if (c == '&') {
      safe += "&amp;";
    } else if (c == '<') {
      safe += "&lt;";
    } else if (c == '"') {
      safe += "&quot;";
    } else {
      safe += c;
    }
  }
  return safe;
}

// Writes visuals; every one needs a material of its own name.
class Visuals {
 public:
  void box(const Eigen::Vector3d& place, double yaw, const Eigen::Vector3d& size,
           const char* colour) {
    add(place, yaw, "<box size=\"" + join(size) + "\"/>", colour);
  }
  void cylinder(const Eigen::Vector3d& place, double radius, double length, const char* colour) {
    std::ostringstream geometry;
    geometry << "<cylinder radius=\"" << radius << "\" length=\"" << length << "\"/>";
    add(place, 0.0, geometry.str(), colour);
  }
  std::string text() const { return text_.str(); }

 private:
  void add(const Eigen::Vector3d& place, double yaw, const std::string& geometry,
           const char* colour) {
    text_ << "    <visual>\n      <origin xyz=\"" << join(place) << "\" rpy=\"0 0 " << yaw
          << "\"/>\n      <geometry>" << geometry << "</geometry>\n      <material name=\"colour_"
          << count_++ << "\"><color rgba=\"" << colour << "\"/></material>\n    </visual>\n";
  }

  std::ostringstream text_;
  int count_ = 0;
};

// As large as fits between the nearest two hubs. Those of coaxial rotors coincide and do not count.
double discRadius(const Vehicle& vehicle) {
  double nearest = 2.0 * vehicle.rotors.front().arm_length;
  const double coaxial = 1e-6 * nearest;
  for (std::size_t i = 0; i < vehicle.rotors.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      const double distance = (vehicle.rotors[i].position() - vehicle.rotors[j].position()).norm();
      if (distance > coaxial) nearest = std::min(nearest, distance);
    }
  }
  return kDiscShare * nearest;
}

void addRotor(Visuals& visuals, const Rotor& rotor, double radius) {
  const Eigen::Vector2d hub = rotor.position();
  const double l = rotor.arm_length;
  visuals.box({0.5 * hub.x(), 0.5 * hub.y(), 0.0}, rotor.angle, {l, kArmWidth * l, kArmWidth * l},
              kFrame);
  visuals.cylinder({hub.x(), hub.y(), 0.5 * kHubHeight * l}, kMotorRadius * l, kHubHeight * l,
                   kMetal);
  visuals.cylinder({hub.x(), hub.y(), kHubHeight * l}, radius, kThickness,
                   rotor.direction > 0 ? kCounterClockwise : kClockwise);
}

void addGear(Visuals& visuals, const Vehicle& vehicle) {
  for (const Eigen::Vector2d& foot : vehicle.feet()) {
    visuals.cylinder({foot.x(), foot.y(), -0.5 * vehicle.gear_height}, 0.5 * kThickness,
                     vehicle.gear_height, kMetal);
  }
  // Two rails that carry the legs.
  const double side = std::sqrt(2.0) * vehicle.gear_radius;
  for (const double angle : {M_PI / 4.0, -M_PI / 4.0}) {
    visuals.box(Eigen::Vector3d::Zero(), angle,
                {std::sqrt(2.0) * side, 0.5 * kThickness, 0.5 * kThickness}, kMetal);
  }
}

}  // namespace

std::string vehicleUrdf(const Vehicle& vehicle) {
  Visuals visuals;
  const double l = vehicle.rotors.front().arm_length;
  visuals.cylinder(Eigen::Vector3d::Zero(), kBodyRadius * l, kBodyHeight * l, kFrame);
  visuals.box({kBodyRadius * l, 0.0, 0.5 * kBodyHeight * l}, 0.0,
              {0.35 * l, 0.14 * l, 0.5 * kBodyHeight * l}, kNose);
  const double radius = discRadius(vehicle);
  for (const Rotor& rotor : vehicle.rotors) addRotor(visuals, rotor, radius);
  addGear(visuals, vehicle);
  return "<?xml version=\"1.0\"?>\n<robot name=\"" + escaped(vehicle.name) +
         "\">\n  <link name=\"base_link\">\n" + visuals.text() + "  </link>\n</robot>\n";
}

}  // namespace aqc
