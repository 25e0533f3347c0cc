#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace aqc {

/// Three numbers that stay in registers.
///
/// The plant's step is one long chain of small products. Through Eigen's vectors it goes by way of
/// memory, written entry by entry and read back in pairs, and every such read waits until the
/// writes are through: that took half of the step.
struct Plain3 {
  double x, y, z;

  static Plain3 from(const Eigen::Vector3d& v) { return {v[0], v[1], v[2]}; }
  Eigen::Vector3d eigen() const { return {x, y, z}; }
};

inline Plain3 operator+(const Plain3& a, const Plain3& b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}
inline Plain3 operator-(const Plain3& a, const Plain3& b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
inline Plain3 operator*(double factor, const Plain3& v) {
  return {factor * v.x, factor * v.y, factor * v.z};
}
inline double dot(const Plain3& a, const Plain3& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
inline Plain3 cross(const Plain3& a, const Plain3& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
inline Plain3 operator*(const Eigen::Matrix3d& A, const Plain3& v) {
  return {A(0, 0) * v.x + A(0, 1) * v.y + A(0, 2) * v.z,
          A(1, 0) * v.x + A(1, 1) * v.y + A(1, 2) * v.z,
          A(2, 0) * v.x + A(2, 1) * v.y + A(2, 2) * v.z};
}

/// A quaternion, of unit norm where it stands for an attitude.
struct PlainQuaternion {
  Plain3 vector;
  double scalar;

  static PlainQuaternion from(const Eigen::Quaterniond& q) {
    return {{q.x(), q.y(), q.z()}, q.w()};
  }
};

/// The rotation matrix of a unit quaternion, as the three axes of B in W.
struct PlainRotation {
  Plain3 x, y, z;

  explicit PlainRotation(const PlainQuaternion& q) {
    const Plain3 twice = 2.0 * q.vector;
    const Plain3 w = q.scalar * twice;
    const double xx = q.vector.x * twice.x;
    const double yy = q.vector.y * twice.y;
    const double zz = q.vector.z * twice.z;
    const double xy = q.vector.x * twice.y;
    const double xz = q.vector.x * twice.z;
    const double yz = q.vector.y * twice.z;
    x = {1.0 - (yy + zz), xy + w.z, xz - w.y};
    y = {xy - w.z, 1.0 - (xx + zz), yz + w.x};
    z = {xz + w.y, yz - w.x, 1.0 - (xx + yy)};
  }

  Plain3 toWorld(const Plain3& v) const { return v.x * x + v.y * y + v.z * z; }
  Plain3 toBody(const Plain3& v) const { return {dot(x, v), dot(y, v), dot(z, v)}; }
  Eigen::Matrix3d eigen() const {
    Eigen::Matrix3d matrix;
    matrix << x.eigen(), y.eigen(), z.eigen();
    return matrix;
  }
};

}  // namespace aqc
