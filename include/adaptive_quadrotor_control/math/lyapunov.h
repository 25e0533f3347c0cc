#pragma once

#include <Eigen/Core>

namespace aqc {

/// The symmetric positive definite P of A'P + P A = -Q (thesis chapter 3, below eq. r).
///
/// `A` is n x n and must be Hurwitz (every eigenvalue's real part < 0), `Q` n x n symmetric
/// positive definite. Solved as one linear system of n^2 unknowns: meant for loading, n up to
/// about 10. Throws std::domain_error when A is not Hurwitz (by Lyapunov's theorem: no such P
/// exists), when Q is not symmetric positive definite, or when the residual exceeds 1e-9 of Q.
Eigen::MatrixXd solveLyapunov(const Eigen::MatrixXd& A, const Eigen::MatrixXd& Q);

}  // namespace aqc
