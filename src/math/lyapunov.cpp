#include "adaptive_quadrotor_control/math/lyapunov.h"

#include <Eigen/LU>
#include <stdexcept>
#include <string>

#include "adaptive_quadrotor_control/math/eigenvalues.h"
#include "adaptive_quadrotor_control/math/number_text.h"

namespace aqc {
namespace {

constexpr double kTolerance = 1e-9;  // relative

void requirePositiveDefinite(const char* name, const Eigen::MatrixXd& matrix) {
  if (!((matrix - matrix.transpose()).norm() <= kTolerance * matrix.norm())) {
    throw std::domain_error(std::string(name) + " is not symmetric");
  }
  const double smallest = eigenvalueRange(matrix).min;
  if (!(smallest > 0.0)) {
    throw std::domain_error(std::string(name) + " has the eigenvalue " + numberText(smallest) +
                            "; every one must be > 0");
  }
}

// The matrix of the linear map P -> A'P + P A on the columns of P one below the other.
Eigen::MatrixXd lyapunovOperator(const Eigen::MatrixXd& A) {
  const Eigen::Index n = A.rows();
  Eigen::MatrixXd map = Eigen::MatrixXd::Zero(n * n, n * n);
  for (Eigen::Index column = 0; column < n; ++column) {
    map.block(column * n, column * n, n, n) += A.transpose();
    for (Eigen::Index other = 0; other < n; ++other) {
      map.block(column * n, other * n, n, n).diagonal().array() += A(other, column);
    }
  }
  return map;
}

}  // namespace

Eigen::MatrixXd solveLyapunov(const Eigen::MatrixXd& A, const Eigen::MatrixXd& Q) {
  const Eigen::Index n = A.rows();
  if (A.cols() != n || Q.rows() != n || Q.cols() != n || !A.allFinite() || !Q.allFinite()) {
    throw std::domain_error("A and Q must be square, of one size and finite");
  }
  requirePositiveDefinite("Q", Q);

  const Eigen::VectorXd right = -Eigen::Map<const Eigen::VectorXd>(Q.data(), n * n);
  const Eigen::VectorXd solution = lyapunovOperator(A).fullPivLu().solve(right);
  const Eigen::MatrixXd raw = Eigen::Map<const Eigen::MatrixXd>(solution.data(), n, n);
  const Eigen::MatrixXd P = 0.5 * (raw + raw.transpose());
  const double residual = (A.transpose() * P + P * A + Q).norm() / Q.norm();
  if (!(residual <= kTolerance)) {
    throw std::domain_error(
        "A is not Hurwitz, or badly scaled: the Lyapunov equation is left with a residual of " +
        numberText(residual) + " of Q; it must be <= " + numberText(kTolerance));
  }
  requirePositiveDefinite("A is not Hurwitz: P", P);  // Lyapunov's theorem
  return P;
}

}  // namespace aqc
