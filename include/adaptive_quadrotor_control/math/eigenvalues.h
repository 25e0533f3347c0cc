#pragma once

#include <Eigen/Core>

namespace aqc {

/// Smallest and largest eigenvalue of a symmetric matrix.
struct EigenvalueRange {
  double min;
  double max;
};
EigenvalueRange eigenvalueRange(const Eigen::MatrixXd& symmetric);

}  // namespace aqc
