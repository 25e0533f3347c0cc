#pragma once

#include <Eigen/Dense>
#include <cmath>
#include <optional>
#include <vector>

#include "adaptive_quadrotor_control/reference/minimum_snap.h"

/// An oracle for minimum snap: the same quadratic programme over the plain coefficients (powers of
/// seconds since the start of each segment), with every condition as an equality constraint, as one
/// dense KKT system.
namespace aqc::test {

using Real = long double;
using DenseMatrix = Eigen::Matrix<Real, Eigen::Dynamic, Eigen::Dynamic>;

/// d^order/dt^order of t^0 ... t^7.
inline Eigen::Matrix<Real, 1, 8> powers(Real t, int order) {
  Eigen::Matrix<Real, 1, 8> row;
  for (int k = 0; k < 8; ++k) {
    Real factor = 1;
    for (int j = 0; j < order; ++j) {
      factor *= static_cast<Real>(k - j);
    }
    row(k) = k < order ? 0 : factor * std::pow(t, static_cast<Real>(k - order));
  }
  return row;
}

struct Programme {
  std::vector<Eigen::Matrix<Real, 1, Eigen::Dynamic>> rows;
  std::vector<Eigen::Matrix<Real, 1, 4>> values;
};

inline void require(Programme& programme, Eigen::Index size, std::size_t segment, Real t, int order,
                    const Eigen::Vector4d& value, bool continues = false) {
  Eigen::Matrix<Real, 1, Eigen::Dynamic> row = Eigen::Matrix<Real, 1, Eigen::Dynamic>::Zero(size);
  row.segment(static_cast<Eigen::Index>(segment) * 8, 8) = powers(t, order);
  if (continues) {
    row.segment(static_cast<Eigen::Index>(segment) * 8 + 8, 8) = -powers(0, order);
  }
  programme.rows.push_back(row);
  programme.values.push_back(value.cast<Real>().transpose());
}

inline DenseMatrix snapHessian(const std::vector<double>& durations) {
  const auto size = static_cast<Eigen::Index>(durations.size()) * 8;
  DenseMatrix hessian = DenseMatrix::Zero(size, size);
  for (std::size_t s = 0; s < durations.size(); ++s) {
    for (int i = 4; i < 8; ++i) {
      for (int j = 4; j < 8; ++j) {
        const auto base = static_cast<Eigen::Index>(s) * 8;
        const Real factor = powers(1, 4)(i) * powers(1, 4)(j);
        hessian(base + i, base + j) =
            factor * std::pow(static_cast<Real>(durations[s]), static_cast<Real>(i + j - 7)) /
            static_cast<Real>(i + j - 7);
      }
    }
  }
  return hessian;
}

/// Coefficients, 8 rows per segment, one column per output. Yaws are taken as they are.
inline DenseMatrix denseOptimum(const std::vector<Waypoint>& waypoints,
                                const std::vector<double>& durations, bool is_rest) {
  const auto size = static_cast<Eigen::Index>(durations.size()) * 8;
  Programme programme;
  for (std::size_t i = 0; i < waypoints.size(); ++i) {
    const Waypoint& waypoint = waypoints[i];
    const bool is_last = i == durations.size();
    const std::size_t segment = is_last ? i - 1 : i;
    const Real t = is_last ? static_cast<Real>(durations.back()) : 0;
    Eigen::Vector4d position;
    position << waypoint.position, waypoint.yaw;
    require(programme, size, segment, t, 0, position);
    if (i > 0 && !is_last) {
      require(programme, size, i - 1, static_cast<Real>(durations[i - 1]), 0, position);
    }
    const std::optional<Eigen::Vector4d> fixed[] = {waypoint.velocity, waypoint.acceleration,
                                                    waypoint.jerk};
    for (int order = 1; order <= 3; ++order) {
      if (fixed[order - 1]) {
        require(programme, size, segment, t, order, *fixed[order - 1]);
      } else if (is_rest && (i == 0 || is_last)) {
        require(programme, size, segment, t, order, Eigen::Vector4d::Zero());
      }
      if (i > 0 && !is_last) {
        require(programme, size, i - 1, static_cast<Real>(durations[i - 1]), order,
                Eigen::Vector4d::Zero(), true);
      }
    }
  }
  const auto count = static_cast<Eigen::Index>(programme.rows.size());
  DenseMatrix system = DenseMatrix::Zero(size + count, size + count);
  DenseMatrix rhs = DenseMatrix::Zero(size + count, 4);
  system.topLeftCorner(size, size) = snapHessian(durations);
  for (Eigen::Index i = 0; i < count; ++i) {
    system.row(size + i).head(size) = programme.rows[static_cast<std::size_t>(i)];
    system.col(size + i).head(size) = programme.rows[static_cast<std::size_t>(i)].transpose();
    rhs.row(size + i) = programme.values[static_cast<std::size_t>(i)];
  }
  return system.fullPivLu().solve(rhs).topRows(size);
}

inline Eigen::Vector4d denseValue(const DenseMatrix& coefficients, std::size_t segment, double t,
                                  int order) {
  const DenseMatrix value = powers(static_cast<Real>(t), order) *
                            coefficients.middleRows(static_cast<Eigen::Index>(segment) * 8, 8);
  return value.transpose().cast<double>();
}

}  // namespace aqc::test
