#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace aqc::kernel {

/// x and y of a vector in one register (the vector extension of GCC and Clang); + - * / act element
/// by element.
///
/// Everything in this file is for the plant's step, one long chain of small products. Through
/// Eigen's vectors it goes by way of memory, written entry by entry and read back in pairs, and
/// every such read waits until the writes are through: that took half of the step. Here it stays in
/// registers, two instructions where single numbers would need three.
using Pair = double __attribute__((vector_size(16)));

inline Pair both(double value) {
  return Pair{value, value};
}
inline Pair first(Pair v) {
  return Pair{v[0], v[0]};
}
inline Pair second(Pair v) {
  return Pair{v[1], v[1]};
}
inline Pair swapped(Pair v) {
  return Pair{v[1], v[0]};
}
/// Turned by 90 degrees about z: e_z x v.
inline Pair turned(Pair v) {
  return Pair{-v[1], v[0]};
}
/// The scalar product, in both places.
inline Pair dot(Pair a, Pair b) {
  const Pair products = a * b;
  return products + swapped(products);
}

/// A vector that stays in registers.
struct Plain3 {
  Pair xy;
  Pair zz;  // z twice, ready to be multiplied with pairs

  static Plain3 from(const Eigen::Vector3d& v) { return {Pair{v[0], v[1]}, both(v[2])}; }
  Eigen::Vector3d eigen() const { return {xy[0], xy[1], zz[0]}; }
};

inline Plain3 operator+(const Plain3& a, const Plain3& b) {
  return {a.xy + b.xy, a.zz + b.zz};
}
inline Plain3 operator-(const Plain3& a, const Plain3& b) {
  return {a.xy - b.xy, a.zz - b.zz};
}
inline Plain3 operator*(Pair factor, const Plain3& v) {
  return {factor * v.xy, factor * v.zz};
}
inline Plain3 operator*(double factor, const Plain3& v) {
  return both(factor) * v;
}
inline Plain3 cross(const Plain3& a, const Plain3& b) {
  return {turned(a.zz * b.xy - b.zz * a.xy), dot(turned(a.xy), b.xy)};
}

/// A matrix, by columns.
struct Plain33 {
  Plain3 x, y, z;

  static Plain33 from(const Eigen::Matrix3d& A) {
    return {Plain3::from(A.col(0)), Plain3::from(A.col(1)), Plain3::from(A.col(2))};
  }
};

inline Plain3 operator*(const Plain33& A, const Plain3& v) {
  return first(v.xy) * A.x + second(v.xy) * A.y + v.zz * A.z;
}

/// A quaternion, of unit norm where it stands for an attitude.
struct PlainQuaternion {
  Pair xy, zw;

  static PlainQuaternion from(const Eigen::Quaterniond& q) {
    return {Pair{q.x(), q.y()}, Pair{q.z(), q.w()}};
  }
  Eigen::Quaterniond eigen() const { return {zw[1], xy[0], xy[1], zw[0]}; }
};

inline PlainQuaternion operator+(const PlainQuaternion& a, const PlainQuaternion& b) {
  return {a.xy + b.xy, a.zw + b.zw};
}
inline PlainQuaternion operator*(double factor, const PlainQuaternion& q) {
  return {factor * q.xy, factor * q.zw};
}
/// The product of q and the quaternion (v, 0).
inline PlainQuaternion operator*(const PlainQuaternion& q, const Plain3& v) {
  const Plain3 vector = {q.xy, first(q.zw)};
  const Plain3 product = second(q.zw) * v + cross(vector, v);
  const Pair scalar = dot(q.xy, v.xy) + vector.zz * v.zz;
  return {product.xy, Pair{product.zz[0], -scalar[0]}};
}

/// The rotation matrix of a unit quaternion.
struct PlainRotation {
  Pair x, y, z;   // upper two rows: the horizontal parts of the axes of B, in W
  Pair bottom;    // lowest row: the vertical parts of the first two axes ...
  Pair bottom_z;  // ... and of the third, twice

  explicit PlainRotation(const PlainQuaternion& q) {
    const Pair twice = 2.0 * q.xy;
    const Pair zz = first(q.zw);
    const Pair ww = second(q.zw);
    const Pair twice_z = zz + zz;
    const Pair squares = q.xy * twice;                     // 2 x x, 2 y y
    const Pair diagonal = 1.0 - (squares + zz * twice_z);  // of y, of x
    const Pair xy = q.xy * swapped(twice);
    const Pair zw = twice_z * ww;
    const Pair across = twice_z * q.xy;    // 2 x z, 2 y z
    const Pair tilt = turned(ww * twice);  // -2 y w, 2 x w
    x = Pair{diagonal[1], (xy + zw)[0]};
    y = Pair{(xy - zw)[0], diagonal[0]};
    z = across - tilt;
    bottom = across + tilt;
    bottom_z = 1.0 - (squares + swapped(squares));
  }

  Plain3 axisZ() const { return {z, bottom_z}; }
  /// (xy, 0) in W, plus an offset that is known before xy.
  Plain3 toWorld(Pair xy, const Plain3& offset) const {
    return {offset.xy + first(xy) * x + second(xy) * y, offset.zz + dot(bottom, xy)};
  }
  Plain3 toWorld(const Plain3& v) const { return toWorld(v.xy, v.zz * axisZ()); }
  /// x and y in B of a vector of W, plus an offset.
  Pair acrossBody(const Plain3& v, Pair offset) const {
    const Pair along_x = x * v.xy;
    const Pair along_y = y * v.xy;
    return Pair{along_x[0], along_y[0]} + Pair{along_x[1], along_y[1]} + (v.zz * bottom + offset);
  }
  Plain3 toBody(const Plain3& v) const {
    return {acrossBody(v, Pair{0.0, 0.0}), dot(z, v.xy) + bottom_z * v.zz};
  }
};

}  // namespace aqc::kernel
