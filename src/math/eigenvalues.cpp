#include "adaptive_quadrotor_control/math/eigenvalues.h"

#include <Eigen/Eigenvalues>

namespace aqc {

EigenvalueRange eigenvalueRange(const Eigen::MatrixXd& symmetric) {
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(symmetric, Eigen::EigenvaluesOnly);
  return {solver.eigenvalues().minCoeff(), solver.eigenvalues().maxCoeff()};
}

}  // namespace aqc
