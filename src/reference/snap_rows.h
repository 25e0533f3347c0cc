#pragma once

#include <Eigen/Core>
#include <cmath>

namespace aqc {

/// Rows that turn the states at the ends of a septic into its cost: with unit duration,
/// integral of snap^2 = |left * start + right * end|^2, where start and end hold value, velocity,
/// acceleration and jerk.
///
/// The rows are the coefficients of the snap in the orthonormal Legendre polynomials of [0, 1].
/// The snap of a septic is a cubic, so four of them say all, and integrating snap times a cubic by
/// parts leaves end values only. That makes the entries whole numbers times sqrt(2 k + 1) and the
/// cost a sum of four squares: a square root of the Hessian that costs nothing to compute.
struct SnapRows {
  Eigen::Matrix4d left;
  Eigen::Matrix4d right;
};

inline SnapRows unitSnapRows() {
  SnapRows rows;
  rows.left << 0, 0, 0, -1,  //
      0, 0, 2, 1,            //
      0, -12, -6, -1,        //
      120, 60, 12, 1;        //
  rows.right << 0, 0, 0, 1,  //
      0, 0, -2, 1,           //
      0, 12, -6, 1,          //
      -120, 60, -12, 1;      //
  for (int k = 0; k < 4; ++k) {
    const double norm = std::sqrt(2.0 * k + 1.0);
    rows.left.row(k) *= norm;
    rows.right.row(k) *= norm;
  }
  return rows;
}

}  // namespace aqc
