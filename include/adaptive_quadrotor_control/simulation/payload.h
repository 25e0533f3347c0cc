#pragma once

#include <Eigen/Core>
#include <variant>

namespace aqc {

class ParameterReader;

/// Holds a payload as if both were one body.
struct RigidMount {};

/// Holds a payload by springs and dampers in all six directions, as rubber mounts and loose
/// grippers do. With vehicle and payload free, each relative motion q of the two at the payload's
/// centre of mass, three along and three about the axes of B, is to first order
///
///     q'' + 2 damping (2 pi frequency) q' + (2 pi frequency)^2 q = 0.
///
/// So the stiffness is (2 pi frequency)^2 M and the damper's matrix 2 damping (2 pi frequency) M,
/// where M, 6 x 6, is the reduced inertia of both at that point: the inverse of the sum of how
/// much force and moment there accelerate vehicle and payload, as they are when it is attached.
struct Joint {
  double frequency = 0.0;  ///< [Hz], 0.1 to 200
  double damping = 0.0;    ///< ratio, 0 to 2
};

/// Hangs a payload on a cable from the hook `offset`, which may be off the centre of mass. The
/// cable has no mass, pulls and never pushes. The payload is a mass in one point then: `size` only
/// tells how high it rests on the ground. When the cable jerks tight, what pulls it apart is lost,
/// as in a plastic impact.
struct Cable {
  double length = 0.0;  ///< from the hook to the payload's centre of mass [m], 0.05 to 100
};

/// A box that can be carried under a vehicle.
struct Payload {
  double mass = 0.0;                               ///< [kg], > 0
  Eigen::Vector3d size = Eigen::Vector3d::Zero();  ///< edge lengths along the axes of B [m], > 0
  /// Of its centre of mass, at rest, from the origin of B, in B [m]; with a cable that of the hook.
  Eigen::Vector3d offset = Eigen::Vector3d::Zero();
  Eigen::Matrix3d inertia = Eigen::Matrix3d::Zero();  ///< about its centre of mass, in B [kg m^2]
  std::variant<RigidMount, Joint, Cable> mount = RigidMount();

  bool rigid() const noexcept { return std::holds_alternative<RigidMount>(mount); }
};

/// Inertia of a solid box of even density about its centre [kg m^2].
Eigen::Matrix3d boxInertia(double mass, const Eigen::Vector3d& size);

/// Reads `mass`, up to a tonne, `size` and `offset`, up to 10 m in each axis, and, if not that of a
/// solid box, `inertia` (readInertia()). One that is not fixed rigidly has `joint: {frequency,
/// damping}`, 0.1 to 200 Hz (a stiffer one is as good as rigid, and costs the more steps), or
/// `cable: {length}`, 0.05 to 100 m. Throws ParameterError.
Payload readPayload(const ParameterReader& reader);

}  // namespace aqc
